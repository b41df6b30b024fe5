// What a verdict is called; the style sheet has its colour.

/** @param count  of the effects named. */
const verdictWord = (verdict, count = 1) => ({
  effect_found: count > 1 ? 'Effects found' : 'Effect found',
  suspect: 'Main suspect',
  nothing_missing: 'Nothing missing',
  unexplained: 'Unexplained',
  cannot_tell: 'Cannot tell'
}[verdict]);
