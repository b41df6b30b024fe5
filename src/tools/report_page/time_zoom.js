// Choosing a window in time with the mouse, the finger or buttons.

/**
 * A mouse drags a new window, a finger drags the drive along; a double click shows everything.
 * @param view  {whole, show([from, to]), move(seconds), zoom(factor, centre)}
 */
function listenZoom(plot, view) {
  let from = null;
  const {canvas} = plot;
  const at = event => plot.x.value(event.clientX - canvas.getBoundingClientRect().left);
  canvas.addEventListener('pointerdown', event => {
    from = at(event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', event => {
    if (from === null) return;
    if (event.pointerType === 'touch') {
      view.move(from - at(event));
    } else {
      plot.draw();
      spanLayer([[Math.min(from, at(event)), Math.max(from, at(event))]], 'window')(canvas.getContext('2d'), plot);
    }
  });
  canvas.addEventListener('pointerup', event => {
    const to = at(event);
    const wide = Math.abs(plot.x.pixel(to) - plot.x.pixel(from)) > 6;
    if (event.pointerType !== 'touch' && wide) view.show([Math.min(from, to), Math.max(from, to)]);
    from = null;
  });
  canvas.addEventListener('pointercancel', () => {
    from = null;
  });
  canvas.addEventListener('dblclick', () => view.show(view.whole));
  canvas.addEventListener('wheel', event => {
    if (!event.ctrlKey) return;  // the page scrolls
    event.preventDefault();
    view.zoom(event.deltaY > 0 ? 1.25 : 0.8, at(event));
  }, {passive: false});
}

/** A button of a toolbar. */
const toolButton = (text, action, hint) => element('button', {type: 'button', onclick: action, title: hint}, text);
