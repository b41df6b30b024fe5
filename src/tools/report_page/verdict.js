// The verdict in words that a mechanic understands, and what to do next.

const kindOf = (findings, name) => findings.effects[name];

/** "dry friction: seal, bent rod, top mount" -> what it is, and where to look. */
function whatAndWhere(finding) {
  const colon = finding.indexOf(': ');
  return colon < 0 ? [finding, ''] : [finding.slice(0, colon), finding.slice(colon + 2)];
}

/** The same in a sentence: "dry friction (seal, bent rod, top mount)". */
function foundWith(finding) {
  const [what, where] = whatAndWhere(finding);
  return where ? `${what} (${where})` : what;
}

/** The effects that the drive cannot tell from the one named, itself first. */
function rivalsOf(findings, name) {
  const group = findings.search.indistinguishable.find(each => each.includes(name)) || [];
  return [name, ...group.filter(each => each !== name)];
}

function headline(findings) {
  const {verdict, selected, explained_share: share} = findings.search;
  if (verdict === 'nothing_missing') return 'Nothing is missing: the model explains the drive down to the noise.';
  if (!selected.length) return 'Something is missing, but no known effect explains it.';
  const what = names =>
      names
          .map(
              name =>
                  joined(rivalsOf(findings, name).map(each => whatAndWhere(kindOf(findings, each).finding)[0]), 'or'))
          .join('; ');
  const forces = selected.filter(name => kindOf(findings, name).kind === 'force');
  const readings = selected.filter(name => kindOf(findings, name).kind === 'reading');
  if (verdict === 'suspect')
    return `Main suspect: ${what(selected)}. It takes ${percent(100 * share)} of what is missing, not all of it.`;
  const parts = [];
  if (forces.length) parts.push(`Missing from the model: ${what(forces)}.`);
  if (readings.length)
    parts.push(`${forces.length ? 'And the sensor is at fault' : 'The sensor is at fault, not the strut'}: ${
        what(readings)}.`);
  return parts.join(' ');
}

/** One sentence per effect: its name, where to look, its size. */
function effectSentence(findings, name) {
  const {law, finding, advice} = kindOf(findings, name);
  const isHarmless = (findings.search.costs || []).some(({effect, harmless}) => effect === name && harmless);
  const sizes = numbersOf(findings, name, findings.search.extended, findings.search.extended.stddevs);
  return element(
      'p', {class: 'answer'}, element('b', {'data-effect': name}, capitalised(spoken(name))), ', ',
      element('code', {}, law), ` with ${joined(sizes)}. `,
      `What a workshop would find: ${foundWith(finding)}. `,
      advice && !isHarmless ? element('span', {class: 'advice'}, advice) : null);
}

/** @param share  of the error that a free-form force of travel and travel rate could explain. */
function whatASurfaceTells(share) {
  const part = percent(100 * Math.max(0, share));
  if (share >= 0.5)
    return `A force that depends on travel and travel rate alone could explain ${part} of the error: the map below ` +
        'shows its shape. Write it as a law of your own in an effects file and diagnose again.';
  return `A force of travel and travel rate alone could explain only ${part} of the error: think of forces with ` +
      'memory, and of what comes from outside the strut (pitch and roll of the body, other struts, an engine, a ' +
      'loose sensor).';
}

function nextSteps(findings) {
  const {verdict, selected, indistinguishable, suggested_drive: drive, surface_share: share, remainder} =
      findings.search;
  const steps = [];
  if (remainder) steps.push(remainder);
  for (const group of indistinguishable)
    steps.push(`This drive cannot tell apart ${joined(group.map(spoken), 'or')}: any of them would do as well${
        selected.length ? '; the simplest is named' : ''}.`);
  if (verdict === 'nothing_missing')
    steps.push(
        'Keep the model as it is. A fault that shows only in other conditions (hard braking, full load, cold damper) ' +
        'needs a drive in those.');
  if (verdict === 'unexplained') {
    if (isNumber(share)) steps.push(whatASurfaceTells(share));
    steps.push(
        'See below where the model fails: the time, the travel and the frequency of the error say where to look.');
  }
  if (drive) steps.push(`Drive to record next: ${drive}`);
  return steps.length ? element(
                            'div', {class: 'next'}, element('b', {}, 'What to do next'),
                            element('ul', {}, steps.map(step => element('li', {}, step)))) :
                        null;
}

function keyFigures(findings) {
  const {base, extended, noise_floor: floor, structured_share: structure} = findings.search;
  const one = (title, value, unit, tone) => element(
      'div', {style: tone ? `--colour: var(--${tone})` : null}, element('dt', {}, title),
      element('dd', {}, value, ' ', element('small', {}, unit)));
  const scale = scaleFor(base.held_out_rmse, 'm/s^2');
  const error = value => rounded(value * scale.factor, 3);
  const figures = [one('error of the model as it is', error(base.held_out_rmse), scale.unit, 'before')];
  if (extended) figures.push(one('error with the effect', error(extended.held_out_rmse), scale.unit, 'after'));
  figures.push(one('what sensor noise alone leaves, about', error(floor), scale.unit, 'floor'));
  if (extended) {
    const removed = 100 * (1 - (extended.held_out_rmse / base.held_out_rmse) ** 2);
    figures.push(one('of the error removed', percent(removed, Infinity), '', 'good'));
  } else {
    figures.push(one('of the error is no noise, about', rounded(100 * structure, 2), '%'));
  }
  return element('dl', {class: 'figures-row'}, figures);
}

/** The way back to the vehicle of the strut, and what of it is in no strut. */
function ofVehicle({vehicle}) {
  if (!vehicle) return null;
  const bars =
      vehicle.anti_roll_bars.filter(({struts}) => struts.includes(vehicle.strut))
          .map(({struts}) => struts.find(name => name !== vehicle.strut))
          .map(other => `An anti-roll bar ties it to ${spoken(other)}: known from the coupling, and taken out here. `);
  const back = vehicle.has_page ? element('a', {href: '../report.html'}, 'The whole vehicle') : null;
  return element('p', {}, `${capitalised(spoken(vehicle.strut))} without what the other struts do to it. `, bars, back);
}

function verdictSection(findings) {
  const {search: {verdict, selected}, vehicle} = findings;
  return element(
      'section', {id: 'verdict', 'data-verdict': verdict},
      element('p', {class: 'source'}, `${vehicle ? `${vehicle.strut} in ` : ''}${findings.source}`),
      element(
          'h1', {}, element('span', {class: 'pill'}, verdictWord(verdict, selected.length)), element('br'),
          headline(findings)),
      costLines(findings.search), ofVehicle(findings),
      findings.change ? element('p', {class: 'change'}, `${capitalised(findings.change)}.`) : null,
      selected.map(name => effectSentence(findings, name)), nextSteps(findings), keyFigures(findings));
}
