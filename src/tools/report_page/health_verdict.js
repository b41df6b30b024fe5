// What the monitor said, in words: the worst, how it stands at the end, and how long each level held.

const LEVELS = ['OK', 'WARN', 'ERROR', 'STALE'];
const WORST_FIRST = ['ERROR', 'WARN', 'OK', 'STALE'];
const TONES = {
  OK: 'fine',
  WARN: 'open',
  ERROR: 'found',
  STALE: 'floor'
};
const MEANINGS = {
  OK: 'OK',
  WARN: 'warning',
  ERROR: 'error',
  STALE: 'cannot tell'
};

const AREAS = {
  OK: 'ok-area',
  WARN: 'warn-area',
  ERROR: 'error-area',
  STALE: 'stale-area'
};
const levelName = level => (MEANINGS[level] === level ? level : `${level}: ${MEANINGS[level]}`);

/** "12.3 s", "2 min 5 s", "1 h 2 min" */
function span(seconds) {
  if (seconds < 99.95) return `${rounded(seconds, 3)} s`;
  const whole = Math.round(seconds);
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole % 3600 / 60)];
  return hours ? `${hours} h ${minutes} min` : `${minutes} min ${whole % 60} s`;
}

const worstLevel = events => WORST_FIRST.find(level => events.some(each => each.level === level));

// What is still so at the end is told as it is then.
function headline({events, end}) {
  const level = worstLevel(events);
  const first = events.find(each => each.level === level);
  const {elapsed} = first, {message} = end.level === level ? end : first;
  if (level === 'OK') return 'Neither a warning nor an error';
  if (level === 'STALE') return 'The monitor could not tell';
  return typeset(`${capitalised(MEANINGS[level])} after ${span(elapsed)}: ${message.split(';')[0]}`);
}

/** A section's id and title, with the strut's name where there are several. */
const idOf = (id, strut, several) => (several ? `${id}-${strut}` : id);
const titleOf = (title, strut, several) => (several ? `${capitalised(spoken(strut))}: ${title.toLowerCase()}` : title);

function levelFigures({seconds, duration}) {
  const one = level => element(
      'div', {style: `--colour: var(--${TONES[level]})`, 'data-seconds': seconds[level], 'data-level': level},
      element('dt', {}, levelName(level)),
      element(
          'dd', {}, span(seconds[level]), ' ',
          element('small', {}, duration > 0 ? percent(100 * seconds[level] / duration) : '')));
  return element('dl', {class: 'figures-row'}, LEVELS.map(one));
}

function healthVerdictSection(findings, several) {
  const {strut, events, end, early_warnings: early, judged_by: reference} = findings;
  const worst = worstLevel(events);
  return element(
      'section', {id: idOf('verdict', strut, several), class: 'verdict', 'data-level': worst},
      element(
          'p', {class: 'source'},
          `${several ? '' : `${strut ? `${spoken(strut)} in ` : ''}${findings.source}, `}horizon ${
              quantity(findings.horizon, 's')}`),
      element(
          several ? 'h2' : 'h1', {},
          several ? `${capitalised(spoken(strut))}: ` : [element('span', {class: 'pill'}, worst), element('br')],
          headline(findings)),
      element('p', {class: 'answer'}, element('b', {}, `At the end ${end.level}: `), `${typeset(end.message)}.`),
      element('p', {}, `Judged by ${typeset(reference)}.`),
      early.length ? element(
                         'p', {},
                         `Early warning${early.length > 1 ? 's' : ''} after ${
                             joined(early.slice(0, 5).map(({elapsed}) => span(elapsed)))}${
                             early.length > 5 ? `, ${early.length} in all` : ''}.`) :
                                                null,
      levelFigures(findings));
}
