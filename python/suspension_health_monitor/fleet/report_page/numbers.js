// What report_data.py has packed.

const data = JSON.parse(document.getElementById('data').textContent);

/** Text only ever becomes text, never markup: names are the user's. */
function element(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

const moment = seconds => new Date(1000 * seconds).toISOString();
const dayOf = seconds => moment(seconds).slice(0, 10);

/** {time: [ISO], damping: {value, stddev}, stiffness: ...}: natural logarithms of b1 and b0. */
function unpacked(strut) {
  const bytes = Uint8Array.from(atob(strut.drives), letter => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const count = strut.count;
  const numbers = (place, size, read) => Array.from({length: count}, (_, i) => read(count * place + size * i));
  const value = (place, first) =>
      numbers(place, 2, at => first + data.logarithm_step * view.getInt16(at, true));
  const stddev = place => numbers(place, 1, at => data.stddev_least * Math.exp(data.stddev_step * view.getUint8(at)));
  return {
    time: numbers(0, 2, at => moment(strut.from + strut.span * view.getUint16(at, true) / 65535)),
    damping: {value: value(2, strut.first[0]), stddev: stddev(6)},
    stiffness: {value: value(4, strut.first[1]), stddev: stddev(7)}
  };
}
