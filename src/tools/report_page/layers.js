// What figures are made of: lines, bands, marks. Each returns a layer for Plot.

/** A line through (xs[i], ys[i]); where ys is no number it is interrupted. */
function lineLayer(xs, ys, colourName, {width = 1.8, dash = [], label} = {}) {
  return telling((context, plot) => {
    context.strokeStyle = colour(colourName);
    context.lineWidth = width;
    context.lineJoin = 'round';
    context.setLineDash(dash);
    context.beginPath();
    let drawing = false;
    for (let i = 0; i < xs.length; ++i) {
      const shown = isNumber(ys[i]) && (!plot.y.log || ys[i] > 0) && (!plot.x.log || xs[i] > 0);
      if (shown) context[drawing ? 'lineTo' : 'moveTo'](plot.x.pixel(xs[i]), plot.y.pixel(ys[i]));
      drawing = shown;
    }
    context.stroke();
  }, () => Array.from(xs, (x, i) => [seriesName(label, colourName), x, ys[i]]));
}

/** The area between two curves. */
function bandLayer(xs, low, high, colourName, opacity = 0.18) {
  return telling((context, plot) => {
    context.fillStyle = colour(colourName);
    context.globalAlpha = opacity;
    context.beginPath();
    xs.forEach((x, i) => context[i ? 'lineTo' : 'moveTo'](plot.x.pixel(x), plot.y.pixel(high[i])));
    for (let i = xs.length - 1; i >= 0; --i) context.lineTo(plot.x.pixel(xs[i]), plot.y.pixel(low[i]));
    context.fill();
  }, () => xs.map((x, i) => ['band', x, null, low[i], high[i]]));
}

/** Dots with bars from low to high. */
function dotLayer(points, colourName, label) {
  return telling((context, plot) => {
    context.strokeStyle = context.fillStyle = colour(colourName);
    for (const {x, y, low, high} of points) {
      const [px, py] = [plot.x.pixel(x), plot.y.pixel(y)];
      context.globalAlpha = 0.55;
      context.lineWidth = 1.5;
      context.beginPath();
      context.moveTo(px, plot.y.pixel(low));
      context.lineTo(px, plot.y.pixel(high));
      context.stroke();
      context.globalAlpha = 1;
      context.beginPath();
      context.arc(px, py, 3.2, 0, 2 * Math.PI);
      context.fill();
    }
  }, () => points.map(({x, y, low, high}) => [seriesName(label, colourName), x, y, low, high]));
}

/** Horizontal line at a value. */
const levelLayer = (value, colourName, dash = [5, 4]) => (context, plot) =>
    lineLayer(plot.x.domain, [value, value], colourName, {width: 1.2, dash})(context, plot);  // no numbers to save

/** Spans of x, shaded from top to bottom. */
const spanLayer = (spans, colourName) => (context, plot) => {
  context.fillStyle = colour(colourName);
  for (const [from, to] of spans)
    context.fillRect(
        plot.x.pixel(from), plot.y.range[1], plot.x.pixel(to) - plot.x.pixel(from),
        plot.y.range[0] - plot.y.range[1]);
};

/** Index of the value nearest to x in an ascending list. */
function nearestIndex(xs, x) {
  let low = 0, high = xs.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] > x)
      high = middle;
    else
      low = middle;
  }
  return Math.abs(xs[low] - x) <= Math.abs(xs[high] - x) ? low : high;
}
