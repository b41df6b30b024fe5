// The vehicle from above, ahead upwards: wheels in the colours of their verdicts, anti-roll bars between them.

const DRAWING = {
  width: 360,
  track: 100,   // largest distance between left and right [px]; the rest is for names
  length: 300,  // between the first and the last axle
  spacing: 42,  // least of two names on one side
  margin: 62,   // ahead of the first axle and behind the last
  letters: 14,
};

/** A part of a drawing. */
const drawn = (tag, attributes, ...children) =>
    filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);

/** Ahead and to the left, by what the struts are called: "rear_left", "rl", "axle_2_right"; axles by name. */
function placesByName(names) {
  const side = /left|right|(?<=^[fmrb]|_)[lr]$/i;
  const lefts = names.map(name => ({l: 0.5, r: -0.5}[(name.match(side) || [''])[0].charAt(0).toLowerCase()] || 0));
  const axles = names.map(name => name.replace(side, '*'));
  const rank = axle => (/front|^f/i.test(axle) ? -1 : /rear|back|^[rb]/i.test(axle) ? 1 : 0);
  const inOrder = [...new Set(axles)].sort((a, b) => rank(a) - rank(b) || a.localeCompare(b, 'en', {numeric: true}));
  return names.map((_, i) => ({ahead: -1.5 * inOrder.indexOf(axles[i]), left: lefts[i]}));
}

const havePositions = struts => struts.every(({position}) => position);

const placesOf = struts =>
    (havePositions(struts) ? struts.map(({position: [ahead, left]}) => ({ahead, left})) :
                             placesByName(struts.map(({name}) => name)));

/** The least distance of two of these numbers that differ. */
function leastGap(numbers) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return Math.min(...sorted.slice(1).map((each, i) => each - sorted[i]).filter(gap => gap > 1e-3));
}

/** Pixels of places; to scale, unless names would lie on one another. */
function layOut(places) {
  const span = key => Math.max(...places.map(each => each[key])) - Math.min(...places.map(each => each[key]));
  const middle = key => Math.max(...places.map(each => each[key])) - span(key) / 2;
  const scale = Math.min(DRAWING.track / span('left'), DRAWING.length / span('ahead'));
  const onRight = places.map(({left}) => left <= middle('left') + 1e-6);
  const ofSide = right => places.filter((_, i) => onRight[i] === right).map(({ahead}) => ahead);
  const least = DRAWING.spacing / Math.min(leastGap(ofSide(true)), leastGap(ofSide(false)));
  const across = Number.isFinite(scale) ? scale : 0;
  const along = Math.min(Math.max(across, least), 900 / (span('ahead') || 1));
  const height = 2 * DRAWING.margin + along * span('ahead');
  return {
    height,
    pixels: places.map(({ahead, left}, i) => ({
                         x: DRAWING.width / 2 - across * (left - middle('left')),
                         y: height / 2 - along * (ahead - middle('ahead')),
                         onRight: onRight[i]
                       }))
  };
}

/** Half of the body's width. */
const halfWidth = pixels => Math.max(30, 16 + Math.max(...pixels.map(({x}) => Math.abs(x - DRAWING.width / 2))));

function outline(half, height) {
  const centre = DRAWING.width / 2;
  const sides = {x: centre - half, y: 6, width: 2 * half, height: height - 12, rx: Math.min(34, half)};
  return [
    drawn('rect', {class: 'body-outline', ...sides}),
    drawn('path', {class: 'front-mark', d: `M${centre - 9} 25 l9 -9 l9 9`}, drawn('title', {}, 'ahead'))
  ];
}

/** Names differ at their ends. */
const fitting = name =>
    (name.length > DRAWING.letters ? `${name.slice(0, 5)}…${name.slice(6 - DRAWING.letters)}` : name);

/** A wheel, and beside the body its name and verdict. */
function wheel({name, verdict, selected, reason}, {x, y, onRight}, half) {
  const aside = DRAWING.width / 2 + (onRight ? 1 : -1) * (half + 7);
  const at = {x: aside, 'text-anchor': onRight ? 'start' : 'end'};
  const word = verdictWord(verdict, selected.length);
  const parts = [
    drawn('title', {}, `${spoken(name)}: ${word}`),
    drawn('rect', {class: 'wheel', x: x - 9, y: y - 19, width: 18, height: 38, rx: 6}),
    drawn('text', {...at, y: y - 2}, fitting(spoken(name))), drawn('text', {...at, y: y + 13, class: 'word'}, word)
  ];
  const marks = {'data-strut': name, 'data-verdict': verdict, 'data-x': x.toFixed(1), 'data-y': y.toFixed(1)};
  return reason ? drawn('g', marks, parts) : drawn('a', {...marks, href: `${name}/report.html`}, parts);
}

function antiRollBar({struts: tied}, struts, pixels) {
  const [from, to] = tied.map(name => pixels[struts.findIndex(strut => strut.name === name)]);
  const level = Math.abs(from.y - to.y) < 12;
  return drawn(
      'g', {'data-bar': tied.join(' ')}, drawn('line', {class: 'bar-line', x1: from.x, y1: from.y, x2: to.x, y2: to.y}),
      level ? drawn(
                  'text', {class: 'muted', x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 - 9, 'text-anchor': 'middle'},
                  'anti-roll bar') :
              drawn('title', {}, 'anti-roll bar'));
}

function vehicleDrawing({struts, anti_roll_bars: bars}) {
  const {pixels, height} = layOut(placesOf(struts));
  const half = halfWidth(pixels), name = 'the vehicle from above';
  const svg = drawn(
      'svg', {viewBox: `0 0 ${DRAWING.width} ${height.toFixed(1)}`, role: 'img', 'aria-label': name},
      outline(half, height), bars.map(bar => antiRollBar(bar, struts, pixels)),
      struts.map((strut, i) => wheel(strut, pixels[i], half)));
  return element('div', {}, svg, element('div', {class: 'saving'}, pictureButton(name, () => saveDrawing(name, svg))));
}
