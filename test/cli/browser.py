"""A page as a browser shows it: headless Chromium, without a network."""
import base64
import html.parser
import json
import os
import shutil
import subprocess

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome")
VOID = {"meta", "br", "link", "input", "hr", "img"}


def find_browser():
    """The path of a browser that runs, or nothing. (Ubuntu's chromium-browser is a snap, which needs a daemon.)"""
    for name in NAMES:
        path = shutil.which(name)
        if path and subprocess.run([path, "--version"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   timeout=600).returncode == 0:
            return path
    return None


class Element:
    """One element of the page: tag, attributes, children (elements and text)."""

    def __init__(self, tag, attributes):
        self.tag, self.attributes, self.children = tag, attributes, []

    def all(self, tag=None, **attributes):
        """Every element below of that tag and with those attributes; data_x stands for data-x."""
        wanted = {name.rstrip("_").replace("_", "-"): value for name, value in attributes.items()}
        for child in self.children:
            if isinstance(child, Element):
                if (tag in (None, child.tag)) and all(child.attributes.get(name) == value
                                                      for name, value in wanted.items()):
                    yield child
                yield from child.all(tag, **attributes)

    def one(self, tag=None, **attributes):
        found = list(self.all(tag, **attributes))
        assert len(found) == 1, f"{len(found)} of {tag} {attributes}"
        return found[0]

    @property
    def text(self):
        """What is written in it, except scripts and style."""
        parts = (child if isinstance(child, str) else child.text for child in self.children)
        return "" if self.tag in ("script", "style") else " ".join(" ".join(parts).split())


class Reader(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.root = Element("document", {})
        self.open = [self.root]
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        element = Element(tag, dict(attributes))
        self.open[-1].children.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop().tag == tag

    def handle_data(self, data):
        self.open[-1].children.append(data)


# Notes what is wider than the page, or than the drawing that it is a part of, once the page's own scripts have run. What
# lies in a box that scrolls can be reached. And the words in tables that go on in another line.
MEASURE = """<script>(() => {
const broken = [];
for (const cell of document.querySelectorAll('th, td')) {
  const texts = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
  while (texts.nextNode())
    for (const word of texts.currentNode.data.matchAll(/[\\p{L}\\d.]+/gu)) {
      const range = document.createRange();
      range.setStart(texts.currentNode, word.index);
      range.setEnd(texts.currentNode, word.index + word[0].length);
      if (new Set([...range.getClientRects()].map(box => Math.round(box.top))).size > 1) broken.push(word[0]);
    }
}
const reaches = [...document.querySelectorAll('body *')].filter(node => {
  const box = node.getBoundingClientRect();
  const drawing = node.closest('svg');
  const room = drawing ? drawing.getBoundingClientRect() : {left: 0, right: innerWidth};
  return box.width > 0 && (box.right > room.right + 1 || box.left < room.left - 1) && !node.closest('.wide, #tooltip');
});
Object.assign(parent.document.documentElement.dataset, {
  width: innerWidth,
  dark: matchMedia('(prefers-color-scheme: dark)').matches,
  cut: reaches.map(node => `${node.tagName}.${node.getAttribute('class')}`).join(' '),
  verdictEnds: document.querySelector('#verdict h1, .verdict h1')?.getBoundingClientRect().bottom,
  broken: broken.join(' '),
  scrolls: [...document.querySelectorAll('.wide, .table')].filter(node => node.scrollWidth > node.clientWidth + 1).length
});
})();</script>"""


# Saves every picture and its numbers, and notes what would have come into the downloads. Without waiting for anything:
# the time of a page that is only dumped does not pass.
SAVE = """<script>(() => {
let parts = [];
window.Blob = function(given) { parts = given; };
URL.createObjectURL = () => '#';
URL.revokeObjectURL = () => {};
HTMLAnchorElement.prototype.click = () => {};
HTMLCanvasElement.prototype.toBlob = function(take) { take(new Blob([this.toDataURL('image/png')])); };
const place = document.createElement('pre');
place.id = 'saved';
place.textContent = JSON.stringify([...document.querySelectorAll('.saving')].map(buttons => {
  const figure = {name: buttons.firstChild.getAttribute('aria-label')};
  for (const button of buttons.children) {
    parts = [''];
    button.click();
    figure[button.textContent] = parts[0];
  }
  return figure;
}));
document.body.append(place);
})();</script>"""


def saved(path, profile):
    """What the buttons of every picture save: [{name, PNG: as a data URL, CSV: text}]."""
    profile.mkdir(exist_ok=True)
    (profile / "page.html").write_text(path.read_text().replace("</body>", SAVE + "</body>"))
    return json.loads("".join(shown(profile / "page.html", profile / "browser").one(id="saved").children))


# The same of the drawing, which becomes an image first.
SAVE_DRAWING = """<script>(() => {
HTMLCanvasElement.prototype.toBlob = function() {
  const place = document.createElement('pre');
  place.id = 'saved';
  place.textContent = this.toDataURL('image/png');
  document.body.append(place);
};
document.querySelector('svg').parentNode.querySelector('.saving button').click();
})();</script>"""


def saved_drawing(path, profile):
    """The PNG that the button below the first drawing saves."""
    profile.mkdir(exist_ok=True)
    (profile / "page.html").write_text(path.read_text().replace("</body>", SAVE_DRAWING + "</body>"))
    text = "".join(shown(profile / "page.html", profile / "browser").one(id="saved").children)
    return base64.b64decode(text.split(",")[1])


def measured(path, profile, width, dark):
    """What is cut off at a width [px], in data-cut of the root element. The page is shown in a frame, since a browser's
    window is not made as narrow as a phone's."""
    profile.mkdir(exist_ok=True)
    (profile / "page.html").write_text(path.read_text().replace("</body>", MEASURE + "</body>"))
    (profile / "frame.html").write_text(f'<!DOCTYPE html><html><body><iframe src="page.html" width="{width}" height="900" '
                                        'style="border: 0"></iframe></body></html>')
    return shown(profile / "frame.html", profile / "browser", dark)


def shown(path, profile, dark=False):
    """The page at `path` as it is once its scripts have run. profile: a folder that the browser may write to."""
    browser = find_browser()
    if browser is None:
        pytest.skip("no browser that runs: install chromium to see what the page shows")
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
               "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}", "--window-size=1200,900", "--allow-file-access-from-files",
               f"--blink-settings=preferredColorScheme={0 if dark else 1}", "--virtual-time-budget=5000", "--dump-dom",
               path.as_uri()]
    environment = {**os.environ, "HOME": str(profile)}
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", timeout=600,
                            env=environment)
    assert result.returncode == 0, result.stderr
    return Reader(result.stdout).root
