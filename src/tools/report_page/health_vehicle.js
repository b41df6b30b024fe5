// All struts of a vehicle at a glance; with one strut there is nothing to add to its own.

/** The strut that was worst, the first of those to be so. */
function worstStrut(struts) {
  const since = ({events}) => events.find(({level}) => level === worstLevel(events)).elapsed;
  const rank = ({events}) => WORST_FIRST.indexOf(worstLevel(events));
  return [...struts].sort((a, b) => rank(a) - rank(b) || since(a) - since(b))[0];
}

/** That of the struts, or of the comparison of the corners over the drive, if that is worse. */
function wholeLevel(struts, corners) {
  const level = worstLevel(worstStrut(struts).events);
  const isWorse = corners && WORST_FIRST.indexOf(corners.level) < WORST_FIRST.indexOf(level);
  return isWorse && corners.level !== 'OK' ? corners.level : level;
}

const cornersSentence = ({message}) => typeset(`Over the drive, ${spoken(message)}`);

function headlineOf(struts, corners) {
  const worst = worstStrut(struts);
  const level = worstLevel(worst.events);
  if (wholeLevel(struts, corners) !== level) return cornersSentence(corners);
  if (struts.length < 2) return headline(worst);
  return level === 'OK' || level === 'STALE' ? `${headline(worst)} at any strut` :
                                               `${capitalised(spoken(worst.strut))}: ${headline(worst)}`;
}

function overviewRow({strut, events, end, seconds, duration}) {
  const worst = worstLevel(events);
  const share = level =>
      element('td', {class: 'number minor'}, duration > 0 ? percent(100 * seconds[level] / duration) : '');
  return element(
      'tr', {'data-strut': strut, 'data-level': worst},
      element('td', {}, element('a', {href: `#verdict-${strut}`}, spoken(strut))),
      element('td', {}, element('b', {class: 'level'}, worst)),
      element('td', {}, element('b', {class: 'level', 'data-level': end.level}, end.level)), LEVELS.map(share));
}

function overviewSection(struts, corners) {
  const worst = wholeLevel(struts, corners);
  return element(
      'section', {id: 'verdict', 'data-level': worst}, element('p', {class: 'source'}, struts[0].source),
      element('h1', {}, element('span', {class: 'pill'}, worst), element('br'), headlineOf(struts, corners)),
      wideTable(
          [head('strut'), head('worst'), head('at the end'), LEVELS.map(level => head(level, 'number minor'))],
          struts.map(overviewRow)),
      corners && headlineOf(struts, corners) !== cornersSentence(corners) ?
          element('p', {class: 'answer'}, `${cornersSentence(corners)}.`) :
          null);
}

/** The levels of all struts, one band below the other, with one window in time. */
function levelsSection(struts) {
  const view = new TimeWindow(struts[0].duration);
  const hosts = struts.map(() => element('div', {class: 'zoomable'}));
  whenPlaced(() => view.begin(struts.map((strut, i) => bandPlot(hosts[i], view.axis(), strut))));
  return section(
      'levels', 'Levels of all struts over time', 'Time is what the recordings cover, one after the other.',
      view.toolbar(), levelLegend(struts.some(({early_warnings: early}) => early.length)),
      struts.map(({strut}, i) => figure(capitalised(spoken(strut)), hosts[i])));
}
