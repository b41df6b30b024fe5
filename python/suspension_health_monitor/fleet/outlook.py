"""The prognoses of a fleet, the most urgent strut first."""
import concurrent.futures.process
import functools
import math
import os

from . import database, interruptions
from .errors import FleetError
from .options import add_db, at_least_one
from .part_wear import Options
from .progress import bar


def add_options(command):
    add_db(command)
    Options.add_to(command)
    command.add_argument("--renamed", metavar="NEW=OLD", action="append", default=[],
                         help="vehicle NEW is the former OLD; NEW=: it is none of the others")
    command.add_argument("--workers", type=at_least_one, default=os.cpu_count() or 1, metavar="N",
                         help="processes; default: this machine's cores")


def read(options):
    """(histories of the database, options of the prognosis). :raises UsageError: a value that is not allowed."""
    from .renamed import joined  # with SciPy, as below
    its_options = Options.of(options)
    return joined(database.histories(database.connect(options.db)), options.renamed), its_options


def in_order(histories, options, workers):
    """[(StrutHistory, Prognosis or None)]. :raises FleetError: one of the processes has been ended."""
    from .prognosis import prognosis  # with SciPy: a scan need not wait for it
    work = functools.partial(prognosis, options=options)
    results = []
    pool = concurrent.futures.ProcessPoolExecutor(workers, initializer=interruptions.leave_to_parent)
    with bar(len(histories), "strut") as progress, pool:
        try:
            with interruptions.held():
                found = pool.map(work, histories, chunksize=4)
            for result in found:
                progress.update()
                results.append(result)
        except concurrent.futures.process.BrokenProcessPool as error:
            raise FleetError(f"one of {workers} processes has ended, as for want of memory: fewer --workers need "
                             "less") from error
    return sorted(zip(histories, results), key=urgency)


def urgency(pair):
    """By when somebody must look at it: the date's early end, or the error that the health monitor has said and not
    taken back; then by what is worn, then by name."""
    history, result = pair
    when = result.wear[result.dated].date[0] if result and result.dated else math.inf
    if result and result.reached:
        when = min(when, result.last)
    if history.last_event and history.last_event.level == "ERROR":
        when = min(when, history.last_event.time)
    worn = max(each.loss[1] for each in result.wear.values()) if result else -math.inf
    return when, -worn, history.vehicle, history.strut
