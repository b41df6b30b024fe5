// The struts by numbers, and how they move one another.

function strutRow(strut, scale) {
  const {name, verdict, selected = [], damping_to_mass: damping, stiffness_to_mass: stiffness} = strut;
  const error = key => (isNumber(strut[key]) ? rounded(strut[key] * scale.factor) : '–');
  return element(
      'tr', {'data-strut': name, 'data-verdict': verdict}, element('td', {}, strutName(strut)),
      element('td', {}, element('span', {class: 'word'}, verdictWord(verdict, selected.length))),
      [damping, stiffness].map(value => element('td', {class: 'number'}, rounded(value, 4))),
      ['error_before', 'error_after', 'noise_floor'].map(key => element('td', {class: 'number minor'}, error(key))));
}

function strutsSection({struts}) {
  const scale = scaleFor(Math.max(0, ...struts.map(({error_before: error = 0}) => error)), 'm/s^2');
  return section(
      'struts', 'The struts by numbers',
      'Damping b₁ and stiffness b₀ over the mass that each has of the body, free of what the others do; error: of the ' +
          'predicted acceleration on parts of the drive that no fit has seen, of the model as it is.',
      wideTable(
          [
            head('strut'), head('verdict'), head('b₁ [1/s]', 'number'), head('b₀ [1/s²]', 'number'),
            head(`error [${scale.unit}]`, 'number minor'), head('with what was found', 'number minor'),
            head('noise floor', 'number minor')
          ],
          struts.map(strut => strutRow(strut, scale))));
}

/** A number to the first digit of its standard deviation. */
function ratioCell(value, stddev, most = 4) {
  const digits = stddev > 0 ? Math.min(most, Math.max(0, -Math.floor(Math.log10(stddev)))) : 3;
  const shown = number => number.toFixed(digits).replace('-', '−');
  return [shown(value), element('small', {}, `± ${shown(stddev)}`)];
}

function couplingSection({struts, ratios, stddevs, model_error: modelError}) {
  if (struts.length < 2) return null;
  const cell = (i, j) => element(
      'td', {class: 'number', 'data-ratio': ratios[i][j], 'data-stddev': i === j ? null : stddevs[i][j]},
      i === j ? '1' : ratioCell(ratios[i][j], stddevs[i][j]));
  return section(
      'coupling', 'How the struts move one another',
      'A row is the top of a strut: how much of what each strut does to its own top reaches it, ± standard deviation. ' +
          'The ratios belong to the body and to where the struts stand, not to wear; positive: both are pushed the ' +
          'same way.' +
          (isNumber(modelError) ?
               ` A rigid body on linear struts leaves ${rounded(100 * modelError, 2)} % of it unexplained.` : ''),
      wideTable(
          [head('moved by'), struts.map(({name}) => head(spoken(name), 'number'))],
          struts.map(
              ({name}, i) => element(
                  'tr', {'data-strut': name}, element('td', {}, spoken(name)), struts.map((_, j) => cell(i, j)))),
          'matrix'));
}

/** Of a force that has been still nothing is known: its standard deviation is null. */
function forcesSection({struts, known_forces: forces}) {
  if (forces.length === 0) return null;
  const cell = ({coefficients, stddevs}, i) => element(
      'td', {class: 'number', 'data-coefficient': coefficients[i], 'data-stddev': stddevs[i]},
      isNumber(stddevs[i]) ? ratioCell(coefficients[i], stddevs[i], 8) : 'cannot tell');
  return section(
      'forces', 'What the known forces do',
      'By how much one unit of a force accelerates the top of each strut, in m/s² per unit, ± standard deviation: of a ' +
          'vertical force in newtons 1/M + x·xᵢ/Iyy + y·yᵢ/Ixx.',
      wideTable(
          [head('force'), struts.map(({name}) => head(spoken(name), 'number'))],
          forces.map(
              force => element(
                  'tr', {'data-force': force.name}, element('td', {}, spoken(force.name)),
                  struts.map((_, i) => cell(force, i)))),
          'matrix'));
}
