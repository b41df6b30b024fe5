// Colours come from the style sheet, so that canvases follow light, dark and paper; every figure redraws itself then.

const figures = [];

const colour = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

function redrawAll() {
  for (const each of figures) each.draw();
}

function onPaper(printing) {
  document.documentElement.classList.toggle('printing', printing);
  redrawAll();
}

matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redrawAll);
addEventListener('beforeprint', () => onPaper(true));
addEventListener('afterprint', () => onPaper(false));

const parseColour = text => [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16));

/**
 * The diverging scale: share in [-1, 1] to a colour; blue below, orange above, which all kinds of sight tell apart.
 */
function divergingScale() {
  const stops = [1, 2, 3, 4, 5].map(i => parseColour(colour(`diverging-${i}`)));
  return share => {
    const position = 2 * (Math.max(-1, Math.min(1, share)) + 1);
    const i = Math.min(3, Math.floor(position));
    const rgb = stops[i].map((from, k) => Math.round(from + (position - i) * (stops[i + 1][k] - from)));
    return `rgb(${rgb.join(',')})`;
  };
}

const tooltip = {
  /** rows: [[name, text], ...] */
  show(event, title, rows) {
    const box = document.getElementById('tooltip');
    box.replaceChildren(
        element('b', {}, title),
        element(
            'dl', {},
            rows.map(
                ([name, text, tone]) =>
                    [element(
                         'dt', {style: tone ? `--colour: var(--${tone})` : null, class: tone ? 'toned' : null}, name),
                     element('dd', {}, text)])));
    box.hidden = false;
    const left =
        event.clientX + 16 + box.offsetWidth > innerWidth ? event.clientX - box.offsetWidth - 16 : event.clientX + 16;
    box.style.left = `${Math.max(4, left)}px`;
    box.style.top = `${Math.max(4, Math.min(innerHeight - box.offsetHeight - 4, event.clientY + 12))}px`;
  },
  hide() { document.getElementById('tooltip').hidden = true; },
};
