"""suspension_fleet scan: bags into the database."""
import dataclasses
import hashlib
import itertools
import os

from . import database
from .bag_work import Work
from .errors import FleetError, UsageError, naming
from .find_bags import FOLDER_OF_THE_BAG, find_bags, vehicle_pattern
from .options import above_zero, add_db, at_least_one, find_program
from .progress import bar

HELP = "read bags into the database"


def add_options(scan):
    scan.add_argument("paths", nargs="+", metavar="PATH", help="bags, folders with bags below them, or patterns: quote *")
    add_db(scan)
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
    engine.add_argument("--workers", type=at_least_one, metavar="N", help="processes on this machine; default: its cores")
    engine.add_argument("--scheduler", metavar="tcp://HOST:PORT", help="a dask scheduler that runs")
    scan.add_argument("--time-limit", type=above_zero, metavar="S", default=3600.0,
                      help="[s] for each of identify, health and diagnose of a bag; default: %(default)g")
    scan.add_argument("--again", action="store_true", help="read bags that are known, too")


def _work(options):
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
    digest = hashlib.sha256(repr(dataclasses.replace(work, program="")).encode())
    for path in work.files:
        with naming(path), open(path, "rb") as file:
            digest.update(file.read())
    return digest.hexdigest()[:16]


def run(options):
    from .cluster import open_client  # half a second that a wrong option need not wait for
    from .scan import Scan
    work, vehicle_of = _work(options), vehicle_pattern(options.vehicle_pattern)
    token = _hash(work)
    if next(find_bags(options.paths), None) is None:
        raise FleetError(f"{' '.join(options.paths)}: no bag in there")
    if work.pages:
        with naming(f"--pages {work.pages}"):
            os.makedirs(work.pages, exist_ok=True)
    engine = database.connect(options.db, create=True)
    with bar(sum(1 for _ in find_bags(options.paths))) as progress, database.in_words(engine):
        scan = Scan(engine, work, token, vehicle_of, options.again, progress)
        bags = scan.unknown(find_bags(options.paths))
        first = next(bags, None)
        if first is not None:  # else no cluster is needed
            with open_client(options.workers, options.scheduler) as client:
                scan.read(client, itertools.chain([first], bags))
    found = ", ".join(f"{count} {what}" for what, count in sorted(scan.counts.items()))
    return f"{sum(scan.counts.values())} bags: {found}\nwrote {database.shown(engine)}\n"
