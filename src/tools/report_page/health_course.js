// Levels as a band over time, damping and stiffness below it, all with one window in time.

/** The levels with the times between which they held. */
function levelSpans({events, duration}) {
  return events.map(
      (event, i) => ({...event, from: event.elapsed, to: i + 1 < events.length ? events[i + 1].elapsed : duration}));
}

/** Spans of levels; however short, an event is one pixel wide, and what is worse covers what is not. */
const levelsLayer = spans => telling((context, plot) => {
  const [bottom, top] = plot.y.range;
  for (const level of ['OK', 'STALE', 'WARN', 'ERROR']) {
    context.fillStyle = colour(AREAS[level]);
    for (const {from, to} of spans.filter(each => each.level === level)) {
      const left = plot.x.pixel(from);
      context.fillRect(left, top, Math.max(1, plot.x.pixel(to) - left), bottom - top);
    }
  }
}, () => spans.map(({level, message, from, to}) => [level, from, message, from, to]));

/** Vertical lines. */
const marksLayer = (times, colourName, dash = []) => (context, plot) => {
  context.strokeStyle = colour(colourName);
  context.lineWidth = 1.5;
  context.setLineDash(dash);
  for (const time of times) {
    context.beginPath();
    context.moveTo(plot.x.pixel(time), plot.y.range[0]);
    context.lineTo(plot.x.pixel(time), plot.y.range[1]);
    context.stroke();
  }
};

/** The first and the last index of every stretch of numbers. */
function stretchesOf(values) {
  const stretches = [];
  values.forEach((value, i) => {
    if (!isNumber(value)) return;
    if (i > 0 && isNumber(values[i - 1]))
      stretches[stretches.length - 1][1] = i;
    else
      stretches.push([i, i]);
  });
  return stretches;
}

const INTERVAL = 1.96;  // standard deviations either way: 95 %

/** The band of 95 % of an estimate. */
function intervalLayer(time, {value, stddev}) {
  const layers = stretchesOf(value).map(([first, last]) => {
    const part = series => series.slice(first, last + 1);
    const [values, deviations] = [part(value), part(stddev)];
    return bandLayer(
        part(time), values.map((each, i) => each - INTERVAL * deviations[i]),
        values.map((each, i) => each + INTERVAL * deviations[i]), 'after', 0.25);
  });
  return telling((context, plot) => layers.forEach(layer => {
    context.save();
    layer(context, plot);
    context.restore();
  }), () => layers.flatMap(layer => layer.points()));
}

/** What an axis has to show: nearly all of the estimates and their intervals, the healthy value and its thresholds. */
function domainOf({value, stddev, healthy}, [, error]) {
  const end = (side, share) => {
    const seen = value.map((each, i) => each + side * INTERVAL * stddev[i]).filter((_, i) => isNumber(value[i]));
    return seen.sort((a, b) => a - b)[Math.round(share * (seen.length - 1))];
  };
  const references = healthy.filter(isNumber).flatMap(each => [each * (1 - error), each * (1 + error)]);
  return padded([end(-1, 0.02), end(1, 0.98), ...references]);
}

/** One parameter over time with its healthy value and thresholds. */
function parameterPlot(host, time, parameter, thresholds, axes) {
  const {value, stddev, healthy} = parameter;
  const level = share => healthy.map(each => (isNumber(each) ? each * (1 + share) : null));
  const [warn, error] = thresholds;
  return new Plot(host, {
    x: axes.x,
    y: new Axis({...axes.y, domain: domainOf(parameter, thresholds), prefix: false}),
    height: 250,
    name: `${axes.y.title} over time`,
    layers: [
      marksLayer(axes.marks, 'muted', [2, 4]), intervalLayer(time, parameter),
      ...[-warn, warn].map(share => lineLayer(time, level(share), 'open', {width: 1.3, dash: [6, 4], label: 'warning'})),
      ...[-error, error].map(share => lineLayer(time, level(share), 'found', {width: 1.3, dash: [6, 4], label: 'error'})),
      lineLayer(time, value, 'after', {width: 1.6, label: 'estimate'}),
      lineLayer(time, healthy, 'fine', {width: 1.4, label: 'healthy'})
    ],
    hover(x) {
      const i = nearestIndex(time, x);
      if (!isNumber(value[i])) return {title: `after ${span(x)}`, at: x, rows: [['no valid estimate', '']]};
      const rows = [['estimate', `${withDeviation(value[i], stddev[i])} ${this.y.scale.unit}`, 'after']];
      if (isNumber(healthy[i]))
        rows.push(
            ['healthy', this.y.show(healthy[i], 4), 'fine'], ['change', percent(100 * (value[i] / healthy[i] - 1))]);
      return {title: `after ${span(time[i])}`, at: time[i], rows};
    }
  });
}

const boundaries = ({recordings}) => recordings.slice(1).map(({from}) => from);

const levelLegend = early => legend(
    ...LEVELS.map(level => [AREAS[level], levelName(level), 'area']), ...(early ? [['suspect', 'early warning']] : []));

/** The levels of a strut as a band. */
function bandPlot(host, x, findings) {
  const spans = levelSpans(findings);
  const y = new Axis({title: '', domain: [0, 1]});
  y.ticks = () => [];
  const early = findings.early_warnings.map(({elapsed}) => elapsed);
  return new Plot(host, {
    x,
    y,
    height: 96,
    name: `levels over time${findings.strut ? ` of ${spoken(findings.strut)}` : ''}`,
    layers: [levelsLayer(spans), marksLayer(boundaries(findings), 'ink', [2, 4]), marksLayer(early, 'suspect')],
    hover(at) {
      const here = spans.filter(({from}) => from <= at).pop();
      return here && {title: `${here.level} for ${span(here.to - here.from)}`, at, rows: [[typeset(here.message), '']]};
    }
  });
}

/** Levels, damping and stiffness of one strut. */
function courseFigures(findings) {
  const {course, thresholds, duration} = findings;
  const view = new TimeWindow(duration);
  const hosts = ['band', 'damping', 'stiffness'].map(() => element('div', {class: 'zoomable'}));
  const hasEstimates = course.damping.value.some(isNumber);
  const marks = boundaries(findings);
  const one = (host, name, title, unit) =>
      parameterPlot(host, course.time, course[name], thresholds[name], {x: view.axis(), y: {title, unit}, marks});
  whenPlaced(() => view.begin([
    bandPlot(hosts[0], view.axis(), findings),
    ...(hasEstimates ? [one(hosts[1], 'damping', 'b₁', '1/s'), one(hosts[2], 'stiffness', 'b₀', '1/s^2')] : [])
  ]));
  return [
    view.toolbar(), levelLegend(findings.early_warnings.length), figure('Level', hosts[0]),
    ...(hasEstimates ?
            [
              legend(
                  ['after', 'estimate'], ['after', '95 % interval', 'band'], ['fine', 'healthy'],
                  ['open', 'warning', 'dashed'], ['found', 'error', 'dashed']),
              figure('Damping / mass: shock absorber', hosts[1]),
              figure('Stiffness / mass: spring', hosts[2])
            ] :
            [element('p', {}, 'No estimate was ever valid.')])
  ];
}

function courseSection(findings, several) {
  const drives = findings.recordings.length > 1 ? ' Dotted lines part the recordings.' : '';
  return section(
      idOf('course', findings.strut, several),
      titleOf('Level, damping and stiffness over time', findings.strut, several),
      `Time is what the recordings cover, one after the other.${
          drives} Where an estimate is not valid there is no line.`,
      courseFigures(findings));
}
