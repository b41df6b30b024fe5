// How far and how fast the strut moved, as telemetry shows it: share of the time by bin.

const SIDES = {
  compression: 'after',
  rebound: 'before'
};

const barsLayer = (edges, shares) => telling(
    (context, plot) => {
      shares.forEach((share, i) => {
        const [left, right] = [edges[i], edges[i + 1]].map(edge => plot.x.pixel(edge));
        context.fillStyle = colour(edges[i] < 0 ? SIDES.rebound : SIDES.compression);
        context.fillRect(
            left, plot.y.pixel(100 * share), right - left - 1, plot.y.pixel(0) - plot.y.pixel(100 * share));
      });
    },
    () => shares.map(
        (share, i) =>
            [edges[i] < 0 ? 'rebound' : 'compression', (edges[i] + edges[i + 1]) / 2, 100 * share, edges[i],
             edges[i + 1]]));

function histogramFigure(title, axis, {edges, shares, ...sides}) {
  const host = element('div');
  const x = new Axis({...axis, domain: ends(edges)});
  whenPlaced(() => new Plot(host, {
                     x,
                     y: new Axis({title: 'share of the time', unit: '%', domain: [0, 105 * Math.max(...shares)]}),
                     height: 200,
                     name: `histogram of ${axis.title}`,
                     layers: [barsLayer(edges, shares)],
                     hover(at) {
                       const i = Math.max(0, edges.findIndex(edge => edge > at) - 1);
                       return {
                         title: `${x.show(edges[i])} to ${x.show(edges[i + 1])}`,
                         rows: [['of the time', percent(100 * shares[i])]]
                       };
                     },
                   }).draw());
  const line = name => `${capitalised(name)} ${percent(100 * sides[name].share)} of the time, on average ${
      x.show(sides[name].mean)}, up to ${x.show(sides[name].largest)}.`;
  return figure(title, host, Object.keys(SIDES).map(name => element('p', {}, line(name))));
}

const stopSentence = ({effect, gap, near, hits}) => `${capitalised(spoken(effect))} at ${quantity(gap, 'm')}: hit ${
    hits} times; ${percent(100 * near)} of the time in the last tenth before it or in it.`;

function travelSection({travel: {travel, travel_rate: rate, stops}}) {
  if (!travel.edges.length) return null;
  return section(
      'travel', 'Travel',
      'How far and how fast the strut moved, by the model: compression to the right, rebound to the left; travel ' +
          'counts from where it rests.',
      legend(...Object.entries(SIDES).map(([name, tone]) => [tone, name, 'area'])),
      element(
          'div', {class: 'pair'}, histogramFigure('Travel rate', AXES.travel_rate, rate),
          histogramFigure('Travel', AXES.travel, travel)),
      stops.map(stop => element('p', {class: 'stop', 'data-hits': stop.hits}, stopSentence(stop))));
}
