"""suspension_fleet report: a folder with a page of the whole fleet, which needs no server and no network."""
import json
import pathlib

from . import outlook
from .errors import FleetError
from .part_wear import Options
from .report_data import page_data

HELP = "write a page of the fleet: a map of all struts, each with its history"
PAGE = pathlib.Path(__file__).with_name("report_page")
SCRIPTS = ("numbers.js", "theme.js", "overview.js", "strut.js", "page.js")


def add_options(report):
    report.add_argument("-o", "--output", metavar="DIR", required=True,
                        help="DIR/index.html with Plotly's script beside it; the folder is made")
    outlook.add_options(report)


def run(options):
    Options.of(options)  # refuses what is not allowed before the folder is made
    folder = pathlib.Path(options.output)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise FleetError(f"{folder}: cannot be made: {error.strerror}") from error
    write(outlook.outlook(options), folder)
    print(f"wrote {folder / 'index.html'}")


def write(fleet, folder):
    """:param fleet: [(StrutHistory, Prognosis or None)], the most urgent first."""
    try:
        from plotly.offline import get_plotlyjs
    except ImportError as error:
        raise FleetError("python3-plotly is not installed: scripts/install_dependencies brings it") from error
    text = (PAGE / "index.html").read_text(encoding="utf-8")
    # "<" within a string would let a name end the script.
    data = json.dumps(page_data(fleet, folder), separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    scripts = "\n".join((PAGE / name).read_text(encoding="utf-8") for name in SCRIPTS)
    for mark, part in (("/*STYLE*/", (PAGE / "fleet.css").read_text(encoding="utf-8")), ("/*SCRIPTS*/", scripts),
                       ("/*DATA*/", data)):
        text = text.replace(mark, part, 1)
    try:
        (folder / "plotly.min.js").write_text(get_plotlyjs(), encoding="utf-8")
        (folder / "index.html").write_text(text, encoding="utf-8")
    except OSError as error:
        raise FleetError(f"{error.filename}: {error.strerror}") from error
