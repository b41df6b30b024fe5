// Puts the page of a vehicle together, section by section.

function buildVehiclePage() {
  const findings = readFindings();
  showPage(spoken(findings.summary), [
    vehicleVerdictSection(findings), couplingSection(findings), forcesSection(findings), strutsSection(findings),
    originSection(
        findings,
        'Forces are per unit of the mass that a strut has of the body. This page needs no other file; those of the ' +
            'struts lie in the folders beside it.')
  ]);
}

buildVehiclePage();
