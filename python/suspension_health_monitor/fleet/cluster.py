"""The engine: Dask distributed, a cluster on this machine or a scheduler that runs somewhere."""
import asyncio
import concurrent.futures
import contextlib
import itertools
import logging
import os
import sys
import tempfile

import dask
import distributed
from distributed.scheduler import KilledWorker

from . import interruptions
from .bag_work import read_bag
from .drive import UNREAD, Drive
from .errors import FleetError

PER_THREAD = 2  # bags under way for each thread: one that is read, one that waits for it
# What a scheduler keeps of tasks that are done; by default the last 100 000, which is memory that grows with a scan.
# Newer Dask has one name for two of them, and warns of the former ones.
_LOGS = ({"distributed.admin.low-level-log-length"} if dask.config.get("distributed.admin.low-level-log-length", None)
         else {"distributed.scheduler.transition-log-length", "distributed.scheduler.events-log-length"})
KEPT = {**dict.fromkeys(_LOGS, 100), "distributed.admin.log-length": 100,
        "distributed.diagnostics.computations.max-history": 1}
# How often Dask looks at itself: by default 50 times a second in every process, which is a tenth of what the bags take.
WATCHED = {"distributed.admin.tick.interval": "1s", "distributed.admin.system-monitor.interval": "10s",
           "distributed.worker.profile.interval": "24h",
           "distributed.worker.profile.cycle": "24h", "distributed.worker.memory.spill": False,
           "distributed.diagnostics.computations.ignore-modules": [""]}  # all: the source of who submits is not looked up


@contextlib.contextmanager
def open_client(workers=None, scheduler=None, patience=60):
    """A client of a cluster of so many processes, each of one thread, or of a scheduler.

    :param patience: [s] that a scheduler may be away, such as while it is started anew.
    :raises FleetError: no scheduler answers.
    """
    for name in ("distributed", "distributed.client", "tornado", "tornado.application", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # what matters ends in a row, or is raised
    with contextlib.ExitStack() as stack:
        stack.enter_context(dask.config.set({**KEPT, **WATCHED}))
        if scheduler is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="suspension_fleet."))
            with interruptions.held():  # the client ends its workers
                cluster = distributed.LocalCluster(n_workers=workers or os.cpu_count() or 1, threads_per_worker=1,
                                                   memory_limit=0, dashboard_address="127.0.0.1:0",
                                                   local_directory=folder, silence_logs=logging.CRITICAL)
                scheduler = stack.enter_context(contextlib.closing(cluster))
        try:
            client = distributed.Client(scheduler, timeout=patience)
        except (OSError, ValueError) as error:
            raise FleetError(f"no scheduler at {scheduler}: {error}") from error
        stack.enter_context(contextlib.closing(client))
        if not client.nthreads():
            print(f"no worker at {scheduler} yet: waiting", file=sys.stderr)
        yield client


def read_bags(client, bags, work):
    """Reads bags on the cluster, a bounded number at a time. A bag whose worker, or scheduler, is lost is read again.

    :param bags: of type Bag, taken as there is room for them.
    :returns: (Bag, Drive) of each, in the order in which they are done; (Bag, None) of one that is read already, by
        another path.
    :raises FleetError: what is no matter of a bag; or the scheduler is gone for good.
    """
    bags = iter(bags)
    under_way = {}
    finished = distributed.as_completed()

    def submit(bag):
        under_way[bag.key] = bag
        # By content and options: clients of one scheduler that ask for the same get the same.
        finished.add(client.submit(read_bag, bag.path, bag.key, work, key=f"bag-{bag.options}-{bag.key}"))

    while True:
        for bag in itertools.islice(bags, _room(client, under_way)):
            if bag.key in under_way:
                yield bag, None
            else:
                submit(bag)
        if not under_way:
            return
        future = next(finished)
        bag = under_way.pop(future.key.rpartition("-")[2])
        drive = _outcome(future)
        if drive is not None:
            yield bag, drive
        elif client.status in ("running", "connecting"):
            submit(bag)
        else:
            raise FleetError("the scheduler is gone; what has been read is in the database, the next scan goes on from there")


def _room(client, under_way):
    try:
        threads = sum(client.nthreads().values()) if client.status == "running" else 0
    except OSError:  # the scheduler is lost just now
        threads = 0
    return max(0, PER_THREAD * max(1, threads) - len(under_way))


def _outcome(future):
    """A Drive; None if it has been lost with its worker or scheduler."""
    if future.status == "error":
        error = future.exception()
        if isinstance(error, FleetError):
            raise error
        if isinstance(error, KilledWorker):
            return Drive(UNREAD, "the workers that were to read it have ended")
        return Drive(UNREAD, f"{type(error).__name__}: {error}")
    try:
        return future.result() if future.status == "finished" else None
    except (OSError, asyncio.CancelledError, concurrent.futures.CancelledError):
        return None
