// A canvas with two axes, on which layers draw; sharp on every screen, redrawn when its size or the colours change.

class Plot {
  /**
   * @param host  element that gets the canvas.  @param x, y  Axis.  @param height  of the canvas, CSS pixels.
   * @param layers  functions (context, plot) that draw inside the axes.
   * @param valued  what the first column of the saved numbers has.
   * @param hover  (x, y) => {title, rows, at?} or nothing, for the tooltip.  @param name  for those who cannot see
   *     it.
   */
  constructor(host, {x, y, height = 240, layers, hover, name, valued = 'series', margin = {}}) {
    Object.assign(this, {host, x, y, height, layers, hover, name, valued});
    this.margin = {left: 58, right: 14, top: 10, bottom: 40, ...margin};
    this.canvas = element('canvas', {role: 'img', 'aria-label': name});
    this.cursor = element('div', {class: 'cursor', hidden: true});
    host.classList.add('plot');
    host.append(this.canvas, this.cursor, saveButtons(this));
    if (hover) this.listen();
    figures.push(this);
    new ResizeObserver(() => {
      if (Math.abs(this.host.clientWidth - this.width) > 1) this.draw();
    }).observe(host);
  }

  listen() {
    this.canvas.addEventListener('pointermove', event => {
      const box = this.canvas.getBoundingClientRect();
      const [px, py] = [event.clientX - box.left, event.clientY - box.top];
      const inside = px >= this.x.range[0] && px <= this.x.range[1] && py >= this.y.range[1] && py <= this.y.range[0];
      const found = inside ? this.hover(this.x.value(px), this.y.value(py)) : null;
      if (!found) return this.leave();
      tooltip.show(event, found.title, found.rows);
      this.cursor.hidden = found.at === undefined;
      if (found.at !== undefined) this.placeCursor(found.at);
    });
    this.canvas.addEventListener('pointerleave', () => this.leave());
  }

  placeCursor(value) {
    Object.assign(this.cursor.style, {
      left: `${this.x.pixel(value)}px`,
      top: `${this.margin.top}px`,
      height: `${this.height - this.margin.top - this.margin.bottom}px`
    });
  }

  leave() {
    tooltip.hide();
    this.cursor.hidden = true;
  }

  draw() {
    this.width = this.host.clientWidth;
    if (this.width < 60) return;
    const ratio = Math.max(2, devicePixelRatio || 1);  // at least 2: it may be printed
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    this.canvas.style.height = `${this.height}px`;
    this.x.setRange(this.margin.left, this.width - this.margin.right);
    this.y.setRange(this.height - this.margin.bottom, this.margin.top);
    const context = this.canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.font = `12px ${getComputedStyle(document.body).fontFamily}`;
    this.drawGrid(context);
    context.save();
    context.beginPath();
    context.rect(
        this.x.range[0], this.y.range[1], this.x.range[1] - this.x.range[0], this.y.range[0] - this.y.range[1]);
    context.clip();
    for (const layer of this.layers) {
      context.save();
      layer(context, this);
      context.restore();
    }
    context.restore();
  }

  drawGrid(context) {
    const [left, right] = this.x.range, [bottom, top] = this.y.range;
    context.strokeStyle = colour('line');
    context.fillStyle = colour('muted');
    context.lineWidth = 1;
    const line = (x1, y1, x2, y2) => {
      context.beginPath();
      context.moveTo(x1, y1);
      context.lineTo(x2, y2);
      context.stroke();
    };
    context.textAlign = 'center';
    context.textBaseline = 'top';
    for (const {value, text} of this.x.ticks(74)) {
      const px = Math.round(this.x.pixel(value)) + 0.5;
      line(px, top, px, bottom);
      context.fillText(text, px, bottom + 6);
    }
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const {value, text} of this.y.ticks(42)) {
      const py = Math.round(this.y.pixel(value)) + 0.5;
      line(left, py, right, py);
      context.fillText(text, left - 7, py);
    }
    context.textAlign = 'center';
    context.textBaseline = 'bottom';
    context.fillText(this.x.label(), (left + right) / 2, this.height - 2);
    context.translate(2, (top + bottom) / 2);
    context.rotate(-Math.PI / 2);
    context.textBaseline = 'top';
    context.fillText(this.y.label(), 0, 0);
    context.rotate(Math.PI / 2);
    context.translate(-2, -(top + bottom) / 2);
  }
}
