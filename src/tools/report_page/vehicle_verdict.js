// The verdict on the vehicle, and that on each of its struts.

/** What was found in a strut, with what the drive cannot tell from it. */
function foundIn({selected, indistinguishable, reason}) {
  if (reason) return `the drives ${typeset(reason)}`;
  const rivals = name =>
      (indistinguishable.find(group => group.includes(name)) || []).filter(each => !selected.includes(each));
  return selected.map(name => joined([name, ...rivals(name)].map(spoken), 'or')).join('; ');
}

function strutName({name, reason}) {
  return reason ? spoken(name) : element('a', {href: `${name}/report.html`}, spoken(name));
}

function strutItem(strut, effects) {
  const {name, verdict, selected, change} = strut;
  const findings = selected.filter(each => effects[each]).map(each => effects[each].finding);
  const found = foundIn(strut);
  return element(
      'li', {'data-strut': name, 'data-verdict': verdict}, element('b', {}, strutName(strut)), ' ',
      element('span', {class: 'word'}, verdictWord(verdict, selected.length)),
      found ? element('small', {}, capitalised(found), findings.length ? ` (${findings.join('; ')})` : '') : null,
      costLines(strut).map(line => element('small', {}, line.textContent)),
      change ? element('small', {class: 'change'}, capitalised(change)) : null);
}

function barSentence({struts, stiffness_to_mass: stiffness}) {
  const own = struts.map(strut => `${rounded(stiffness[strut])} of ${spoken(strut)}`);
  return element(
      'p', {},
      `Anti-roll bar between ${joined(struts.map(spoken))}: stiffness over the body’s mass at the strut ${
          joined(own)} [1/s²].`);
}

function vehicleVerdictSection(findings) {
  const {verdict, summary, struts, anti_roll_bars: bars, source} = findings;
  const named = struts.reduce((sum, {selected}) => sum + selected.length, 0) - bars.length;  // a bar is of two
  return element(
      'section', {id: 'verdict', 'data-verdict': verdict}, element('p', {class: 'source'}, source),
      element('h1', {}, element('span', {class: 'pill'}, verdictWord(verdict, named)), element('br'), spoken(summary)),
      element(
          'div', {class: 'from-above'}, vehicleDrawing(findings),
          element('ul', {}, struts.map(strut => strutItem(strut, findings.effects)))),
      bars.map(barSentence),
      element(
          'p', {class: 'lede'},
          `From above, ahead is up; ${
              havePositions(struts) ?
                  'the wheels stand where the vehicle file has the tops of their struts' :
                  'laid out by the names of the struts, as the vehicle file does not place all'}. ` +
              'A strut opens its own page: the error over time, the missing force, every candidate.'));
}
