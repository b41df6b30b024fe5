// What a verdict is called; the style sheet has its colour.

/** @param count  of the effects named. */
const verdictWord = (verdict, count = 1) => ({
  effect_found: count > 1 ? 'Effects found' : 'Effect found',
  suspect: 'Main suspect',
  nothing_missing: 'Nothing missing',
  unexplained: 'Unexplained',
  cannot_tell: 'Cannot tell'
}[verdict]);

/** What the effects found do to b1 and b0, in the words of the terminal. */
const costLines = ({costs = []}) =>
    costs.map(({effect, sentence}) => element('p', {class: 'cost', 'data-cost': effect}, spoken(sentence)));
