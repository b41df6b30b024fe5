// Puts the page of curves together: of every strut what it does, and did on another drive.

const NO_CURVES = 'The drives do not tell the curves.';

function strutCurvesSection({strut, damper_curve: damper, spring_curve: spring, against}) {
  const linesOf = (now, name) =>
      [{...now, label: 'this drive', colour: 'after'},
       ...(against ? [{...against[name], label: against.bag, colour: 'before'}] : [])];
  return section(
      strut ? `curves-${strut}` : 'curves', capitalised(spoken(strut)) || 'Damper and spring', null,
      against && against.change ? element('p', {class: 'answer'}, `${capitalised(typeset(against.change))}.`) : null,
      curveFigures(linesOf(damper, 'damper_curve'), linesOf(spring, 'spring_curve')) || element('p', {}, NO_CURVES));
}

function buildCurvesPage() {
  const findings = readFindings();
  const {struts, source} = findings;
  const other = struts[0].against;
  const title = other ? `Damper and spring against ${other.bag}` : 'Damper and spring';
  showPage(title, [
    element(
        'section', {id: 'verdict'}, element('p', {class: 'source'}, source), element('h1', {}, title),
        element('p', {class: 'lede'}, CURVES_LEDE),
        legend(['after', 'this drive', 'band'], ...(other ? [['before', other.bag, 'band']] : []))),
    struts.map(strutCurvesSection),
    originSection(findings, 'Forces are per unit of the body’s mass. Everything on this page is in this one file.')
  ]);
}

buildCurvesPage();
