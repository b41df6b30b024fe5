// Puts the page together, section by section.

const TERMS =
    'Travel is positive in compression; forces are per unit of the body’s mass, positive upwards. Held out: ' +
    'stretches of the drive that no fit has seen. Everything on this page is in this one file.';

function buildPage() {
  const findings = readFindings();
  const timeView = new TimeView(findings.drives.map(unpackDrive), Boolean(findings.after));
  showPage(headline(findings), [
    dataBox(findings), verdictSection(findings), curveSection(findings), travelSection(findings),
    ladderSection(findings),
    section(
        'time', 'Measured against predicted',
        'The model gets the acceleration of the wheel and predicts that of the body; it never sees the body’s sensor.',
        timeView.content),
    whereSection(findings), mapSection(findings), forceSection(findings), spectrumSection(findings),
    whitenessSection(findings), rankingSection(findings), parameterSection(findings), addingSection(findings),
    originSection(findings, TERMS)
  ]);
}

buildPage();
