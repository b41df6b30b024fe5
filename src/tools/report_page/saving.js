// Every picture can be saved: as it looks, and as the numbers that it shows.

/** Hands a file to the browser's downloads. */
function download(name, blob) {
  const link = element('a', {href: URL.createObjectURL(blob), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const fileName = (title, ending) => `${title.toLowerCase().replace(/[^a-z0-9]+/g, '_')}.${ending}`;

/** The picture on the colour that it stands on: a canvas alone is transparent. */
function savePicture(plot) {
  const copy = element('canvas', {width: plot.canvas.width, height: plot.canvas.height});
  const context = copy.getContext('2d');
  context.fillStyle = colour('card');
  context.fillRect(0, 0, copy.width, copy.height);
  context.drawImage(plot.canvas, 0, 0);
  copy.toBlob(blob => download(fileName(plot.name, 'png'), blob));
}

const csvCell = value => {
  const text = value === null || value === undefined ? '' : String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/** What the layers show, a line per point: its series, place, value, and the ends of its bar where it has one. */
function numbersShown(plot) {
  const named = ({title, unit}) => `${title || 'value'}${unit === '-' ? '' : ` [${unit}]`}`;
  const rows = plot.layers.flatMap(layer => (layer.points ? layer.points() : []));
  const heads = [plot.valued, named(plot.x), named(plot.y), 'low', 'high'];
  return [heads, ...rows].map(row => row.map(csvCell).join(',')).join('\n') + '\n';
}

function saveButtons(plot) {
  const button = (text, title, save) =>
      element('button', {type: 'button', title, 'aria-label': `${title}: ${plot.name}`, onclick: save}, text);
  return element(
      'div', {class: 'saving'}, button('PNG', 'save the picture', () => savePicture(plot)),
      button(
          'CSV', 'save the numbers',
          () => download(fileName(plot.name, 'csv'), new Blob([numbersShown(plot)], {type: 'text/csv'}))));
}

/** A layer that can tell its points: [series, x, y, low, high]. */
const telling = (layer, points) => Object.assign(layer, {points});

/** What the series of a colour are called. */
const SERIES = {
  measured: 'measured',
  before: 'model as it is',
  after: 'with the effect',
  floor: 'noise alone',
  good: 'seen'
};
const seriesName = (label, colourName) => label || SERIES[colourName] || colourName;
