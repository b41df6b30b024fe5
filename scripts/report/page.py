"""The page: sections of text, figures and tables, in one file that needs nothing else."""
import dataclasses
import html
import os
import pathlib
import tempfile

STYLE = pathlib.Path(__file__).with_name("page.css")


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
    """A heading, paragraphs of HTML, then figures side by side where there is room, then tables."""
    title: str
    paragraphs: tuple = ()
    figures: tuple = ()
    tables: tuple = ()

    def to_html(self):
        parts = [f"<h2>{html.escape(self.title)}</h2>", *(f"<p>{paragraph}</p>" for paragraph in self.paragraphs)]
        if self.figures:
            parts += ['<div class="figures">', *(figure.to_html() for figure in self.figures), "</div>"]
        return "\n".join(["<section>", *parts, *(table.to_html() for table in self.tables), "</section>"])


def page(title, sections):
    """The whole page; the first section stands under the title."""
    body = "\n".join(section.to_html() for section in sections)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<style>
{STYLE.read_text()}</style>
</head>
<body>
<h1>{html.escape(title)}</h1>
{body}
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
