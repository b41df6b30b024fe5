"""A small fleet at the end of the demo: bags of some weeks, scanned, and the page of what they say of every strut."""
import dataclasses
import html
import json
import shutil
import subprocess
import sys

from .accuracy import find_program
from .experiments import RunFailed
from .page import Section
from .table import Column, Table

FOLDER = "fleet"  # of its page, beside the demo's
VEHICLES = 3
DAYS, DAYS_OF_QUICK = 24, 8  # of driving, one a week
# Dampers that wear so fast that weeks show it, more than the seasons can do; the seed decides which.
LAWS = ("--every", "7", "--wearing", "0.2", "--least-wear", "0.12", "--most-wear", "0.16", "--sagging", "0", "--bad", "0.08",
        "--duration", "40", "--seed", "3")
COLUMNS = [Column("vehicle", css="text"), Column("strut", css="text"), Column("outlook", css="text wide")]


@dataclasses.dataclass(frozen=True)
class Fleet:
    """What scan has said first, what show says of every strut, and the true losses by (vehicle, strut) [1/month]."""
    told: str
    struts: list
    losses: dict


def run(output, folder, quick):
    """The page lands in output / FOLDER, the bags in folder, to be deleted again. @throws RunFailed"""
    bags, page = folder / "fleet", output / FOLDER
    shutil.rmtree(bags, ignore_errors=True)
    page.mkdir(parents=True, exist_ok=True)
    database = page / "fleet.db"
    if database.exists():
        database.unlink()
    url = f"sqlite:///{database}"
    days = 7 * (DAYS_OF_QUICK if quick else DAYS)
    _call("simulate", "-o", bags, "--vehicles", VEHICLES, "--days", days, *LAWS)
    told = _call("scan", bags, "--db", url, "--vehicle-file", bags / "vehicle.yaml").splitlines()[0]
    struts = json.loads(_call("show", "--db", url, "--json", "-"))
    _call("report", "--db", url, "-o", page)
    truth = json.loads((bags / "truth.json").read_text())["vehicles"]
    shutil.rmtree(bags)
    return Fleet(told, struts, {(vehicle, strut): row["damping_loss"] for vehicle, each in truth.items()
                                for strut, row in each["struts"].items()})


def _call(*arguments):
    command = [sys.executable, find_program("suspension_fleet"), *arguments]
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        raise RunFailed(f"{' '.join(map(str, command))}: status {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def section(fleet):
    """The fleet in a few words, the struts that wear, and the way to its own page."""
    worn = [row for row in fleet.struts if fleet.losses[row["vehicle"], row["strut"]]]
    return Section("Weeks of a fleet", (
        f"{VEHICLES} robots on four struts each drive once a week, with another load and another temperature every time. "
        f"{len(worn)} of their dampers wear, and some recordings are damaged. <code>suspension_fleet scan</code> reads all "
        f"bags into a database: <b>{html.escape(fleet.told)}</b>.",
        f'<a href="{FOLDER}/index.html">The whole fleet as a page to look at</a>: a map of all struts, each with its history '
        "and when it must go to the workshop."),
        tables=(Table("What it says of those that wear", COLUMNS, [(row["vehicle"], row["strut"], row["outlook"]) for row in worn]),))
