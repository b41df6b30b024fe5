"""What the drives tell of one part, and what hides it."""
import dataclasses

import numpy as np

from . import student_t
from .grid import close_in
from .history import MONTH, YEAR, series

LEAST_SCATTER, MOST_SCATTER = 1e-3, 1.0  # between drives, as a share of the part's number; nothing is finer or coarser
LEAST_WALK, MOST_WALK = 2e-3, 0.1  # that the number wanders by from the first drive to the last; less is no walk at all,
# and what hides a part (halls, loads, weather of years) is no larger
MODES = 8  # of the walk: what is faster than a sixteenth of the history is scatter
# Standard deviations of what hides a part, of its number: what 1 of the other part's logarithm makes of it (a spring half
# as stiff again under load: 0.5), what 1 K does (oil: -0.003 to -0.01), and what another estimator makes of the same
# drives, as of baselines (2 % of b1 and of b0; such a shift is no change).
OF_OTHER, OF_KELVIN, OF_ESTIMATOR = 1.0, 0.01, 0.03
_POINTS = (7, 6)  # of scatter and walk
_EDGE = np.log(1.5)  # a law that fits worse has more scatter


@dataclasses.dataclass(frozen=True)
class View:
    """A part's number over the other's, whose median is 1: a payload moves both alike."""
    time: np.ndarray  # (N,) [s since 1970], rising
    value: np.ndarray  # (N,)
    stddev: np.ndarray  # (N,) as it is stated
    hidden: np.ndarray  # (N, h) what else it may depend on
    hidden_stddev: np.ndarray  # (h,) of the coefficients
    log_unit: float  # logarithm of what 1 is

    def between(self, begin, end):
        return dataclasses.replace(self, **{name: getattr(self, name)[begin:end]
                                            for name in ("time", "value", "stddev", "hidden")})

    @property
    def span(self):
        """[s] from the first drive to the last, but no less than the shortest life of a part."""
        return max(self.time[-1] - self.time[0], MONTH)

    @property
    def share(self):
        """(N,) of the span, from 0 on."""
        return (self.time - self.time[0]) / self.span


def view(history, part, season):
    """:param part: None for b0 alone. :param season: standard deviation of the yearly swing's sine and cosine.
    :returns: None without a drive.
    """
    ratio, damping, stiffness = series(history)
    if not len(ratio.time):
        return None
    logarithm = {"damping": ratio.value, "stiffness": -ratio.value, None: stiffness.value}[part]
    unit = np.median(logarithm)
    phase = 2 * np.pi * ratio.time / YEAR
    columns = [(np.cos(phase), season), (np.sin(phase), season)]
    if part:
        other = stiffness.value if part == "damping" else damping.value
        other = other - np.median(other)
        slow = _slow(ratio.time, other)
        # Where this part alone has changed, or the other one alone, its number over the other's is that to the power of 0
        # or -1: 1 and exp(-slow) are both exact.
        columns += [(1 - np.exp(-slow), OF_OTHER), (other - slow, OF_OTHER)]
    if ratio.temperature is not None:
        columns.append((np.nan_to_num(ratio.temperature - np.nanmean(ratio.temperature)), OF_KELVIN))
    if ratio.former is not None:
        columns.append((ratio.former, OF_ESTIMATOR))
    hidden, stddevs = zip(*columns)
    return View(ratio.time, np.exp(logarithm - unit), ratio.stddev, np.column_stack(hidden),
                np.maximum(stddevs, 1e-6), unit)


def _slow(time, value):
    """What of the other part's number lasts, as a load that grows; the rest is a load of the day, or an error in it, of
    which the part's number over it has the opposite one."""
    share = (time - time[0]) / max(time[-1] - time[0], MONTH)
    columns = np.column_stack([np.ones(len(share)), share, walk(share)])
    return columns @ np.linalg.lstsq(columns, value, rcond=None)[0]


def walk(share):
    """(N, MODES): a random walk of variance 1 at share 1, by Karhunen and Loeve; its coefficients have variance 1."""
    frequency = (np.arange(MODES) + 0.5) * np.pi
    return np.sqrt(2) / frequency * np.sin(frequency * np.asarray(share)[..., None])


class Regression:
    """value = level + added columns + what hides the part + walk + scatter of Student's t, for scatters and walks of all
    sizes: standard deviations that nobody knows, no order of magnitude more likely than another."""

    def __init__(self, view, box=None):
        """:param box: of an earlier regression that fits about as well: the sizes that are looked at; None: all."""
        self._view, self._walk, self._box = view, walk(view.share), box

    def fit(self, added=(), stddevs=()):
        """:param added: columns; stddevs: of their coefficients. :returns: (Grid, Fits); columns as in `fit`: level, added,
        hidden, walk."""
        view = self._view
        columns = self.columns(added)
        known = np.concatenate([[0.0], np.power(stddevs, -2.0), view.hidden_stddev ** -2.0])

        def evaluate(centres):
            scatter, size = np.exp(centres.T)
            scales = np.sqrt(view.stddev ** 2 + scatter[:, None] ** 2)
            precision = np.hstack([np.tile(known, (len(centres), 1)), np.repeat(size[:, None] ** -2, MODES, axis=1)])
            fits = student_t.fit(view.value, scales, columns, precision)
            return fits.log_evidence, fits
        if self._box is not None:
            return close_in(evaluate, *self._box, _POINTS, rounds=1)
        return close_in(evaluate, np.log([LEAST_SCATTER, LEAST_WALK]), np.log([MOST_SCATTER, MOST_WALK]), _POINTS)

    def columns(self, added):
        return np.column_stack([np.ones(len(self._view.time)), *added, self._view.hidden, self._walk])

    def narrowed(self, grid):
        """One for models that fit as well as this grid's, or somewhat worse; walks may be of any size."""
        scatter = grid.centres[:, 0]
        half = grid.widths[0] / 2
        return Regression(self._view, ((scatter.min() - half, np.log(LEAST_WALK)),
                                       (scatter.max() + half + _EDGE, np.log(MOST_WALK))))
