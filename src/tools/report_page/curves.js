// What damper and spring do, as drives show it.

const NINETY_PERCENT = 1.645;  // standard deviations

const CURVES_LEDE =
    'Compression to the right, rebound to the left. A band holds nine tenths of the true law. A constant ' +
    'force cannot be told from an offset of a sensor, so that curves go through 0.';

/**
 * @param lines  [{label, colour, xs, force, stddev}], the first to be read off; without stddev dashed, without a band.
 */
function curveFigure(title, axis, lines) {
  const shown = lines.filter(({force}) => force.length);
  if (!shown.length) return null;
  const side = ({force, stddev}, sign) => force.map((y, i) => y + sign * NINETY_PERCENT * (stddev ? stddev[i] : 0));
  const bands = shown.map(line => ({...line, low: side(line, -1), high: side(line, 1)}));
  const host = element('div');
  whenPlaced(() => new Plot(host, {
                     x: new Axis({...axis, domain: padded(bands.flatMap(({xs}) => xs), 0)}),
                     y: new Axis({
                       title: 'force per unit mass',
                       unit: 'm/s^2',
                       domain: padded(bands.flatMap(({low, high}) => [...low, ...high]))
                     }),
                     height: 280,
                     name: `curve of the ${title.toLowerCase()}`,
                     layers: [
                       levelLayer(0, 'muted', []),
                       bands.filter(({stddev}) => stddev)
                           .map(({xs, low, high, colour}) => bandLayer(xs, low, high, colour, 0.35)),
                       bands.map(
                           ({xs, force, stddev, colour, label}) =>
                               lineLayer(xs, force, colour, stddev ? {label} : {label, width: 1.4, dash: [5, 4]}))
                     ].flat(),
                     hover(x) {
                       const at = bands[0].xs[nearestIndex(bands[0].xs, x)];
                       return {
                         title: `${axis.title} ${this.x.show(at)}`,
                         rows: bands.map(({xs, low, high, stddev, colour, label}) => {
                           const i = nearestIndex(xs, at);
                           const ends = [low[i], high[i]].map(y => this.y.show(y));
                           return [label, stddev ? `90 % between ${ends.join(' and ')}` : ends[0], colour];
                         }),
                         at
                       };
                     },
                   }).draw());
  return figure(title, host);
}

/** @param damper, spring  lines of curveFigure(). */
function curveFigures(damper, spring) {
  const shown = [
    curveFigure('Damper', AXES.travel_rate, damper.map(line => ({...line, xs: line.velocity}))),
    curveFigure('Spring', AXES.travel, spring.map(line => ({...line, xs: line.travel})))
  ].filter(Boolean);
  return shown.length ? element('div', {class: 'pair'}, shown) : null;
}

function curveSection({curves: {damper, spring}}) {
  const linesOf = curve =>
      [{...curve, label: 'as the drives show it', colour: 'good'},
       {...curve, label: 'by the model', colour: 'after', force: curve.law, stddev: null}];
  const figures = curveFigures(linesOf(damper), linesOf(spring));
  return figures &&
      section(
             'curves', 'Damper and spring', `The force of shock absorber and spring as the drives show it, whatever the model says. ${CURVES_LEDE}`,
             legend(['good', 'as the drives show it', 'band'], ['after', 'by the model', 'dashed']), figures);
}
