"""Ctrl-C and SIGTERM: when a command hears them, and when not."""
import contextlib
import multiprocessing
import os
import signal
import sys
import threading


class Terminated(BaseException):
    """SIGTERM, as Ctrl-C is KeyboardInterrupt."""


NUMBERS = {KeyboardInterrupt: signal.SIGINT, Terminated: signal.SIGTERM}


def _terminate(*_):
    raise Terminated


def _again(unraisable):
    """What a destructor comes across is not raised but printed: then the signal comes again, when that is over."""
    number = NUMBERS.get(unraisable.exc_type)
    if number is None:
        sys.__unraisablehook__(unraisable)
        return
    before = hold()
    threading.Timer(0.01, os.kill, (os.getpid(), number)).start()  # it hears none itself
    signal.pthread_sigmask(signal.SIG_SETMASK, before)


def hold():
    """They wait from now on. Processes and threads that are started meanwhile never hear them."""
    return signal.pthread_sigmask(signal.SIG_BLOCK, NUMBERS.values())


def hear():
    """:raises KeyboardInterrupt, Terminated: from now on, and at once if one has waited."""
    sys.unraisablehook = _again
    signal.signal(signal.SIGTERM, _terminate)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, NUMBERS.values())


def leave_to_parent():
    """In a process that was started while they waited: Ctrl-C is for its parent to take, SIGTERM ends it without a word,
    and so does its parent's end."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, NUMBERS.values())
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent():
    """One that was killed with -9 has told nobody: its processes would wait for more work for good."""
    multiprocessing.parent_process().join()
    os._exit(1)


@contextlib.contextmanager
def held():
    _start_resource_tracker()
    before = hold()
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _start_resource_tracker():
    """Of multiprocessing: whoever starts it hears both afterwards. An end by a signal is no leak to be told of."""
    from multiprocessing import resource_tracker
    quiet = "ignore:resource_tracker"
    if quiet not in os.environ.get("PYTHONWARNINGS", ""):
        os.environ["PYTHONWARNINGS"] = ",".join(filter(None, [os.environ.get("PYTHONWARNINGS"), quiet]))
    resource_tracker.ensure_running()
