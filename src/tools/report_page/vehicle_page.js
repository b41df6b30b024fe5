// Puts the page of a vehicle together, section by section.

/**
 * The struts in the order of the vehicle, with name and position; of one whose drives are too poor there is a reason.
 */
const strutsOf = ({places, struts}) => places.map(place => ({verdict: 'cannot_tell', ...struts[place.name], ...place}));

function buildVehiclePage() {
  const all = readFindings(), findings = {...all, struts: strutsOf(all)};
  showPage(spoken(findings.summary), [
    dataBox(findings), vehicleVerdictSection(findings), couplingSection(findings), forcesSection(findings),
    strutsSection(findings),
    originSection(
        findings,
        'Forces are per unit of the mass that a strut has of the body. This page needs no other file; those of the ' +
            'struts lie in the folders beside it.')
  ]);
}

buildVehiclePage();
