"""matplotlib figures as inline SVG whose colours are the page's, so that they follow a light or a dark background."""
import html
import io
import itertools
import re

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the choice of the backend)

# Placeholders: each becomes var(--name) of page.css.
COLOURS = {name: f"#0101{index:02x}" for index, name in enumerate(
    ("ink", "muted", "grid", "ls", "la", "truth", "fault", "ok", "warn", "error", "stale"), 1)}
WIDTH = 5.4  # [inch] at this width text keeps its size in a column of the page, and stays readable on a phone
STYLE = {
    "svg.fonttype": "none", "svg.hashsalt": "report", "path.simplify_threshold": 0.3, "font.size": 10.5,
    "text.color": COLOURS["ink"], "axes.labelcolor": COLOURS["ink"], "axes.edgecolor": COLOURS["muted"],
    "xtick.color": COLOURS["ink"], "ytick.color": COLOURS["ink"],
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": COLOURS["grid"],
    "axes.axisbelow": True, "legend.frameon": False, "lines.linewidth": 1.5,
}
numbers = itertools.count(1)


def new_figure(rows, height, **options):
    """(figure, axes) of panels one below the other over a common time axis."""
    with matplotlib.rc_context(STYLE):
        figure, axes = pyplot.subplots(rows, 1, sharex=True, figsize=(WIDTH, height), squeeze=False, **options)
    return figure, list(axes[:, 0])


def name_panel(axis, text):
    """What the panel shows and its unit, where it reads without turning one's head."""
    axis.set_title(text, loc="left", fontsize=10.5)


def finish(figure, axes, description, legend_columns=3, xlabel="time [s]"):
    """The figure as an <svg> element with `description` for readers who do not see it."""
    with matplotlib.rc_context(STYLE):
        axes[-1].set_xlabel(xlabel)
        legends = (axis.get_legend_handles_labels() for axis in axes)
        handles, labels = next((legend for legend in legends if legend[0]), ([], []))
        if handles:
            figure.legend(handles, labels, loc="upper center", ncol=legend_columns, handlelength=1.6, columnspacing=1.4)
        room = 0.3 if handles else 0.0  # [inch] for the legend
        figure.tight_layout(rect=(0, 0, 1, 1 - room / figure.get_figheight()), pad=0.4, h_pad=0.8)
        text = io.StringIO()
        figure.savefig(text, format="svg", transparent=True)
    pyplot.close(figure)
    return inline(text.getvalue(), description)


def inline(svg, description):
    """An <svg> for the inside of a page: own ids, the page's colours and font, no reference to the outside."""
    number = next(numbers)
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", svg).replace("xlink:href", "href")
    svg = re.sub(r'\b(id|href)="(#?)', rf'\1="\g<2>f{number}-', svg).replace("url(#", f"url(#f{number}-")
    svg = re.sub(r"font: (\S+) [^;\"]*", r"font-size: \1", svg)
    for name, colour in COLOURS.items():
        svg = svg.replace(colour, f"var(--{name})")
    svg = re.sub(r'<svg [^>]*viewBox="([^"]*)"[^>]*>',
                 rf'<svg viewBox="\1" role="img" aria-label="{html.escape(description)}">', svg, count=1)
    return "\n".join(line.strip() for line in svg.splitlines() if line.strip())
