"""A progress bar on standard error, drawn only if that is a terminal."""
import sys

WIDTH = 40


class Progress:
    """with Progress("driving") as progress: progress.update(0.5)"""

    def __init__(self, label):
        self.label = label
        self.visible = sys.stderr.isatty()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.visible:
            print("\r\033[K", end="", file=sys.stderr, flush=True)

    def update(self, share):
        """share: of the work, 0 .. 1."""
        if self.visible:
            print(f"\r{self.label} [{'#' * int(share * WIDTH):<{WIDTH}}] {100 * share:3.0f} %", end="", file=sys.stderr,
                  flush=True)
