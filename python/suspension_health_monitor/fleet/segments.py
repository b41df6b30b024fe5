"""A strut's logarithm over time: levels and slopes between changes, and a yearly season."""
import dataclasses
from typing import List

import numpy as np

from . import student_t
from .grid import close_in
from .history import MONTH, YEAR

LEAST_SCATTER, MOST_SCATTER = 1e-3, 1.0  # between drives, of a logarithm; nothing is finer or coarser
# Standard deviations of what the drives have to tell: a new damper in place of one 30 % down is a step of 0.36; 5 % a
# month is fast wear. They say only how large a change is worth looking for.
STEP_STDDEV = 0.3
SLOPE_STDDEV = 0.05 * YEAR / MONTH  # [1/year]
# What another estimator may make of the same drives, as of baselines: 2 % of b1 and of b0. Such a shift is no change.
ESTIMATOR_STDDEV = 0.03
MOST_WORN = 0.95  # of a part, where its logarithm is looked at
_POINTS = 12
_ROUNDS = 3  # from straight lines on: the second is right to a per cent of the bend


@dataclasses.dataclass(frozen=True)
class Layout:
    """Where which coefficient stands: level, slope of every segment, step at every change, season, former estimator."""
    starts: List[int]  # first drive of every segment; [0, ...]
    rates: List[float]  # [1/year] at which each wears, about: how far its slope is no straight line

    def slope(self, segment):
        return 1 + segment

    def step(self, segment):
        """Into that segment, 1 or later."""
        return len(self.starts) + segment


def years(series):
    """Since the first drive."""
    return (series.time - series.time[0]) / YEAR


def design(series, layout):
    """(N, p): a slope acts within its segment and its sum stays, so that a step is one at the change."""
    time = years(series)
    bounds = [*time[layout.starts], time[-1]]
    slopes = [worn(np.clip(time, begin, end) - begin, rate)
              for begin, end, rate in zip(bounds, bounds[1:], layout.rates)]
    steps = [time >= time[start] for start in layout.starts[1:]]
    phase = 2 * np.pi * series.time / YEAR
    former = [] if series.former is None else [series.former]
    return np.column_stack([np.ones_like(time), *slopes, *steps, np.cos(phase), np.sin(phase), *former])


def worn(elapsed, rate):
    """What linear wear takes off a logarithm, over the rate: -ln(1 - rate elapsed) / rate."""
    share = np.minimum(rate * elapsed, MOST_WORN)
    return elapsed if rate == 0 else -np.log1p(-share) / rate


def precision(series, layout, season):
    """Of the priors; season: standard deviation of either part, 0 for none."""
    segments = len(layout.starts)
    return np.array([0.0] + segments * [SLOPE_STDDEV ** -2] + (segments - 1) * [STEP_STDDEV ** -2]
                    + 2 * [max(season, 1e-6) ** -2] + (series.former is not None) * [ESTIMATOR_STDDEV ** -2])


def scales(series, log_scatter):
    """(C, N): standard deviation of every estimate with the scatter between drives, for every scatter."""
    return np.sqrt(series.stddev ** 2 + np.exp(2 * log_scatter)[:, None])


def scatter_grid(series, matrix, prior):
    """Evidence of such a model over the scatter between drives, whose logarithm may be anything; (grid, fits)."""
    def evaluate(centres):
        scale = scales(series, centres[:, 0])
        fits = student_t.fit(series.value, np.zeros_like(scale), scale, matrix, prior)
        return fits.log_evidence, fits
    return close_in(evaluate, [np.log(LEAST_SCATTER)], [np.log(MOST_SCATTER)], [_POINTS])


def lay_out(series, starts, season):
    """The layout of these segments, whose rates are those that its own fit finds; with grid and fits."""
    lengths = np.maximum(np.diff(years(series)[[*starts, -1]]), 1e-9)
    rates = np.zeros(len(starts))
    for _ in range(_ROUNDS):
        layout = Layout(starts, [*rates])
        matrix = design(series, layout)
        grid, fits = scatter_grid(series, matrix, precision(series, layout, season))
        slopes = fits.coefficients[grid.log_density.argmax(), 1:1 + len(starts)]
        rates = -np.expm1(-np.abs(slopes) * matrix[-1, 1:1 + len(starts)]) / lengths  # of what each loses in all
    return layout, grid, fits
