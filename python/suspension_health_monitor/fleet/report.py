"""suspension_fleet report: a folder with a page of the whole fleet, which needs no server and no network."""
import contextlib
import json
import pathlib
import shutil

from . import outlook
from .errors import naming
from .report_data import page_data
from .whole_file import write_whole

HELP = "write a page of the fleet: a map of all struts, each with its history"
PAGE = pathlib.Path(__file__).with_name("report_page")
SCRIPTS = ("numbers.js", "theme.js", "overview.js", "strut.js", "page.js")


def add_options(report):
    report.add_argument("-o", "--output", metavar="DIR", required=True,
                        help="DIR/index.html with Plotly's script beside it; the folder is made")
    outlook.add_options(report)


def run(options):
    from plotly.offline import get_plotlyjs  # who lacks it hears so before the work, not after it
    histories, its_options = outlook.read(options)
    folder = pathlib.Path(options.output)
    with _folder(folder):
        write(outlook.in_order(histories, its_options, options.workers), get_plotlyjs(), folder)
    return f"wrote {folder / 'index.html'}\n"


@contextlib.contextmanager
def _folder(folder):
    """One that is made goes unless the page gets done. :raises FleetError: it cannot be made."""
    is_new = not folder.exists()
    try:
        with naming(f"{folder}: cannot be made"):
            folder.mkdir(exist_ok=True)
        yield
    except BaseException:
        if is_new:
            shutil.rmtree(folder, ignore_errors=True)
        raise


def write(fleet, plotly, folder):
    """:param fleet: [(StrutHistory, Prognosis or None)], the most urgent first. :param plotly: its script."""
    text = (PAGE / "index.html").read_text(encoding="utf-8")
    # "<" within a string would let a name end the script.
    data = json.dumps(page_data(fleet, folder), separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    scripts = "\n".join((PAGE / name).read_text(encoding="utf-8") for name in SCRIPTS)
    for mark, part in (("/*STYLE*/", (PAGE / "fleet.css").read_text(encoding="utf-8")), ("/*SCRIPTS*/", scripts),
                       ("/*DATA*/", data)):
        text = text.replace(mark, part, 1)
    write_whole(folder / "plotly.min.js", plotly)
    write_whole(folder / "index.html", text)
