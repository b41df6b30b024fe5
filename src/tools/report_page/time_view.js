// Measured against predicted over time: a strip of the whole drive to choose a window from, and that window in
// detail.

class TimeView {
  constructor(drives, hasAfter) {
    Object.assign(this, {drives, hasAfter, index: 0});
    this.drive = drives[0];
    this.window = this.firstWindow();
    const hosts = {
      strip: element('div', {
        class: 'strip',
        tabindex: 0,
        role: 'slider',
        'aria-label': 'window in time; arrow keys move it, plus and minus zoom'
      }),
      signals: element('div', {class: 'zoomable'}),
      residuals: element('div', {class: 'zoomable'})
    };
    const entries = [['measured', 'measured'], ['before', 'model as it is']];
    if (hasAfter) entries.push(['after', 'with the effect', 'dashed']);
    this.content = [
      this.toolbar(), legend(...entries, ['held-out', 'held out: judged, never fitted', 'area']),
      figure('Error over the whole drive: drag the window, or drag in the figures below to zoom', hosts.strip),
      figure('Body acceleration', hosts.signals), figure('Error: measured less predicted', hosts.residuals)
    ];
    whenPlaced(() => this.build(hosts));
  }

  get whole() { return [0, this.drive.duration]; }

  /** Some periods of the strut around the largest error: they tell more than the whole drive. */
  firstWindow() {
    const roomy = Math.max(0.4, Math.min(1, document.documentElement.clientWidth / 900));  // fewer periods on a phone
    const span = Math.min(this.drive.duration, this.drive.view_span * roomy);
    const centre = Math.min(Math.max(this.drive.view_centre, span / 2), this.drive.duration - span / 2);
    return [centre - span / 2, centre + span / 2];
  }

  toolbar() {
    const bar = element(
        'div', {class: 'toolbar'}, toolButton('−', () => this.zoom(2), 'show more'),
        toolButton('+', () => this.zoom(0.5), 'show less'),
        toolButton('largest error', () => this.show(this.firstWindow()), 'where the model fails most'),
        toolButton('whole drive', () => this.show(this.whole), 'everything'));
    if (this.drives.length > 1)
      bar.prepend(element(
          'select', {'aria-label': 'drive', onchange: event => this.choose(Number(event.target.value))},
          this.drives.map((drive, i) => element('option', {value: i}, drive.name))));
    return bar;
  }

  build(hosts) {
    const drive = () => this.drive;
    const heldOut = (context, plot) => spanLayer(this.drive.held_out, 'held-out')(context, plot);
    const after = (name, style) => (this.hasAfter ? [seriesLayer(drive, name, 'after', style)] : []);
    const time = (domain) => new Axis({title: 'time', unit: 's', domain, prefix: this.drive.duration < 0.1});
    const plot = (host, title, height, names, layers, domain) => new Plot(host, {
      x: time(domain),
      y: new Axis({title, unit: 'm/s^2', domain: [-1, 1]}),
      height,
      layers: [heldOut, ...layers],
      name: title,
      hover: x => this.readings(x, names)
    });
    this.strip = plot(
        hosts.strip, 'error', 110, ['residual_before', 'residual_after'],
        [
          seriesLayer(drive, 'residual_before', 'before', {width: 1, opacity: 0.8}),
          ...after('residual_after', {width: 1}), (context, strip) => this.drawWindow(context, strip)
        ],
        this.whole);
    this.signals = plot(
        hosts.signals, 'acceleration', 280, ['measured', 'before', 'after'],
        [
          seriesLayer(drive, 'measured', 'measured', {width: 4.5, opacity: 0.4}),
          seriesLayer(drive, 'before', 'before'), ...after('after', {dash: [5, 3]})
        ],
        this.window);
    this.residuals = plot(
        hosts.residuals, 'error', 190, ['residual_before', 'residual_after'],
        [levelLayer(0, 'muted', []), seriesLayer(drive, 'residual_before', 'before'), ...after('residual_after')],
        this.window);
    this.listenStrip(hosts.strip);
    for (const each of [this.signals, this.residuals]) listenZoom(each, this);
    this.choose(0);
  }

  choose(index) {
    this.index = index;
    this.drive = this.drives[index];
    this.strip.x.setDomain(this.whole);
    this.strip.y.setDomain(padded(extent(this.drive, ['residual_before', 'residual_after'], this.whole)));
    this.show(this.firstWindow());
  }

  show([from, to]) {
    const shortest = Math.min(this.drive.duration, 8 * this.drive.stretches[0].period);
    const span = Math.min(this.drive.duration, Math.max(shortest, to - from));
    const start = Math.max(0, Math.min(this.drive.duration - span, (from + to - span) / 2));
    this.window = [start, start + span];
    for (const [plot, names] of [
             [this.signals, ['measured', 'before', 'after']],
             [this.residuals, ['residual_before', 'residual_after']]]) {
      plot.x.setDomain(this.window);
      plot.y.setDomain(padded(extent(this.drive, names, this.window)));
      plot.draw();
    }
    this.strip.draw();
  }

  zoom(factor, centre = (this.window[0] + this.window[1]) / 2) {
    this.show(this.window.map(edge => centre + factor * (edge - centre)));
  }

  move(seconds) { this.show(this.window.map(edge => edge + seconds)); }

  drawWindow(context, strip) {
    const [left, right] = this.window.map(edge => strip.x.pixel(edge));
    const [bottom, top] = strip.y.range;
    context.fillStyle = colour('window');
    context.fillRect(strip.x.range[0], top, left - strip.x.range[0], bottom - top);
    context.fillRect(right, top, strip.x.range[1] - right, bottom - top);
    context.strokeStyle = colour('ink');
    context.lineWidth = 1.5;
    context.strokeRect(left, top + 1, Math.max(3, right - left), bottom - top - 2);
  }

  listenStrip(host) {
    const centreOn = event => {
      const at = this.strip.x.value(event.clientX - this.strip.canvas.getBoundingClientRect().left);
      this.move(at - (this.window[0] + this.window[1]) / 2);
    };
    host.addEventListener('pointerdown', event => {
      host.setPointerCapture(event.pointerId);
      centreOn(event);
    });
    host.addEventListener('pointermove', event => {
      if (host.hasPointerCapture(event.pointerId)) centreOn(event);
    });
    host.addEventListener('keydown', event => {
      const span = this.window[1] - this.window[0];
      const action = {
        ArrowLeft: () => this.move(-span / 4),
        ArrowRight: () => this.move(span / 4),
        '+': () => this.zoom(0.5),
        '-': () => this.zoom(2)
      }[event.key];
      if (action) {
        event.preventDefault();
        action();
      }
    });
  }

  readings(time, names) {
    const stretch = this.drive.stretches.find(each => time >= each.start && time <= each.end);
    if (!stretch) return null;
    const k = Math.round((time - stretch.start) / stretch.period);
    const labels = {
      measured: 'measured',
      before: 'model as it is',
      after: 'with the effect',
      residual_before: 'error of the model as it is',
      residual_after: 'error with the effect'
    };
    const held = this.drive.held_out.some(([a, b]) => time >= a && time <= b);
    return {
      title: `${rounded(time, 5)} s${held ? ', held out' : ''}`,
      at: time,
      rows:
          names.filter(name => stretch.values[name])
              .map(name => [labels[name], quantity(stretch.values[name][k], 'm/s^2'), name.replace('residual_', '')])
    };
  }
}
