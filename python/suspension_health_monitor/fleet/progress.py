"""What long work shows: a bar with rate and time left, on a terminal."""
import contextlib
import sys

from . import interruptions


class _Silent:
    """Where tqdm is not installed."""

    def update(self):
        pass

    def write(self, line, file):
        print(line, file=file)


@contextlib.contextmanager
def bar(total, unit="bag"):
    """:returns: something with update() for each of them, and write(line, file)."""
    try:
        from tqdm import tqdm
    except ImportError:
        yield _Silent()
        return
    with interruptions.held():  # a signal that its thread hears is heard by all
        result = tqdm(total=total, unit=unit, disable=None, file=sys.stderr)
    with result:
        yield result
