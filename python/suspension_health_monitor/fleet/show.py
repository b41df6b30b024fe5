"""suspension_fleet show: every strut in a line, the most urgent first."""
import json
import math
import shutil

from . import outlook, wording
from .errors import naming
from .changes import PARTS

HELP = "say what every strut is like, and when it must go to the workshop"
_HEAD = ("vehicle", "strut", "drives", "damping", "stiffness", "outlook", "last event", "effects")
_LEAST_WIDTH = 24  # of a column that is folded


def add_options(show):
    outlook.add_options(show)
    show.add_argument("--json", metavar="FILE", help="write it as JSON instead; -: to standard output")


def run(options):
    fleet = outlook.in_order(*outlook.read(options), options.workers)
    if options.json is None:
        return table(fleet, shutil.get_terminal_size((160, 24)).columns)
    text = json.dumps([as_dict(*pair) for pair in fleet], indent=1, allow_nan=False) + "\n"
    if options.json == "-":
        return text
    with naming(options.json), open(options.json, "w") as file:
        file.write(text)
    return ""


def table(fleet, width):
    """Columns apart by two spaces; the outlook is folded where the terminal is narrow, nothing is cut off."""
    rows = [_HEAD, *([wording.plain(cell) for cell in _row(*pair)] for pair in fleet)]
    folded = _HEAD.index("outlook")
    widths = [max(len(row[i]) for row in rows) for i in range(len(_HEAD))]
    others = sum(widths) - widths[folded] + 2 * (len(_HEAD) - 1)
    widths[folded] = min(widths[folded], max(_LEAST_WIDTH, width - others))
    lines = []
    for row in rows:
        for place, part in enumerate(_fold(row[folded], widths[folded])):
            cells = [part if i == folded else cell if place == 0 else "" for i, cell in enumerate(row)]
            lines.append("  ".join(f"{cell:{size}}" for cell, size in zip(cells, widths)).rstrip())
    return "\n".join(lines) + "\n"


def _fold(text, width):
    lines = [""]
    for word in text.split(" "):
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] += f"{' ' if lines[-1] else ''}{word}"
    return lines


def _row(history, prognosis):
    event = history.last_event
    last = f"{event.level} on {wording.day(event.time)}" if event else "-"
    if prognosis is None:
        return history.vehicle, history.strut, "0", "-", "-", wording.of_strut(history, None), last, "-"
    effects = ", ".join(each.name for each in prognosis.effects if each.present) or "-"
    spans = (wording.span(prognosis.wear[part]) for part in PARTS)
    said = "; ".join([wording.of_strut(history, prognosis), *map(wording.change, prognosis.changes)])
    return history.vehicle, history.strut, str(prognosis.drives), *spans, said, last, effects


def as_dict(history, prognosis):
    """For programs: times in seconds since 1970, shares of 1, rates per month; null where there is none."""
    found = {"vehicle": history.vehicle, "strut": history.strut, "drives": 0, "wrong_clocks": history.wrong_clocks,
             "formerly": [name for name, _ in history.formerly], "perhaps": [*history.perhaps],
             "outlook": wording.of_strut(history, prognosis), "dated": None, "wear": None, "changes": [],
             "likely_change": None, "remarks": [], "effects": [], "last_event": None}
    event = history.last_event
    if event:
        found["last_event"] = {"time": event.time, "level": event.level, "message": event.message, "path": event.path}
    if prognosis is None:
        return found
    return {**found, "drives": prognosis.drives, "dated": prognosis.dated,
            "wear": {part: {"since": each.since, "loss": each.loss, "probability": each.probability["falls"],
                            "laws": each.probability, "rate": each.rate, "rate_stddev": each.rate_stddev,
                            "date": [_time(time) for time in each.date]}
                     for part, each in prognosis.wear.items()},
            "changes": [{"before": each.before, "time": each.time, "step": each.step, "step_stddev": each.step_stddev,
                         "part": each.part} for each in prognosis.changes],
            "likely_change": prognosis.likely_change, "remarks": [wording.change(each) for each in prognosis.changes],
            "effects": [{"name": each.name, "first": each.first, "last": each.last, "present": each.present}
                        for each in prognosis.effects]}


def _time(time):
    return time if math.isfinite(time) else None
