"""The page: sections of text, figures and tables, in one file that needs nothing else."""
import dataclasses
import html
import os
import pathlib
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
STYLES = (REPOSITORY / "src/tools/report_page/page.css", pathlib.Path(__file__).with_name("page.css"))


@dataclasses.dataclass(frozen=True)
class Figure:
    """name: e.g. "Fig. 3"; caption: what to see, one or two sentences of HTML."""
    svg: str
    name: str
    caption: str

    def to_html(self):
        return (f"<figure>\n{self.svg}\n<figcaption><b>{html.escape(self.name)}</b> {self.caption}</figcaption>\n"
                "</figure>")


@dataclasses.dataclass(frozen=True)
class Section:
    """A heading, paragraphs of HTML, then figures side by side where there is room, then tables.

    level: of the section that stands first and says how it all ended; its heading is that of the page, and its figures
    come before its paragraphs.
    """
    title: str
    paragraphs: tuple = ()
    figures: tuple = ()
    tables: tuple = ()
    level: str = ""

    def heading(self):
        title = html.escape(self.title)
        return f'<h1><span class="pill">{self.level}</span><br>{title}</h1>' if self.level else f"<h2>{title}</h2>"

    def to_html(self):
        paragraphs = [f"<p>{paragraph}</p>" for paragraph in self.paragraphs]
        figures = ['<div class="figures">', *(figure.to_html() for figure in self.figures), "</div>"] if self.figures else []
        parts = [self.heading(), *(figures + paragraphs if self.level else paragraphs + figures)]
        attributes = f' id="verdict" class="verdict" data-level="{self.level}"' if self.level else ""
        return "\n".join([f"<section{attributes}>", *parts, *(table.to_html() for table in self.tables), "</section>"])


def page(title, sections, origin=()):
    """The whole page. origin: (name, text) of what it was made of and by what."""
    body = "\n".join(section.to_html() for section in sections)
    rows = "".join(f"<dt>{html.escape(name)}</dt><dd>{html.escape(text)}</dd>" for name, text in origin)
    style = "\n".join(path.read_text() for path in STYLES)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{html.escape(title)}</title>
<style>
{style}</style>
</head>
<body>
<main>
{body}
<footer id="origin"><dl>{rows}</dl></footer>
</main>
</body>
</html>
"""


def write_whole(path, text):
    """Writes the file whole or not at all: whoever reads it sees the old one or the new one."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=path.name + ".")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
            os.fchmod(file.fileno(), 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
