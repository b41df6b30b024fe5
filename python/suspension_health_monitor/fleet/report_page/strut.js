// The history of one strut.

const WIDTH = 1.645;  // standard deviations of a bar: 90 %

/** Points with bars of a quantity whose logarithm is known. */
function points(time, value, stddev, axes) {
  const middle = value.map(Math.exp);
  return {
    type: 'scatter', mode: 'markers', x: time, y: middle, ...axes,
    hovertemplate: '%{x|%-d %b %Y}: %{y:.4g}<extra></extra>',
    marker: {size: 4, color: colour('points')},
    error_y: {
      type: 'data', symmetric: false, thickness: 0.7, width: 0, color: colour('points'),
      array: value.map((each, i) => Math.exp(each + WIDTH * stddev[i]) - middle[i]),
      arrayminus: value.map((each, i) => middle[i] - Math.exp(each - WIDTH * stddev[i]))
    }
  };
}

function trends(strut) {
  const {from, to, shares} = strut.fan;
  const time = shares[0].map((_, i) => moment(from + (to - from) * i / (shares[0].length - 1)));
  const [low, middle, high] = shares.map(row => row.map(each => each / 10));
  const line = {type: 'scatter', mode: 'lines', hoverinfo: 'skip', xaxis: 'x', yaxis: 'y'};
  const drawn = {color: colour('trend'), width: 2};
  const before = strut.earlier.map(([begin, end, first, last]) => (
      {...line, x: [moment(begin), moment(end)], y: [100 * first, 100 * last], line: drawn}));
  return [
    {...line, x: time, y: low, line: {width: 0}},
    {...line, x: time, y: high, line: {width: 0}, fill: 'tonexty', fillcolor: colour('band')},
    {...line, x: time, y: middle, line: drawn}, ...before
  ];
}

function marks(strut, horizontal) {
  const upright = {type: 'line', yref: 'paper', y0: 0, y1: 1, layer: 'below'};
  const changes = strut.changes.map(([before, after]) => {
    const time = moment((before + after) / 2);
    return {...upright, x0: time, x1: time, line: {color: colour('change'), width: 1.5, dash: 'dot'}};
  });
  return [...changes, {
    type: 'line', xref: 'paper', x0: 0, x1: 1, yref: 'y', y0: horizontal, y1: horizontal,
    line: {color: colour('limit'), width: 1.5, dash: 'dash'}
  }];
}

function drawHistory(strut, place) {
  const {time, damping, stiffness} = unpacked(strut);
  const sign = strut.part === 'damping' ? 1 : -1;
  const ratio = damping.value.map((each, i) => Math.log(100) + sign * (each - stiffness.value[i] - strut.new));
  const spread = damping.stddev.map((each, i) => Math.hypot(each, stiffness.stddev[i]));
  const exponentials = damping.value.map((_, i) => Math.exp(ratio[i]));
  const limit = 100 * (1 - strut.threshold);
  const [other] = ['damping', 'stiffness'].filter(each => each !== strut.part);
  const range = [0.9 * Math.min(limit, ...exponentials), 1.05 * Math.max(100, ...exponentials)];
  const traces = [
    ...trends(strut), points(time, ratio, spread, {xaxis: 'x', yaxis: 'y'}),
    points(time, damping.value, damping.stddev, {xaxis: 'x', yaxis: 'y2'}),
    points(time, stiffness.value, stiffness.stddev, {xaxis: 'x', yaxis: 'y3'})
  ];
  const named = text => ({text, font: {size: 12}});
  Plotly.react(place, traces, layoutOf({
    height: 760, margin: {l: 55, r: 22, t: 22, b: 40}, shapes: marks(strut, limit), dragmode: 'pan',
    xaxis: axis({type: 'date', anchor: 'y3'}),
    yaxis: axis({domain: [0.5, 1], range, title: named(`${strut.part} / ${other} [% of new]`)}),
    yaxis2: axis({domain: [0.25, 0.44], title: named('b1 [1/s]')}),
    yaxis3: axis({domain: [0, 0.19], title: named('b0 [1/s²]')})
  }), settings);
}

const table = (heads, rows) => element(
    'div', {class: 'wide'},
    element('table', {}, element('thead', {}, element('tr', {}, ...heads.map(each => element('th', {}, each)))),
            element('tbody', {}, ...rows.map(row => element('tr', {}, ...row.map(each => element('td', {}, each)))))));

function list(title, heads, rows) {
  return rows.length ? [element('h3', {}, title), table(heads, rows.reverse())] : [];
}

function showStrut(strut) {
  const section = document.getElementById('strut');
  const place = element('div', {id: 'history'});
  const spoken = text => text.replace(/_/g, ' ');
  const found = strut.findings.map(([time, verdict, effects, page]) => [
    dayOf(time), spoken(verdict), spoken(effects), page ? element('a', {href: page}, 'page of the search') : '']);
  section.hidden = false;
  section.replaceChildren(
      element('h2', {}, `${strut.vehicle} ${strut.strut}`), element('p', {class: 'answer'}, strut.outlook),
      ...(strut.remarks ?? []).map(each => element('p', {}, each)),
      ...(strut.effects?.length ? [element('p', {}, `Effects: ${strut.effects.map(spoken).join('; ')}`)] : []),
      ...(strut.count ? [
        place,
        element('p', {class: 'lede'}, 'Bars: 90 % of a drive. Band: what the trend may be, without the season. ' +
            'Dashed: the end of the part. Dotted: a change. b1 and b0 with the payload in them.')
      ] : []),
      ...list('Findings', ['drive', 'verdict', 'effects', ''], found),
      ...list('Health', ['time', 'level', 'reason'], strut.events.map(([time, ...rest]) => [dayOf(time), ...rest])),
      ...(strut.left_out ? [element('p', {class: 'lede'}, `${strut.left_out} older ones are in the database.`)] : []));
  if (strut.count) drawHistory(strut, place);
}
