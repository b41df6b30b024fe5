// Puts the page of health together, section by section.

function buildHealthPage() {
  const findings = readFindings();
  const {struts} = findings;
  const several = struts.length > 1;
  showPage(headlineOf(struts, findings.corners), [
    dataBox(findings), several ? [overviewSection(struts, findings.corners), levelsSection(struts)] : [],
    struts.map(
        strut =>
            [healthVerdictSection(strut, several), courseSection(strut, several), eventsSection(strut, several),
             estimatesSection(strut, several)]),
    originSection(findings, 'Judged through the code of the live monitor. Everything on this page is in this one file.')
  ]);
}

buildHealthPage();
