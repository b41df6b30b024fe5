// One axis: from values to pixels, and where its ticks stand.

class Axis {
  /** @param title, unit  of the values.  @param domain  [from, to] in that unit.  @param log  a logarithmic axis */
  constructor({title, unit = '-', domain, log = false, prefix = true}) {
    Object.assign(this, {title, unit, log, prefix});
    this.setDomain(domain);
  }

  setDomain(domain) {
    this.domain = domain;
    const largest = Math.max(Math.abs(domain[0]), Math.abs(domain[1]));
    this.scale = this.prefix && !this.log ? scaleFor(largest, this.unit) : {factor: 1, unit: prettyUnit(this.unit)};
  }

  setRange(from, to) { this.range = [from, to]; }

  share(value) {
    const [from, to] = this.domain;
    return this.log ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
  }

  pixel(value) { return this.range[0] + this.share(value) * (this.range[1] - this.range[0]); }

  value(pixel) {
    const share = (pixel - this.range[0]) / (this.range[1] - this.range[0]);
    const [from, to] = this.domain;
    return this.log ? from * (to / from) ** share : from + share * (to - from);
  }

  label() { return this.scale.unit ? `${this.title} [${this.scale.unit}]` : this.title; }

  show(value, digits = 3) {
    return `${rounded(value * this.scale.factor, digits)}${this.scale.unit ? ' ' + this.scale.unit : ''}`;
  }

  ticks(spacing) {
    return this.log ? this.logTicks() :
                      this.linearTicks(Math.max(2, Math.abs(this.range[1] - this.range[0]) / spacing));
  }

  linearTicks(most) {
    const [from, to] = this.domain.map(value => value * this.scale.factor);
    const rough = (to - from) / most;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find(each => 1.4 * each * power >= rough);
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const ticks = [];
    for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i)
      ticks.push({
        value: i * step / this.scale.factor,
        text: (i * step).toFixed(decimals).replace(/^-(?=0*\.?0*$)/, '').replace('-', '−')
      });
    return ticks;
  }

  logTicks() {
    const [from, to] = this.domain;
    const decades = Math.log10(to / from);
    const ticks = [];
    for (let power = Math.floor(Math.log10(from)); power <= Math.ceil(Math.log10(to)); ++power)
      for (const digit of decades < 3.2 ? [1, 2, 5] : [1]) {
        const value = digit * 10 ** power;
        if (value < from * (1 - 1e-9) || value > to * (1 + 1e-9)) continue;
        const text = power >= -3 && power <= 4 ? String(Number(value.toPrecision(1))) :
                                                 `${digit > 1 ? digit + '·' : ''}10${superscript(power)}`;
        ticks.push({value, text});
      }
    return ticks;
  }
}

/** What a force may depend on. */
const AXES = {
  travel: {title: 'travel', unit: 'm'},
  travel_rate: {title: 'travel rate', unit: 'm/s'},
  time: {title: 'time', unit: 's'}
};

/** Somewhat more room than the values need. */
function padded(values, share = 0.06) {
  let low = Infinity, high = -Infinity;
  for (const value of values)
    if (isNumber(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  if (!(high > low)) {
    const middle = Number.isFinite(low) ? low : 0;
    return [middle - 1, middle + 1];
  }
  return [low - share * (high - low), high + share * (high - low)];
}
