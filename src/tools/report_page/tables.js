// Candidates and parameters.

/** An effect's coefficients and shapes as "c = 0.35 ± 0.01 m/s²", one text each. */
function numbersOf(findings, name, model, deviations = {}) {
  const {coefficients, shapes} = kindOf(findings, name);
  const text = (key, symbol, value, unit) =>
      `${symbol} = ${quantityWithDeviation(value, deviations[key], unit)}`.trim();
  const keyed = (names, values) =>
      names.map(([symbol, unit]) => text(`${name}/${symbol}`, symbol, values[`${name}/${symbol}`], unit));
  const own = coefficients.length > 1 ? keyed(coefficients, model.coefficients) :
                                        [text(name, 'c', model.coefficients[name], coefficients[0][1])];
  return [...own, ...keyed(shapes, model.shapes)];
}

/** A model's coefficients and shapes, one line each. */
function coefficientLines(findings, model, deviations = {}) {
  return model.effects
      .flatMap(name => {
        const several = model.effects.length > 1 ? `${spoken(name)} ` : '';
        return numbersOf(findings, name, model, deviations).map(text => several + text);
      })
      .map(line => element('div', {}, line));
}

function rankingSection(findings) {
  const {ranking, base, selected, indistinguishable, noise_floor: floor} = findings.search;
  const longest =
      Math.max(base.held_out_rmse, ...ranking.map(({held_out_rmse: rmse}) => Math.min(rmse, 1.5 * base.held_out_rmse)));
  const scale = scaleFor(base.held_out_rmse, 'm/s^2');
  const rows = ranking.map((ranked, i) => {
    const name = ranked.effects[ranked.effects.length - 1];
    const chosen = selected.includes(name), rival = !chosen && indistinguishable.flat().includes(name);
    return element(
        'tr', {class: chosen ? 'chosen' : null, 'data-candidate': name, 'data-rmse': ranked.held_out_rmse},
        element('td', {class: 'number minor'}, String(i + 1)),
        element(
            'td', {}, element('b', {}, ranked.effects.map(spoken).join(' + ')),
            chosen    ? ' ✓' :
                rival ? ' ≈' :
                        '',
            element('small', {}, kindOf(findings, name).finding),
            chosen || rival ? element('small', {class: 'advice'}, kindOf(findings, name).advice) : null),
        element(
            'td', {class: 'error'}, `${rounded(ranked.held_out_rmse * scale.factor)} ${scale.unit}`,
            bar(ranked.held_out_rmse / longest, floor / longest, chosen ? 'after' : 'floor')),
        element('td', {class: 'number'}, percent(ranked.error_removed_percent, Infinity)),
        element('td', {class: 'minor'}, ranked.significant ? 'yes' : 'no'),
        element(
            'td', {class: 'number minor'},
            ranked.fitted ? coefficientLines(findings, ranked, ranked.stddevs) : 'not fitted'));
  });
  return section(
      'ranking', 'All candidates',
      'Every effect that is known, added alone to the model, fitted on two thirds of the drive and judged on the ' +
          'rest. ✓ named; ≈ this drive cannot tell it from the named one; removed: of the error’s mean square; ' +
          'significant: more than chance would give among so many.',
      wideTable(
          [
            head('#', 'number minor'), head('effect'), head('held-out error'), head('removed', 'number'),
            head('significant', 'minor'), head('fitted', 'number minor')
          ],
          rows));
}

/** Symbol and name of one of the model's numbers. */
function parameterName({name, effect, symbol}) {
  if (!effect) return {b1: ['b₁', 'damping / mass: shock absorber'], b0: ['b₀', 'stiffness / mass: spring']}[symbol];
  return [symbol, `of ${spoken(name === `${effect}/${symbol}` ? effect : name)}`];
}

function parameterSection(findings) {
  const {parameters, after} = findings;
  const scaleOf = ({before, after: later, unit}) => scaleFor(Math.abs((later || before).value), unit);
  const cell = ({value, stddev} = {}, {factor}) =>
      element('td', {class: 'number'}, isNumber(value) ? withDeviation(value * factor, stddev * factor) : '');
  const change = ({before, after: later}) => (before && later ? percent(100 * (later.value / before.value - 1)) : '');
  return section(
      'parameters', 'Parameters',
      after ?
          'Fitted to the whole drive, ± standard deviation. What the missing effect had pushed spring and damper to ' +
              'becomes visible in the change.' :
          'Fitted to the whole drive, ± standard deviation.',
      wideTable(
          [
            head('parameter'), head('model as it is', 'number'),
            after ? [head('with the effect', 'number'), head('change', 'number minor')] : null, head('unit')
          ],
          parameters.map(
              row => element(
                  'tr', {}, element('td', {}, element('b', {}, parameterName(row)[0]), ' ', parameterName(row)[1]),
                  cell(row.before, scaleOf(row)),
                  after ? [cell(row.after, scaleOf(row)), element('td', {class: 'number minor'}, change(row))] : null,
                  element('td', {}, scaleOf(row).unit)))));
}
