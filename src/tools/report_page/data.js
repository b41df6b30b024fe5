// Whether the data is any good, as `suspension_bag check` says it: the first box of every page.

function dataRow({topic, verdict, rate, lost, noise, gravity, up_axis: up, rms = []}, {delay}) {
  const numbers = [
    isNumber(lost) ? percent(100 * lost) : '–', rounded(noise, 2),
    up ? `${up.replace('-', '−')}, ${isNumber(gravity) ? rounded(gravity) : 'none'}` : '–',
    isNumber(delay) ? (1e3 * delay).toFixed(1).replace('-', '−') : '–',
    rms.map(band => rounded(band.rms, 2)).join(', ') || '–'
  ];
  return element(
      'tr', {'data-imu': topic}, element('td', {}, element('code', {}, topic)),
      element('td', {class: 'number'}, rounded(rate, 4)),
      numbers.map(text => element('td', {class: 'number minor'}, text)),
      element(
          'td', {}, element('b', {class: 'level', 'data-level': verdict === 'OK' ? 'OK' : 'WARN'}, typeset(verdict))));
}

function dataBox({data: {topics, pairs}}) {
  const wrong = topics.filter(({verdict}) => verdict !== 'OK').map(({topic}) => topic);
  const reversed = pairs.filter(pair => pair.reversed).map(({sentence}) => sentence);
  const isFine = !wrong.length && !reversed.length;
  const bands = (topics.find(({rms}) => rms) || {rms: []}).rms.map(({from, to}) => `${from} to ${to}`).join(', ');
  const ofBody = topic => pairs.find(({own, body}) => own && body === topic) || {};
  const count = topics.length > 1 ? `all ${topics.length} IMUs are OK` : 'the IMU is OK';
  return element(
      'details', {id: 'data', 'data-level': isFine ? 'OK' : 'WARN', open: !isFine},
      element(
          'summary', {}, 'Is the data any good? ',
          element(
              'b', {class: 'level'}, isFine ? `Yes: ${count}` : `Look at ${joined(wrong.length ? wrong : reversed)}`)),
      wideTable(
          [
            head('IMU'), head('rate [Hz]', 'number'), head('lost', 'number minor'),
            head('noise at most [m/s²]', 'number minor'), head('up, gravity [m/s²]', 'number minor'),
            head('delay [ms]', 'number minor'), head(`moves at ${bands} Hz [m/s²]`, 'number minor'), head('verdict')
          ],
          topics.map(each => dataRow(each, ofBody(each.topic)))),
      reversed.map(sentence => element('p', {}, `${capitalised(sentence)}.`)),
      element(
          'p', {class: 'lede'},
          'As suspension_bag check judges it. Delay: of the body’s clock against the wheel’s, roughly; moves: rms along ' +
              'the axis that points up, slow, at the body’s bounce and at the wheel’s hop.'));
}
