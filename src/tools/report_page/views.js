// The residual seen from all sides: over the motion, over frequency, over lag.

const beforeAndAfter =
    findings => [['before', findings.before], ['after', findings.after]].filter(([, comparison]) => comparison);
const NAMES = {
  before: 'model as it is',
  after: 'with the effect'
};

const transposed = matrix => matrix[0].map((_, j) => matrix.map(row => row[j]));

/** A map of matrices[x][y] for figures: rows upwards along y, nothing where no sample was. */
function mapOf([x, y], [x_edges, y_edges], {count, ...matrices}) {
  const map = {x, y, x_edges, y_edges, count: transposed(count)};
  for (const [name, matrix] of Object.entries(matrices))
    map[name] = transposed(matrix).map((row, j) => row.map((value, i) => (count[i][j] ? value : null)));
  return map;
}

function surfaceMap({travel_edges, rate_edges, mean, standard_error, count}) {
  return mapOf([AXES.travel, AXES.travel_rate], [travel_edges, rate_edges], {mean, standard_error, count});
}

/** What a force that two variables decide is like: `value` of every cell, 'mean' as it was seen or 'law'. */
function forceMap({variables, edges, cells}, value) {
  const each = name => cells.map(column => column.map(bin => bin[name]));
  return mapOf(variables.map(name => AXES[name]), edges, {mean: each(value), count: each('count')});
}

function mapSection(findings) {
  const {surface_share: share, verdict} = findings.search;
  return section(
      'maps', 'Missing force over the motion of the strut',
      'The force per unit mass that the model lacks, by travel (compression to the right) and travel rate ' +
      '(compressing upwards). Orange: the body is pushed up harder than the model says; blue: less. A good model ' +
      'leaves a pale, speckled map.',
      mapPair(
          beforeAndAfter(findings).map(
              ([when, {views}]) => ({name: capitalised(NAMES[when]), map: surfaceMap(views.surface)})),
          {title: 'missing force', unit: 'm/s^2'}),
      verdict === 'nothing_missing' ?
          null :
          element(
              'p', {class: 'lede'},
              `A force of travel and travel rate alone, of whatever form, would take ${
                  percent(100 * share)} of what is not noise.`));
}

function whereSection(findings) {
  const list = ({where}) =>
      element('ul', {class: 'findings'}, where.map(({sentence}) => element('li', {}, typeset(sentence))));
  return section(
      'where', 'Where the model fails', null,
      beforeAndAfter(findings).map(
          ([when, comparison]) =>
              [findings.after ? element('h3', {}, capitalised(NAMES[when])) : null, list(comparison)]));
}

/**
 * The force of one effect that travel, travel rate or time decides alone: the law as a line, what was seen as dots.
 */
function forceCurves(force) {
  const host = element('div');
  const tones = ['before', 'good'];
  const branches = force.branches.map(({name, bins}) => ({
                                        name,
                                        points: bins.map(({at, mean, deviation, law, count}) => (
                                                             {x: at, y: mean, low: mean - deviation,
                                                              high: mean + deviation, law, count}))
                                      }));
  const seen = branches.flatMap(({points}) => points);
  const laws = force.curve ? [force.curve] :
                             branches.map(({points}) => ({at: points.map(({x}) => x), law: points.map(each => each.law)}));
  whenPlaced(() => new Plot(host, {
                     x: new Axis({...AXES[force.variables[0]], domain: padded(seen.map(({x}) => x), 0.04)}),
                     y: new Axis({
                       title: 'force per unit mass',
                       unit: 'm/s^2',
                       domain: padded(seen.flatMap(({y, low, high, law}) => [y, low, high, law]))
                     }),
                     height: 320,
                     name: `force of ${spoken(force.effect)}, seen and by the law`,
                     layers: [
                       levelLayer(0, 'muted', []), ...branches.map(({points}, i) => dotLayer(points, tones[i], 'seen')),
                       ...laws.map(({at, law}) => lineLayer(at, law, 'after', {width: 2.6, label: 'by the law'}))
                     ],
                     hover(x) {
                       const rows = branches.map(({name, points}) => {
                         const point = points[nearestIndex(points.map(each => each.x), x)];
                         return [
                           [name ? `seen, ${name}` : 'seen', this.y.show(point.y)],
                           ['by the law', this.y.show(point.law), 'after'], ['samples', String(point.count)]
                         ];
                       });
                       return {title: `${AXES[force.variables[0]].title} ${this.x.show(x)}`, rows: rows.flat(), at: x};
                     },
                   }).draw());
  return [
    legend(
        ['after', `the law found, ${force.law}`],
        ...branches.map(
            ({name}, i) => [tones[i], `force seen${name ? ', ' + name : ''}: mean and spread`, 'dot'])),
    host
  ];
}

function forceSection(findings) {
  const {selected} = findings.search;
  if (!selected.length) return null;
  const panels = findings.forces.map(
      force =>
          [element('h3', {}, `${capitalised(spoken(force.effect))}: ${foundWith(kindOf(findings, force.effect).finding)}`),
           force.branches ?
               forceCurves(force) :
               mapPair(
                   [
                     {name: 'Force seen', map: forceMap(force, 'mean')},
                     {name: `By the law ${force.law}`, map: forceMap(force, 'law')}
                   ],
                   {title: 'force per unit mass', unit: 'm/s^2'})]);
  const readings =
      selected.filter(name => kindOf(findings, name).kind === 'reading')
          .map(
              name => element(
                  'p', {}, element('b', {}, capitalised(spoken(name))),
                  ` is no force: the sensor reads ${
                      kindOf(findings, name)
                          .law} where the body accelerates with y. Put the sensor right rather than the strut.`));
  return section(
      'force', findings.forces.length ? 'The force that was missing' : 'What the sensor does',
      findings.forces.length ?
          'What is left of the measured acceleration when everything else in the model is taken off, beside the law ' +
          'that was found. Where they lie on each other the law is right.' :
          null,
      panels, readings);
}

