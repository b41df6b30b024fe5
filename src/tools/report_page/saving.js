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

/** Saves an image on the colour that it stands on: alone it is transparent. */
function savePicture(name, image, width, height) {
  const copy = element('canvas', {width, height});
  const context = copy.getContext('2d');
  context.fillStyle = colour('card');
  context.fillRect(0, 0, copy.width, copy.height);
  context.drawImage(image, 0, 0, copy.width, copy.height);
  copy.toBlob(blob => download(fileName(name, 'png'), blob));
}

/** A drawing alone knows no style sheet: what that makes of its parts goes with them. */
function withItsStyles(svg) {
  const copy = svg.cloneNode(true);
  const originals = svg.querySelectorAll('*');
  copy.querySelectorAll('*').forEach((part, i) => {
    const style = getComputedStyle(originals[i]);
    for (const name of ['fill', 'stroke', 'stroke-width', 'stroke-linecap', 'font', 'text-anchor'])
      part.style.setProperty(name, style.getPropertyValue(name));
  });
  return copy;
}

/** Twice as large as it is shown, for print. */
function saveDrawing(name, svg) {
  const [width, height] = [2 * svg.clientWidth, 2 * svg.clientHeight];
  const copy = filled(withItsStyles(svg), {width, height});
  const image = new Image();
  image.addEventListener('load', () => savePicture(name, image, width, height));
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
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

const saveButton = (text, title, name, save) =>
    element('button', {type: 'button', title, 'aria-label': `${title}: ${name}`, onclick: save}, text);

const pictureButton = (name, save) => saveButton('PNG', 'save the picture', name, save);

function saveButtons(plot) {
  const {name, canvas} = plot;
  const saveNumbers = () => download(fileName(name, 'csv'), new Blob([numbersShown(plot)], {type: 'text/csv'}));
  return element(
      'div', {class: 'saving'}, pictureButton(name, () => savePicture(name, canvas, canvas.width, canvas.height)),
      saveButton('CSV', 'save the numbers', name, saveNumbers));
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
