"""What the commands of suspension_fleet share: types of options, the database, the program that reads and writes bags."""
import argparse
import datetime
import os
import shutil
import sys

from .errors import FleetError


def add_db(command):
    command.add_argument("--db", metavar="URL", default="sqlite:///fleet.db",
                         help="of the database, such as postgresql://user@host/fleet; default: %(default)s")


def not_empty(text):
    """Of all that have no other type: an empty path is the folder here for some, and none for others."""
    if not text:
        raise argparse.ArgumentTypeError(f"{text!r}, must not be empty")
    return text


def at_least_one(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{number}, must be at least 1")
    return number


def above_zero(text):
    number = float(text)
    if not 0.0 < number < float("inf"):
        raise argparse.ArgumentTypeError(f"{text}, must be above 0")
    return number


def date(text):
    """Midnight of that day, UTC [s since 1970]."""
    try:
        day = datetime.datetime.strptime(text, "%Y-%m-%d")
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text}, must be a day such as 2026-01-05") from None
    return day.replace(tzinfo=datetime.timezone.utc).timestamp()


def find_program():
    """suspension_bag: $SUSPENSION_BAG, or where catkin puts it: beside suspension_fleet, or below a workspace."""
    named = os.environ.get("SUSPENSION_BAG")
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    places = [os.path.join(os.path.dirname(sys.argv[0]), "suspension_bag"),
              *(os.path.join(prefix, "lib/suspension_health_monitor/suspension_bag") for prefix in prefixes),
              shutil.which("suspension_bag")]
    for place in filter(None, [named] if named else places):
        if os.access(place, os.X_OK) and os.path.isfile(place):
            return os.path.abspath(place)
    if named:
        raise FleetError(f"SUSPENSION_BAG is {named}, must be the path of the program suspension_bag")
    raise FleetError("suspension_bag is not found: source the workspace's setup.bash, or set SUSPENSION_BAG to its path")
