// What damper and spring do, as the drives show it, with the model's law over it.

const NINETY_PERCENT = 1.645;  // standard deviations

function curveFigure(title, axis, xs, {force, stddev, law}) {
  const host = element('div');
  const [low, high] = [-1, 1].map(sign => force.map((y, i) => y + sign * NINETY_PERCENT * stddev[i]));
  whenPlaced(() => new Plot(host, {
                     x: new Axis({...axis, domain: ends(xs)}),
                     y: new Axis(
                         {title: 'force per unit mass', unit: 'm/s^2', domain: padded([...low, ...high, ...law])}),
                     height: 280,
                     name: `curve of the ${title.toLowerCase()}`,
                     layers: [
                       levelLayer(0, 'muted', []), bandLayer(xs, low, high, 'good', 0.35),
                       lineLayer(xs, force, 'good', {label: 'as the drives show it'}),
                       lineLayer(xs, law, 'after', {width: 1.4, dash: [5, 4], label: 'by the model'})
                     ],
                     hover(x) {
                       const i = nearestIndex(xs, x);
                       return {
                         title: `${axis.title} ${this.x.show(xs[i])}`,
                         rows: [
                           ['90 % between', `${this.y.show(low[i])} and ${this.y.show(high[i])}`, 'good'],
                           ['by the model', this.y.show(law[i]), 'after']
                         ],
                         at: xs[i]
                       };
                     },
                   }).draw());
  return figure(title, host);
}

function curveSection({curves: {damper, spring}}) {
  const shown = [
    damper.force.length && curveFigure('Damper', AXES.travel_rate, damper.velocity, damper),
    spring.force.length && curveFigure('Spring', AXES.travel, spring.travel, spring)
  ].filter(Boolean);
  if (!shown.length) return null;
  return section(
      'curves', 'Damper and spring',
      'The force of shock absorber and spring as the drives show it, whatever the model says: compression to the ' +
          'right, rebound to the left. The band holds nine tenths of the true law. A constant force cannot be told from an offset of a sensor, so ' +
          'that both curves go through 0.',
      legend(['good', 'as the drives show it', 'band'], ['after', 'by the model', 'dashed']),
      element('div', {class: 'pair'}, shown));
}
