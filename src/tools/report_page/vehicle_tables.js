// The struts by numbers, and how they move one another.

function strutRow(strut, scale) {
  const {name, verdict, selected, base = {}, extended = {}, noise_floor: floor} = strut;
  const {damping_to_mass: damping, stiffness_to_mass: stiffness} = extended.parameters || base.parameters || {};
  const error = value => (isNumber(value) ? rounded(value * scale.factor) : '–');
  return element(
      'tr', {'data-strut': name, 'data-verdict': verdict}, element('td', {}, strutName(strut)),
      element('td', {}, element('span', {class: 'word'}, verdictWord(verdict, selected.length))),
      [damping, stiffness].map(value => element('td', {class: 'number'}, rounded(value, 4))),
      [base.held_out_rmse, extended.held_out_rmse, floor].map(
          value => element('td', {class: 'number minor'}, error(value))));
}

function strutsSection({struts}) {
  const scale = scaleFor(Math.max(0, ...struts.map(({base}) => (base ? base.held_out_rmse : 0))), 'm/s^2');
  return section(
      'struts', 'The struts by numbers',
      'Damping b₁ (shock absorber) and stiffness b₀ (spring) over the mass that each has of the body, free of what the others do; error: of the ' +
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

function couplingSection({struts, coupling, coupling_stddevs: stddevs, model_error: modelError}) {
  if (struts.length < 2) return null;
  const cell = (at, of) =>
      (at === of ? element('td', {class: 'number', 'data-ratio': 1}, '1') :
                   element(
                       'td', {class: 'number', 'data-ratio': coupling[at][of], 'data-stddev': stddevs[at][of]},
                       ratioCell(coupling[at][of], stddevs[at][of])));
  return section(
      'coupling', 'How the struts move one another',
      'A row is the top of a strut: how much of what each strut does to its own top reaches it, ± standard deviation. ' +
          'The ratios belong to the body and to where the struts stand, not to wear; positive: both are pushed the ' +
          'same way.' +
          (isNumber(modelError) ?
               ` A rigid body on linear struts leaves ${rounded(100 * modelError, 2)} % of it unexplained.` :
               ''),
      wideTable(
          [head('moved by'), struts.map(({name}) => head(spoken(name), 'number'))],
          struts.map(
              ({name}) => element(
                  'tr', {'data-strut': name}, element('td', {}, spoken(name)),
                  struts.map(other => cell(name, other.name)))),
          'matrix'));
}

/** Of a force that has been still nothing is known: its standard deviation is null. */
function forcesSection({struts, known_forces: forces}) {
  const names = Object.keys(forces);
  if (names.length === 0) return null;
  const cell = ({coefficients, stddevs}, strut) => element(
      'td', {class: 'number', 'data-coefficient': coefficients[strut], 'data-stddev': stddevs[strut]},
      isNumber(stddevs[strut]) ? ratioCell(coefficients[strut], stddevs[strut], 8) : 'cannot tell');
  return section(
      'forces', 'What the known forces do',
      'By how much one unit of a force accelerates the top of each strut, in m/s² per unit, ± standard deviation: of a ' +
          'vertical force in newtons 1/M + x·xᵢ/Iyy + y·yᵢ/Ixx.',
      wideTable(
          [head('force'), struts.map(({name}) => head(spoken(name), 'number'))],
          names.map(
              force => element(
                  'tr', {'data-force': force}, element('td', {}, spoken(force)),
                  struts.map(({name}) => cell(forces[force], name)))),
          'matrix'));
}
