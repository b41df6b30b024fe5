"""Ctrl-C and SIGTERM: when a command hears them, and when not."""
import contextlib
import signal

_BOTH = (signal.SIGINT, signal.SIGTERM)


class Terminated(BaseException):
    """SIGTERM, as Ctrl-C is KeyboardInterrupt."""


def _terminate(*_):
    raise Terminated


def hold():
    """They wait from now on. Processes and threads that are started meanwhile never hear them."""
    return signal.pthread_sigmask(signal.SIG_BLOCK, _BOTH)


def hear():
    """:raises KeyboardInterrupt, Terminated: from now on, and at once if one has waited."""
    signal.signal(signal.SIGTERM, _terminate)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _BOTH)


@contextlib.contextmanager
def held():
    before = hold()
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
