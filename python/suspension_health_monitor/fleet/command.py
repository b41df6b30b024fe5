"""suspension_fleet: the command line."""
import argparse
import hashlib
import os
import shutil
import signal
import sys

from . import database
from .errors import FleetError, UsageError
from .find_bags import FOLDER_OF_THE_BAG

EPILOG = "doc/fleet.md tells more. Exit status: 0 done, 2 wrong usage, 3 unreadable or wrong input."


def parser():
    result = argparse.ArgumentParser(prog="suspension_fleet", description=__doc__.splitlines()[0].split(": ")[1],
                                     epilog=EPILOG)
    commands = result.add_subparsers(dest="command", metavar="COMMAND", required=True)
    _add_scan(commands.add_parser("scan", help="read bags into the database", epilog=EPILOG))
    return result


def _add_scan(scan):
    scan.set_defaults(run=_scan)
    scan.add_argument("paths", nargs="+", metavar="PATH", help="bags, folders with bags below them, or patterns: quote *")
    _add_db(scan)
    scan.add_argument("--vehicle-pattern", metavar="REGEX", default=FOLDER_OF_THE_BAG,
                      help="finds the vehicle's name in a bag's path: its group `vehicle`, or the first; default: the "
                           "folder of the bag, %(default)s")
    scan.add_argument("--vehicle-file", metavar="FILE", help="YAML file with the IMUs of a vehicle (doc/vehicle.md); "
                      "without it a bag is of one strut")
    scan.add_argument("--sprung-topic", metavar="TOPIC", help="of one strut: Imu topic of the body")
    scan.add_argument("--unsprung-topic", metavar="TOPIC", help="Imu topic of the wheel carrier")
    scan.add_argument("--config", metavar="FILE", help="YAML file like config/monitor.yaml")
    scan.add_argument("--set", metavar="NAME=VALUE", action="append", default=[], help="any option of the monitor")
    scan.add_argument("--baseline", metavar="FILE", help="YAML file with the healthy vehicle or strut, to judge by")
    scan.add_argument("--temperature-topic", metavar="TOPIC",
                      help="sensor_msgs/Temperature; {strut} in it stands for the strut's name")
    scan.add_argument("--diagnose", action="store_true", help="search missing effects, too")
    scan.add_argument("--pages", metavar="DIR", help="with --diagnose: write the page of every bag's search below DIR")
    engine = scan.add_mutually_exclusive_group()
    engine.add_argument("--workers", type=_at_least_one, metavar="N", help="processes on this machine; default: its cores")
    engine.add_argument("--scheduler", metavar="tcp://HOST:PORT", help="a dask scheduler that runs")
    scan.add_argument("--time-limit", type=_seconds, metavar="S", default=3600.0,
                      help="[s] for each of identify, health and diagnose of a bag; default: %(default)g")
    scan.add_argument("--again", action="store_true", help="read bags that are known, too")


def _add_db(command):
    command.add_argument("--db", metavar="URL", default="sqlite:///fleet.db",
                         help="of the database, such as postgresql://user@host/fleet; default: %(default)s")


def _at_least_one(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{number}, must be at least 1")
    return number


def _seconds(text):
    number = float(text)
    if not 0.0 < number < float("inf"):
        raise argparse.ArgumentTypeError(f"{text}, must be above 0 s")
    return number


def find_program():
    """suspension_bag: $SUSPENSION_BAG, or where catkin puts it: beside suspension_fleet, or below a workspace."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    places = [os.environ.get("SUSPENSION_BAG"), os.path.join(os.path.dirname(sys.argv[0]), "suspension_bag"),
              *(os.path.join(prefix, "lib/suspension_health_monitor/suspension_bag") for prefix in prefixes),
              shutil.which("suspension_bag")]
    for place in filter(None, places):
        if os.access(place, os.X_OK) and os.path.isfile(place):
            return os.path.abspath(place)
    raise FleetError("suspension_bag is not found: source the workspace's setup.bash, or set SUSPENSION_BAG to its path")


def _work(options):
    from .bag_work import Work
    if options.pages and not options.diagnose:
        raise UsageError("--pages is of --diagnose, must be given with it")
    files = {name: os.path.abspath(path) for name, path in
             (("--vehicle", options.vehicle_file), ("--config", options.config), ("--baseline", options.baseline)) if path}
    baseline = files.get("--baseline")
    texts = (("--sprung-topic", options.sprung_topic), ("--unsprung-topic", options.unsprung_topic),
             *(("--set", each) for each in options.set))
    pairs = [pair for pair in (*files.items(), *texts) if pair[1] is not None and pair[0] != "--baseline"]
    return Work(find_program(), sum(pairs, ()), baseline, tuple(files.values()), options.diagnose,
                options.pages and os.path.abspath(options.pages), options.temperature_topic, options.time_limit)


def _hash(work):
    """Of all options, and of what is in the files that they name."""
    digest = hashlib.sha256(repr(work).encode())
    for path in work.files:
        try:
            with open(path, "rb") as file:
                digest.update(file.read())
        except OSError as error:
            raise FleetError(f"{path}: {error.strerror}") from error
    return digest.hexdigest()[:16]


def _scan(options):
    from .cluster import open_client
    from .find_bags import find_bags, vehicle_pattern
    from .scan import Scan, progress_bar
    work, vehicle_of = _work(options), vehicle_pattern(options.vehicle_pattern)
    token = _hash(work)
    if next(find_bags(options.paths), None) is None:
        raise FleetError(f"{' '.join(options.paths)}: no bag in there")
    if work.pages:
        os.makedirs(work.pages, exist_ok=True)
    engine = database.connect(options.db, create=True)
    with open_client(options.workers, options.scheduler) as client, progress_bar(options.paths) as progress:
        counts = Scan(engine, work, token, vehicle_of, options.again, progress).run(client, find_bags(options.paths))
    print(f"{sum(counts.values())} bags: " + ", ".join(f"{number} {what}" for what, number in sorted(counts.items())))
    print(f"wrote {database.shown(engine)}")


class _Terminated(BaseException):
    """SIGTERM, as Ctrl-C is KeyboardInterrupt."""


def _terminate(*_):
    raise _Terminated


def main(arguments=None):
    """:returns: exit status. Ctrl-C, and SIGTERM, end it as whoever waits for it expects, with a good database."""
    options = parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, _terminate)
    try:
        options.run(options)
    except FleetError as error:
        print(f"suspension_fleet {options.command}: {error}", file=sys.stderr)
        return error.status
    except (KeyboardInterrupt, _Terminated) as interruption:
        number = signal.SIGINT if isinstance(interruption, KeyboardInterrupt) else signal.SIGTERM
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    return 0
