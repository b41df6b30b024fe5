// Numbers and units for people: sensible digits, SI prefixes chosen from the values.

const SUPERSCRIPTS = {
  '-': '⁻',
  0: '⁰',
  1: '¹',
  2: '²',
  3: '³',
  4: '⁴',
  5: '⁵',
  6: '⁶',
  7: '⁷',
  8: '⁸',
  9: '⁹'
};
const superscript = text => [...String(text)].map(c => SUPERSCRIPTS[c]).join('');
const PREFIXES = {
  '-9': 'n',
  '-6': 'µ',
  '-3': 'm',
  0: '',
  3: 'k',
  6: 'M',
  9: 'G'
};

/** "m/s^2" as "m/s²"; the unit "-" is none. */
function prettyUnit(unit) {
  return unit === '-' ? '' : unit.replace(/\^(-?\d+)/g, (_, digits) => superscript(digits)).replaceAll('sqrt', '√');
}

const isNumber = value => typeof value === 'number' && Number.isFinite(value);

/** A number with so many significant digits; a power of ten where it would have many zeros. */
function rounded(value, digits = 3) {
  if (!isNumber(value)) return '–';
  if (value === 0) return '0';
  const power = Math.floor(Math.log10(Math.abs(value)));
  if (power < -4 || power >= 6) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return `${mantissa.replace('-', '−')}·10${superscript(Number(exponent))}`;
  }
  const shown = Number(value.toPrecision(digits));
  return shown.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(shown))))).replace('-', '−');
}

/** value ± stddev, both to the digits that the deviation leaves meaningful. */
function withDeviation(value, stddev) {
  if (!isNumber(value)) return '–';
  if (!isNumber(stddev) || stddev <= 0) return rounded(value, 4);
  const last = Math.floor(Math.log10(stddev)) - 1;
  const power = Math.floor(Math.log10(Math.max(Math.abs(value), stddev)));
  if (last < -7 || power >= 6)
    return `${rounded(value, Math.min(7, Math.max(2, power - last + 1)))} ± ${rounded(stddev, 2)}`;
  const step = 10 ** Math.max(0, last);
  const show = number =>
      (step > 1 ? step * Math.round(number / step) : number).toFixed(Math.max(0, -last)).replace('-', '−');
  return `${show(value)} ± ${show(stddev)}`;
}

/** A scale for values up to `largest` of a unit: {factor, unit}, shown = value * factor. */
function scaleFor(largest, unit) {
  const plain = {factor: 1, unit: prettyUnit(unit)};
  // Accelerations, errors above all, are to be compared at a glance: one unit for all of them.
  const takesPrefix = /^(m|s|Hz|V|N|g)(?=$|[/ ])/.test(unit) && unit !== 'm/s^2';
  if (!takesPrefix || !isNumber(largest) || largest <= 0 || (largest >= 0.1 && largest < 1e4)) return plain;
  const power = Math.max(-9, Math.min(9, 3 * Math.floor(Math.log10(largest) / 3)));
  return {factor: 10 ** -power, unit: PREFIXES[power] + plain.unit};
}

/** "12.3 mm/s²" */
function quantity(value, unit, digits = 3) {
  const scale = scaleFor(Math.abs(value), unit);
  return `${rounded(value * scale.factor, digits)}${scale.unit ? ' ' + scale.unit : ''}`;
}

/** "13.012 ± 0.051 mm" */
function quantityWithDeviation(value, stddev, unit) {
  const scale = scaleFor(Math.abs(value), unit);
  return `${withDeviation(value * scale.factor, stddev * scale.factor)}${scale.unit ? ' ' + scale.unit : ''}`;
}

/** A sentence with plain "m/s^2" in it. */
const typeset = sentence =>
    sentence.replace(/\^(-?\d+)/g, (_, digits) => superscript(digits)).replace(/(^|[\s(])-(?=\d)/g, '$1−');

function percent(value, whole = 9.95) {
  if (!isNumber(value)) return '–';
  return `${
      (Math.abs(value) < whole ? value.toFixed(1) : value.toFixed(0))
          .replace(/^-(0(\.0+)?)$/, '$1')
          .replace('-', '−')}\u00a0%`;
}
