// Making elements. Text only ever becomes text, never markup: names of files and effects are the user's.

const element = (tag, attributes, ...children) => filled(document.createElement(tag), attributes, children);

function filled(node, attributes = {}, children = []) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === undefined || value === null) continue;
    if (name.startsWith('on'))
      node.addEventListener(name.slice(2), value);
    else
      node.setAttribute(name, value === true ? '' : value);
  }
  node.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined));
  return node;
}

/** A section of the page: heading, a line that says how to read it, content. */
function section(id, title, lede, ...content) {
  return element(
      'section', {id}, element('h2', {}, title), lede ? element('p', {class: 'lede'}, lede) : null, content);
}

/** Heading of a column. */
const head = (text, kind) => element('th', {class: kind}, text);

/** A table that a narrow page may scroll sideways. */
function wideTable(heads, rows, kind = null) {
  return element(
      'div', {class: 'wide'},
      element('table', {class: kind}, element('thead', {}, element('tr', {}, heads)), element('tbody', {}, rows)));
}

/** Names what the colours mean: entries [colour, text, dashed?]. */
function legend(...entries) {
  return element(
      'p', {class: 'legend'},
      entries.map(
          ([colour, text, style = 'solid']) => element(
              'span', {}, element('i', {class: `swatch ${style}`, style: `--colour: var(--${colour})`}), text)));
}

function figure(title, ...content) {
  return element('figure', {}, title ? element('figcaption', {}, title) : null, content);
}

/** `a_name` as people write it. */
const spoken = name => name.replaceAll('_', ' ');

const capitalised = text => text.charAt(0).toUpperCase() + text.slice(1);

const joined = (words, last = 'and') =>
    words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} ${last} ${words[words.length - 1]}`;

/** Figures need to know their width, so they are drawn once they stand in the page. */
const waiting = [];
const whenPlaced = draw => {
  waiting.push(draw);
};
