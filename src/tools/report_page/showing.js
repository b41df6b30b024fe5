// Puts the sections of a page into place and draws its figures.

const readFindings = () => JSON.parse(document.getElementById('findings').textContent);

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

function showPage(title, sections) {
  document.title = title;
  document.getElementById('page').append(...sections.flat(Infinity).filter(Boolean));
  for (const draw of waiting) draw();
  noteWhatIsPainted();
  document.documentElement.dataset.ready = 'yes';
}
