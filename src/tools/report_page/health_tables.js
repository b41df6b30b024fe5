// Events, and the estimates at the end.

const MOST_EVENTS = 500;  // that a person would read

function eventsSection({strut, events}, several) {
  const rows = events.slice(0, MOST_EVENTS)
                   .map(
                       ({time, elapsed, level, message}) => element(
                           'tr', {'data-event': level, 'data-time': time},
                           element('td', {class: 'number minor'}, time.toFixed(2)),
                           element('td', {class: 'moment'}, span(elapsed)),
                           element('td', {}, element('b', {class: 'level', 'data-level': level}, level)),
                           element('td', {}, typeset(message))));
  const left = events.length - rows.length;
  return section(
      idOf('events', strut, several), titleOf('Events', strut, several), 'Every change of level with its reason.',
      wideTable([head('stamp [s]', 'number minor'), head('after', 'moment'), head('level'), head('reason')], rows),
      left > 0 ? element('p', {class: 'lede'}, `${left} more: --json and --csv have all.`) : null);
}

function estimateRow(name, estimate) {
  const value = key => withDeviation(estimate[key], estimate[`${key}_stddev`]);
  return element(
      'tr', {'data-estimator': name},
      element('td', {}, element('b', {}, name), estimate.valid ? null : element('small', {}, 'not valid')),
      element('td', {class: 'number'}, value('damping_to_mass')),
      element('td', {class: 'number'}, value('stiffness_to_mass')),
      element('td', {class: 'number minor'}, rounded(estimate.natural_frequency, 4)),
      element('td', {class: 'number minor'}, rounded(estimate.damping_ratio, 3)),
      element('td', {class: 'number minor'}, rounded(estimate.offset, 3)));
}

function estimatesSection({strut, estimate, la, ls}, several) {
  return section(
      idOf('estimates', strut, several), titleOf('Estimates at the end', strut, several),
      'What the monitor knows after the last reading, ± standard deviation. Trust “estimate”: health is judged by it. ' +
          'The paper’s two estimators stand beside it: ls, least squares, and la, which outliers hardly move; their ' +
          'deviation is that of their own scatter.',
      wideTable(
          [
            head(''), head('b₁ damping/mass [1/s]', 'number'), head('b₀ stiffness/mass [1/s²]', 'number'),
            head('frequency [Hz]', 'number minor'), head('damping ratio', 'number minor'),
            head('offset [m/s²]', 'number minor')
          ],
          Object.entries({estimate, la, ls}).map(([name, each]) => estimateRow(name, each))));
}
