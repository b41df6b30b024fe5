// A window in time that several plots share.

/** An axis of time in s, min or h. */
class TimeAxis extends Axis {
  setDomain(domain) {
    this.domain = domain;
    const last = domain[1];
    this.scale = last < 600 ? {factor: 1, unit: 's'} :
        last < 3 * 3600     ? {factor: 1 / 60, unit: 'min'} :
                              {factor: 1 / 3600, unit: 'h'};
  }
}

/** Plots over time that show the same window of it. */
class TimeWindow {
  /** @param duration  of all that there is to show. */
  constructor(duration) {
    Object.assign(this, {duration, plots: [], window: [0, duration]});
  }

  /** Begins with these plots. */
  begin(plots) {
    this.plots = plots;
    for (const plot of plots) listenZoom(plot, this);
    this.show(this.whole);
  }

  get whole() {
    return [0, this.duration];
  }

  axis() {
    return new TimeAxis({title: 'time', unit: 's', domain: this.whole});
  }

  toolbar() {
    return element(
        'div', {class: 'toolbar'}, toolButton('−', () => this.zoom(2), 'show more'),
        toolButton('+', () => this.zoom(0.5), 'show less'),
        toolButton('whole drive', () => this.show(this.whole), 'everything'));
  }

  show([from, to]) {
    const length = Math.min(this.duration, Math.max(Math.min(this.duration, 2), to - from));
    const start = Math.max(0, Math.min(this.duration - length, (from + to - length) / 2));
    this.window = [start, start + length];
    for (const plot of this.plots) {
      plot.x.setDomain(this.window);
      plot.draw();
    }
  }

  zoom(factor, centre = (this.window[0] + this.window[1]) / 2) {
    this.show(this.window.map(edge => centre + factor * (edge - centre)));
  }

  move(seconds) {
    this.show(this.window.map(edge => edge + seconds));
  }
}
