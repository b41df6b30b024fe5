// All struts at a glance: vehicles by urgency, one line each.

const vehicles = [...new Set(data.struts.map(strut => strut.vehicle))];
const strutNames = [...new Set(data.struts.map(strut => strut.strut))].sort();
const ROW = 20;  // [px]: a line of text
const LETTER = 7;  // [px] wide at most, in the mean of a name

function summarise() {
  const due = data.struts.filter(strut => strut.due).length;
  const those = due === 1 ? 'One strut is' : `${due} struts are`;
  document.querySelector('#fleet h1').textContent =
      due === 0 ? 'No strut is known to be due at the workshop' : `${those} due at the workshop, now or by a date`;
  document.querySelector('#fleet .lede').textContent =
      `${vehicles.length} vehicles, ${data.struts.length} struts, the most urgent vehicle first`;
}

function drawMap(open) {
  const place = document.getElementById('map');
  const index = new Map(data.struts.map((strut, i) => [JSON.stringify([strut.vehicle, strut.strut]), i]));
  const cells = vehicles.map(vehicle => strutNames.map(name => index.get(JSON.stringify([vehicle, name]))));
  const each = pick => cells.map(row => row.map(i => i === undefined ? null : pick(data.struts[i])));
  const due = data.struts.filter(strut => strut.due);
  const scale = [[0, colour('low')], [0.5, colour('middle')], [1, colour('high')]];
  // Plotly would find the margins by drawing several times over, which takes most of the time of a large fleet.
  const widest = names => 10 + LETTER * Math.max(0, ...names.map(name => name.length));
  const left = Math.min(0.4 * place.clientWidth, widest(vehicles));
  const shortened = name => widest([name]) > left + 1 ? `${name.slice(0, Math.floor(left / LETTER) - 2)}…` : name;
  const crowded = widest(strutNames) * strutNames.length > place.clientWidth - left;
  const top = crowded ? Math.min(120, widest(strutNames)) : 30;
  // By number, not by name: Plotly would take names such as 1 and 2 for numbers with room between them.
  const numbered = (names, own) => axis(
      {tickvals: names.map((_, i) => i), ticktext: names.map(escaped), showgrid: false, zeroline: false, ticks: '',
       fixedrange: true, ...own});
  const map = {
    type: 'heatmap', z: each(strut => 100 + (strut.change ?? NaN)), zmin: 60, zmax: 140, colorscale: scale,
    xgap: 2, ygap: 2, text: each(strut => escaped(`${strut.vehicle} ${strut.strut}: ${strut.outlook}`)),
    hovertemplate: '%{text}<extra></extra>', showscale: false
  };
  const rings = {
    type: 'scatter', mode: 'markers', hoverinfo: 'skip',
    x: due.map(strut => strutNames.indexOf(strut.strut)), y: due.map(strut => vehicles.indexOf(strut.vehicle)),
    marker: {symbol: 'circle-open', size: 10, color: colour('ring'), line: {width: 2}}
  };
  const layout = layoutOf({
    height: top + 22 + ROW * vehicles.length, margin: {l: left, r: 22, t: top, b: 22}, clickmode: 'event',
    dragmode: false,
    xaxis: numbered(strutNames, {side: 'top', tickangle: crowded ? -90 : 0, range: [-0.5, strutNames.length - 0.5]}),
    yaxis: numbered(vehicles.map(shortened), {range: [vehicles.length - 0.5, -0.5]})
  });
  Plotly.react(place, [map, rings], layout, {...settings, displayModeBar: false});
  place.removeAllListeners('plotly_click');
  place.on('plotly_click', event => {
    const {x, y} = event.points[0];
    if (cells[y][x] !== undefined) open(cells[y][x]);
  });
}

/** Plotly takes texts for its own markup. */
const escaped = text => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');

const address = i => `#${i + 1}`;

function listStruts() {
  document.querySelector('#list tbody').replaceChildren(...data.struts.map(
      (strut, i) => element(
          'tr', {'data-strut': `${strut.vehicle} ${strut.strut}`},
          element('td', {}, element('a', {href: address(i)}, `${strut.vehicle} ${strut.strut}`)),
          element('td', {class: 'number'}, strut.worn ?? '-'),
          element('td', {}, strut.outlook))));
}
