"""The engine: Dask distributed, a cluster on this machine or a scheduler that runs somewhere."""
import contextlib
import itertools
import logging
import os
import signal
import tempfile

import dask
import distributed

from .bag_work import read_bag
from .database import UNREAD, Drive
from .errors import FleetError

PER_THREAD = 2  # bags under way for each thread: one that is read, one that waits for it
# What a scheduler keeps of tasks that are done; by default the last 100 000, which is memory that grows with a scan.
KEPT = {"distributed.scheduler.transition-log-length": 100, "distributed.scheduler.events-log-length": 100,
        "distributed.admin.log-length": 100, "distributed.diagnostics.computations.max-history": 1,
        "distributed.worker.profile.interval": "1 day", "distributed.worker.profile.cycle": "1 day",
        "distributed.worker.memory.spill": False}


@contextlib.contextmanager
def open_client(workers=None, scheduler=None, patience=60):
    """A client of a cluster of so many processes, each of one thread, or of a scheduler.

    :param patience: [s] that a scheduler may be away, such as while it is started anew.
    :raises FleetError: no scheduler answers.
    """
    for name in ("distributed", "distributed.client", "tornado", "tornado.application", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # what matters ends in a row, or is raised
    with contextlib.ExitStack() as stack:
        stack.enter_context(dask.config.set(KEPT))
        if scheduler is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="suspension_fleet."))
            with _deaf_to_interrupts():
                cluster = distributed.LocalCluster(n_workers=workers or os.cpu_count() or 1, threads_per_worker=1,
                                                   memory_limit=0, dashboard_address="127.0.0.1:0",
                                                   local_directory=folder, silence_logs=logging.CRITICAL)
            scheduler = stack.enter_context(contextlib.closing(cluster))
        try:
            client = distributed.Client(scheduler, timeout=patience)
        except (OSError, ValueError) as error:
            raise FleetError(f"no scheduler at {scheduler}: {error}") from error
        yield stack.enter_context(contextlib.closing(client))


@contextlib.contextmanager
def _deaf_to_interrupts():
    """What is started is so for good: Ctrl-C ends the client, and the client ends its workers."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def read_bags(client, bags, work):
    """Reads bags on the cluster, a bounded number at a time. A bag whose worker, or scheduler, is lost is read again.

    :param bags: of type Bag, taken as there is room for them.
    :returns: (Bag, Drive) of each, in the order in which they are done.
    :raises FleetError: what is no matter of a bag; or the scheduler is gone for good.
    """
    bags = iter(bags)
    under_way = {}
    finished = distributed.as_completed()
    while True:
        for bag in itertools.islice(bags, _room(client, under_way)):
            if bag.key not in under_way:
                under_way[bag.key] = bag
                finished.add(_submit(client, bag, work))
        if not under_way:
            return
        future = next(finished)
        bag = under_way.pop(future.key.rpartition("-")[2])
        if future.status in ("cancelled", "lost"):
            _require_connection(client)
            under_way[bag.key] = bag
            finished.add(_submit(client, bag, work))
            continue
        yield bag, _outcome(future)


def _room(client, under_way):
    threads = sum(client.nthreads().values()) if client.status == "running" else 0
    return max(0, PER_THREAD * max(1, threads) - len(under_way))


def _submit(client, bag, work):
    """By content and options: clients of one scheduler that ask for the same get the same."""
    return client.submit(read_bag, bag.path, bag.key, work, key=f"bag-{bag.options}-{bag.key}")


def _outcome(future):
    error = future.exception()
    if error is None:
        return future.result()
    if isinstance(error, FleetError):
        raise error
    if isinstance(error, distributed.KilledWorker):
        return Drive(UNREAD, "the workers that were to read it have ended")
    return Drive(UNREAD, f"{type(error).__name__}: {error}")


def _require_connection(client):
    if client.status not in ("running", "connecting"):
        raise FleetError("the scheduler is gone; what has been read is in the database, the next scan goes on from there")
