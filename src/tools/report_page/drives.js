// The recorded drives: packed 16-bit numbers to values over time.

/** Base64 of little-endian 16-bit integers, in units of `step`. */
function unpacked({step, packed}) {
  const bytes = Uint8Array.from(atob(packed), c => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({length: bytes.length / 2}, (_, i) => view.getInt16(2 * i, true) * step);
}

/** A stretch without gaps: values[name][k] was at start + k * period. */
class Stretch {
  constructor({start, period, values}) {
    Object.assign(this, {start, period, values: {}});
    for (const [name, series] of Object.entries(values)) this.values[name] = unpacked(series);
    for (const when of ['before', 'after']) {
      const residual = this.values[`residual_${when}`];
      if (residual && !this.values[when])
        this.values[when] = this.values.measured.map((value, k) => value - residual[k]);
    }
    this.size = this.values.measured.length;
    this.end = start + (this.size - 1) * period;
  }

  /** Indices of the samples between two times, one more on either side. */
  within(from, to) {
    return [
      Math.max(0, Math.floor((from - this.start) / this.period)),
      Math.min(this.size, Math.ceil((to - this.start) / this.period) + 2)
    ];
  }
}

const unpackDrive = drive => ({...drive, stretches: drive.stretches.map(each => new Stretch(each))});

/** Smallest and largest value of some series between two times. */
function extent(drive, names, [from, to]) {
  let low = Infinity, high = -Infinity;
  for (const stretch of drive.stretches)
    for (const name of names) {
      const values = stretch.values[name];
      if (!values) continue;
      const [first, last] = stretch.within(from, to);
      for (let k = first; k < last; ++k) {
        if (values[k] < low) low = values[k];
        if (values[k] > high) high = values[k];
      }
    }
  return [low, high];
}

/** One series over time; where several samples share a pixel, from the smallest to the largest. */
function seriesLayer(drive, name, colourName, {width = 1.5, opacity = 1, dash = []} = {}) {
  const points = stretch => Array.from(
      stretch.values[name] || [], (value, k) => [SERIES[colourName], stretch.start + k * stretch.period, value]);
  return telling((context, plot) => {
    context.strokeStyle = colour(colourName);
    context.lineWidth = width;
    context.globalAlpha = opacity;
    context.lineJoin = 'round';
    context.setLineDash(dash);
    const [from, to] = plot.x.domain;
    const per_pixel = (to - from) / (plot.x.range[1] - plot.x.range[0]);
    for (const stretch of drive().stretches) {
      const values = stretch.values[name];
      const [first, last] = stretch.within(from, to);
      if (!values || last - first < 2) continue;
      context.beginPath();
      if (per_pixel < 2 * stretch.period) {
        for (let k = first; k < last; ++k)
          context.lineTo(plot.x.pixel(stretch.start + k * stretch.period), plot.y.pixel(values[k]));
      } else {
        const step = per_pixel / stretch.period;
        for (let begin = first; begin < last; begin += step) {
          let low = Infinity, high = -Infinity;
          const end = Math.min(last, begin + step);
          for (let k = Math.floor(begin); k < end; ++k) {
            if (values[k] < low) low = values[k];
            if (values[k] > high) high = values[k];
          }
          const px = plot.x.pixel(stretch.start + begin * stretch.period);
          context.lineTo(px, plot.y.pixel(low));
          context.lineTo(px, plot.y.pixel(high));
        }
      }
      context.stroke();
    }
  }, () => drive().stretches.flatMap(points));
}
