// The address after # is the strut that is shown.

const shown = () => data.struts[Number(location.hash.slice(1)) - 1];

function showAddressed() {
  if (!shown()) return;
  showStrut(shown());
  document.getElementById('strut').scrollIntoView({block: 'start'});
  document.getElementById('strut').focus({preventScroll: true});
}

function draw() {
  drawMap(i => {
    location.hash = address(i);
  });
  if (shown()) showStrut(shown());
}

summarise();
listStruts();
draw();
addEventListener('hashchange', showAddressed);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
document.documentElement.dataset.ready = 'yes';
