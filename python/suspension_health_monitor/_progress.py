"""What a caller hears of long work."""
import contextlib
import sys


class _Line:
    """A line on standard error, where tqdm is not installed."""

    def __init__(self, label):
        self._label = label

    def update(self, share):
        print(f"\r{self._label} {100 * share:3.0f} %", end="", file=sys.stderr, flush=True)

    def close(self):
        print(file=sys.stderr)


class _Bar:
    def __init__(self, tqdm, label):
        self._bar = tqdm(total=100, desc=label, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}")

    def update(self, share):
        self._bar.update(round(100 * share) - self._bar.n)

    def close(self):
        self._bar.close()


@contextlib.contextmanager
def callback(progress, label):
    """progress: None, a callable, or True for a bar."""
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        yield progress
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            bar = _Line(label)
        else:
            bar = _Bar(tqdm, label)
        try:
            yield bar.update
        finally:
            bar.close()
    else:
        raise ValueError(f"progress = {progress!r}, must be True, None or a function of the share that is done, 0 to 1")
