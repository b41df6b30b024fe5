// Puts the page of health together, section by section.

function buildHealthPage() {
  const findings = readFindings();
  showPage(headline(findings), [
    healthVerdictSection(findings), courseSection(findings), eventsSection(findings), estimatesSection(findings),
    element(
        'footer', {},
        element(
            'p', {},
            'Made by suspension_bag health, through the code of the live monitor. Everything on this page ' +
                'is in this one file.'))
  ]);
}

buildHealthPage();
