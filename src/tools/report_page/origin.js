// What a page was made of and by what, for whoever reads it later.

/** "2026-11-23 10:15:00 UTC" */
const asDate = seconds => new Date(1000 * seconds).toISOString().replace('T', ' ').replace(/\..*/, ' UTC');

const YEAR = 365 * 86400;

/** Stamps are seconds since 1970 where a clock was set, else since whatever the drive began. */
const asStamp = seconds => (seconds > YEAR ? asDate(seconds) : `${seconds.toFixed(2)} s`);

/** @param note  what else the reader of this page has to know. */
function originSection({origin}, note) {
  const {made, program, command, topics, from, to} = origin;
  const rows = [
    ['made', `${asDate(made)} by ${program}`], ['command', element('code', {}, command)],
    ['topics', topics.flatMap((topic, i) => [i ? ', ' : '', element('code', {}, topic)])],
    ['stamps', isNumber(from) ? `${asStamp(from)} to ${asStamp(to)}` : null]
  ];
  return element(
      'footer', {id: 'origin'},
      element(
          'dl', {},
          rows.filter(([, content]) => content && content.length !== 0)
              .map(([name, content]) => [element('dt', {}, name), element('dd', {}, content)])),
      element('p', {}, note));
}
