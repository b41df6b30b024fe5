// Puts the page together, section by section.

/** Every canvas notes how much of it is painted: a figure that stays empty is a mistake that a test can see. */
function noteWhatIsPainted() {
  for (const canvas of document.querySelectorAll('canvas')) {
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    let painted = 0;
    const colours = new Set();
    for (let i = 0; i < pixels.length; i += 4)
      if (pixels[i + 3] > 0) {
        ++painted;
        colours.add((pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2]);
      }
    canvas.dataset.painted = String(painted);
    canvas.dataset.colours = String(colours.size);
  }
}

const TERMS = 'Travel is positive in compression; forces are per unit of the body’s mass, positive upwards. Held out: ' +
    'stretches of the drive that no fit has seen. Everything on this page is in this one file.';

function buildPage() {
  const findings = JSON.parse(document.getElementById('findings').textContent);
  const timeView = new TimeView(findings.drives.map(unpackDrive), Boolean(findings.after));
  document.title = headline(findings);
  document.getElementById('page').append(
      ...[verdictSection(findings), ladderSection(findings),
          section(
              'time', 'Measured against predicted',
              'The model gets the acceleration of the wheel and predicts that of the body; it never sees the body’s ' +
              'sensor.',
              timeView.content),
          whereSection(findings), mapSection(findings), forceSection(findings), spectrumSection(findings),
          whitenessSection(findings), rankingSection(findings), parameterSection(findings), addingSection(findings),
          element('footer', {}, element('p', {}, TERMS))]
          .filter(Boolean));
  for (const draw of waiting) draw();
  noteWhatIsPainted();
  document.documentElement.dataset.ready = 'yes';
}

buildPage();
