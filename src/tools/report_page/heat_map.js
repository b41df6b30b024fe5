// A value over a plane, in the diverging scale around zero.

/** Largest size that the scale shows: nearly all cells fit, single wild ones do not wash out the rest. */
function scaleLimit(...matrices) {
  const sizes = matrices.flat(2).filter(isNumber).map(Math.abs).sort((a, b) => a - b);
  return sizes.length ? sizes[Math.floor(0.98 * (sizes.length - 1))] || sizes[sizes.length - 1] || 1 : 1;
}

/** Cells of a matrix[row][column] between edges; empty where the drive never was. */
function cellLayer(map, matrix, limit) {
  const middle = (edges, i) => (edges[i] + edges[i + 1]) / 2;
  const points = () => matrix.flatMap((row, i) => row.map((value, k) => [
    value, middle(map.x_edges, k), middle(map.y_edges, i)
  ])).filter(([value]) => isNumber(value));
  return telling((context, plot) => {
    const colourOf = divergingScale();
    matrix.forEach((row, i) => row.forEach((value, k) => {
      if (!isNumber(value)) return;
      context.fillStyle = colourOf(value / limit);
      const [left, right] = [plot.x.pixel(map.x_edges[k]), plot.x.pixel(map.x_edges[k + 1])];
      const [bottom, top] = [plot.y.pixel(map.y_edges[i]), plot.y.pixel(map.y_edges[i + 1])];
      context.fillRect(left, top, right - left + 0.5, bottom - top + 0.5);
    }));
  }, points);
}

const ends = edges => [edges[0], edges[edges.length - 1]];

/**
 * @param map  {x, y: {title, unit}, x_edges, y_edges, mean[row][column], standard_error?, count?}.
 * @param domains  {x, y}, shared with the map beside it.  @param value  {title, unit, limit} of what is shown.
 */
function heatMap(host, map, domains, value, name) {
  const cell = (edges, at) => edges.findIndex((edge, i) => at >= edge && at <= edges[i + 1]);
  const scale = scaleFor(value.limit, value.unit);
  const show = number => `${rounded(number * scale.factor)} ${scale.unit}`;
  return new Plot(host, {
    x: new Axis({...map.x, domain: domains.x}),
    y: new Axis({...map.y, domain: domains.y}),
    height: 300,
    name,
    valued: `${value.title} [${value.unit}]`,
    layers: [cellLayer(map, map.mean, value.limit)],
    hover(x, y) {
      const [row, column] = [cell(map.y_edges, y), cell(map.x_edges, x)];
      const mean = map.mean[row] && map.mean[row][column];
      if (!isNumber(mean)) return null;
      const rows = [[map.x.title, this.x.show(x)], [map.y.title, this.y.show(y)]];
      if (map.standard_error) rows.push(['standard error', show(map.standard_error[row][column])]);
      rows.push(['samples', String(map.count[row][column])]);
      return {title: `${value.title} ${show(mean)}`, rows};
    },
  });
}

/** The scale of heat maps, with its numbers. */
function scaleBar(title, limit, unit) {
  const scale = scaleFor(limit, unit);
  const end = rounded(limit * scale.factor, 2);
  return element(
      'div', {class: 'scale-bar'}, element('span', {}, `−${end}`), element('i'), element('span', {}, `+${end}`),
      element('span', {class: 'unit'}, `${title} [${scale.unit}]`));
}

/** Maps with one plane and one colour scale, side by side: panels [{name, map}]. */
function mapPair(panels, {title, unit}) {
  const limit = scaleLimit(...panels.map(({map}) => map.mean));
  const across = edges => padded(panels.flatMap(({map}) => ends(map[edges])), 0);
  const domains = {x: across('x_edges'), y: across('y_edges')};
  return [
    element('div', {class: 'pair'}, panels.map(({name, map}) => {
      const host = element('div');
      whenPlaced(() => heatMap(host, map, domains, {title, unit, limit}, `${title}, ${name}`).draw());
      return figure(name, host);
    })),
    scaleBar(title, limit, unit)
  ];
}