function spectrumSection(findings) {
  const shown = beforeAndAfter(findings).filter(([, {views}]) => views.spectrum);
  if (!shown.length) return null;
  const amplitudes = densities => densities.map(Math.sqrt);
  const spectra = shown.map(([when, {views: {spectrum}}]) => ({
                              ...spectrum,
                              when,
                              residual: amplitudes(spectrum.residual),
                              noise: amplitudes(spectrum.noise)
                            }));
  const {frequency, noise} = spectra[0];
  const positive = spectra.flatMap(({residual}) => residual).concat(noise).filter(value => value > 0);
  const range = [Math.min(...positive), Math.max(...positive)];
  const hosts = [element('div'), element('div')];
  const xAxis = () =>
      new Axis({title: 'frequency', unit: 'Hz', domain: [frequency[0], frequency[frequency.length - 1]], log: true});
  const rows = (x, each) => ({
    title: quantity(x, 'Hz'),
    at: x,
    rows: each.map(({when, text}) => [NAMES[when] || when, text, when === 'noise' ? 'floor' : when])
  });
  whenPlaced(() => {
    new Plot(hosts[0], {
      x: xAxis(),
      y: new Axis({title: 'error', unit: '(m/s^2)/sqrtHz', domain: [range[0] / 1.5, range[1] * 1.5], log: true}),
      height: 260,
      name: 'spectrum of the error',
      layers: [
        lineLayer(frequency, noise, 'floor', {width: 1.4, dash: [5, 4]}),
        ...spectra.map(({when, residual}) => lineLayer(frequency, residual, when))
      ],
      hover: x => {
        const i = nearestIndex(frequency, x);
        return rows(frequency[i], [
          ...spectra.map(
              ({when, residual}) => ({when, text: `${rounded(residual[i])} ${prettyUnit('(m/s^2)/sqrtHz')}`})),
          {when: 'noise', text: rounded(noise[i])}
        ]);
      }
    }).draw();
    new Plot(hosts[1], {
      x: xAxis(),
      y: new Axis({title: 'coherence', domain: [0, 1]}),
      height: 170,
      name: 'coherence of the error with the motion of the wheel',
      layers: [
        levelLayer(spectra[0].coherence_threshold, 'floor'),
        ...spectra.map(({when, coherence}) => lineLayer(frequency, coherence, when))
      ],
      hover: x => {
        const i = nearestIndex(frequency, x);
        return rows(frequency[i], spectra.map(({when, coherence}) => ({when, text: rounded(coherence[i], 2)})));
      }
    }).draw();
  });
  return section(
      'spectrum', 'Error over frequency',
      'Above: how strong the error is at each frequency. Below: how much of it follows the motion of the wheel. What ' +
      'follows the wheel above the dashed line is a mistake of the model, not noise.',
      legend(...shown.map(([when]) => [when, NAMES[when]]), ['floor', 'noise alone', 'dashed']), hosts);
}

function correlationFigure(title, findings, which, lagTitle) {
  const shown = beforeAndAfter(findings).map(([when, {views}]) => ({when, ...views[which]}));
  const host = element('div');
  const {lag, lower, upper} = shown[shown.length - 1];
  whenPlaced(
      () => new Plot(host, {
              x: new Axis({title: lagTitle, unit: 's', domain: ends(lag)}),
              y: new Axis(
                  {title: 'correlation', domain: padded([...shown.flatMap(({value}) => value), ...lower, ...upper])}),
              height: 230,
              name: title,
              layers: [
                bandLayer(lag, lower, upper, 'floor'), levelLayer(0, 'muted', []),
                ...shown.map(each => lineLayer(each.lag, each.value, each.when))
              ],
              hover(x) {
                return {
                  title: `${lagTitle} ${this.x.show(x)}`,
                  at: x,
                  rows: shown.map(
                      each => [NAMES[each.when], rounded(each.value[nearestIndex(each.lag, x)], 2), each.when])
                };
              },
            }).draw());
  return figure(title, host);
}

function whitenessSection(findings) {
  const judged = (findings.after || findings.before).views;
  const white = judged.whiteness.within && judged.cross_correlation.within;
  return section(
      'whiteness', 'Is what remains noise?',
      `${white ? 'Yes' : 'Not entirely'}: noise stays in the grey band at all lags. ${
          findings.after ? 'With the effect' : 'For the model as it is'} ${
          percent(100 * judged.whiteness.share_outside)} of the lags lie outside (by chance 5\u00a0% would).`,
      legend(
          ...beforeAndAfter(findings).map(([when]) => [when, NAMES[when]]),
          ['floor', 'noise would stay here', 'band']),
      element(
          'div', {class: 'pair'}, correlationFigure('Error with itself, later', findings, 'whiteness', 'lag'),
          correlationFigure('Error with the wheel’s acceleration', findings, 'cross_correlation', 'lag')));
}
