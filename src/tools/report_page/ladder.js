// Error step by step, as bars: the model as it is, with each effect, and what noise alone leaves.

function ladderSteps({search: {base, extended, ranking, selected, noise_floor: floor}, effects}) {
  const finding = names => names.map(name => whatAndWhere(effects[name].finding)[0]).join('; ');
  const steps = [{label: 'model as it is', note: 'before anything is added', rmse: base.held_out_rmse, tone: 'before'}];
  const alone = ranking.find(({effects}) => effects[effects.length - 1] === selected[0]);
  if (extended && selected.length > 1 && alone)
    steps.push({
      label: `with ${spoken(selected[0])}`,
      note: finding(selected.slice(0, 1)),
      rmse: alone.held_out_rmse,
      tone: 'after'
    });
  if (extended) {
    const last = selected.length > 1 ? selected.slice(1) : selected;
    steps.push({
      label: `with ${joined(last.map(spoken))}${selected.length > 1 ? ' as well' : ''}`,
      note: finding(last),
      rmse: extended.held_out_rmse,
      tone: 'after'
    });
  }
  return [...steps, {label: 'noise floor', note: 'what sensor noise alone would leave', rmse: floor, tone: 'floor'}];
}

/** A bar on a track, with a dashed mark where the noise floor is. */
function bar(share, floorShare, tone) {
  return element(
      'span', {class: 'track'},
      element('i', {class: 'bar', style: `width: ${100 * Math.min(1, share)}%; --colour: var(--${tone})`}),
      element('i', {class: 'floor-mark', style: `left: ${100 * Math.min(1, floorShare)}%`}));
}

function ladderSection(findings) {
  const {noise_floor: floor} = findings.search;
  const steps = ladderSteps(findings);
  const longest = Math.max(...steps.map(step => step.rmse));
  const scale = scaleFor(longest, 'm/s^2');
  return section(
      'ladder', findings.after ? 'How much error goes away' : 'How large the error is',
      'Root mean square error of the predicted body acceleration on parts of the drive that no fit has seen. Shorter ' +
          'is better; the dashed line is about what sensor noise alone would leave.',
      element(
          'dl', {class: 'ladder'},
          steps.map(
              ({label, note, rmse, tone}) =>
                  [element('dt', {}, capitalised(label), note ? element('small', {}, note) : null),
                   element(
                       'dd', {'data-rmse': rmse}, bar(rmse / longest, floor / longest, tone),
                       element('b', {}, `${rounded(rmse * scale.factor)} ${scale.unit}`))])));
}
