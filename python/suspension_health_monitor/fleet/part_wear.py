"""How far a part is worn, and when it must go, of the draws of a posterior."""
import dataclasses
from typing import Optional

import numpy as np

from . import wear
from .history import MONTH, YEAR
from .ranged import Ranged, option

PARTS = ("damping", "stiffness")
FALLS = {"damping": 1, "stiffness": 2}  # index into wear.KINDS: b1/b0 rises when the spring wears
SIGN = {"damping": 1.0, "stiffness": -1.0}  # of its loss in log(b1/b0)


@dataclasses.dataclass(frozen=True)
class Options(Ranged):
    """Of the prognosis."""
    threshold: float = option(0.3, 0.01, 0.9, "share of a new part's damping or stiffness that it loses in its life")
    level: float = option(0.9, 0.5, 0.99, "probability of the intervals")
    season: float = option(0.04, 0, 0.5, "yearly swing of the damping: standard deviation of its sine and its cosine")
    false_dates: float = option(0.02, 1e-6, 0.5, "share of healthy struts that ever get a date, at most")
    false_changes: float = option(0.005, 1e-6, 1, "changes a year of a strut that are none, at most")


@dataclasses.dataclass(frozen=True)
class ChangePoint:
    """Between two drives the strut became another one."""
    time: float  # [s since 1970] of the first drive after it
    before: float  # of the last one before it
    step: float  # of log(b1/b0), right there
    step_stddev: float
    part: Optional[str]  # that changed, of PARTS, where stiffness/mass tells


@dataclasses.dataclass(frozen=True)
class Wear:
    """Of one part since it was new: the first drive, or the last change that made it new."""
    since: float  # [s since 1970]
    loss: tuple  # quantiles (low, median, high) of the worn share at the last drive
    rate: float  # [1/month] of what it was after the last change, if it wears: in the mean until the threshold
    rate_stddev: float
    date: tuple  # quantiles of when the threshold is reached, if it wears [s since 1970]
    probability: float  # that it wears


def side(options):
    return (1 + options.level) / 2


def quantiles(values, weights, options):
    """(low, median, high), each one of the values: between two of them may be infinity."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order]) / weights.sum()
    places = np.searchsorted(reached, [1 - side(options), 0.5, side(options)])
    return tuple(float(each) for each in values[order[np.minimum(places, len(order) - 1)]])


def average(values, weights):
    """(mean, standard deviation)."""
    mean = np.average(values, weights=weights)
    return float(mean), float(np.sqrt(np.average((values - mean) ** 2, weights=weights)))


def _is_of(part, change):
    """Whether a step counts for a part. What may be either is the damper's: springs break seldom and do not stiffen."""
    return change.part == part or (change.part is None and part == "damping")


def _carried(part, draws, changes, options):
    """(segment that began new, draws of what the part's logarithm has lost from there to the last change)."""
    layout, sign = draws.layout, SIGN[part]
    segment = 0
    for place, change in enumerate(changes, start=1):
        rises = np.average(sign * draws.coefficients[:, layout.step(place)] > 0, weights=draws.weight)
        if rises >= side(options) and _is_of(part, change):
            segment = place
    carried = np.zeros(len(draws.kind))
    for place in range(segment, len(changes)):
        worn = sign * draws.coefficients[:, layout.slope(place)] * draws.lengths[place]
        carried += np.minimum(worn, 0)  # what rises is the other part's wear
        if _is_of(part, changes[place]):
            carried += sign * draws.coefficients[:, layout.step(place + 1)]
    return segment, carried


def wear_of_part(part, ratio, draws, changes, options):
    segment, carried = _carried(part, draws, changes, options)
    return _of_draws(FALLS[part], ratio, draws, segment, carried, options)


def wear_alone(own, draws, options):
    return _of_draws(1, own, draws, len(draws.layout.starts) - 1, np.zeros(len(draws.kind)), options)


def _of_draws(kind, values, draws, segment, carried, options):
    starts = draws.layout.starts
    begin, last = values.time[starts[-1]], values.time[-1]
    wears = draws.kind == kind
    # On another kind's way the part itself does not change.
    change = np.where(wears, wear.change_of_logarithm(1, draws.worn((last - begin) / YEAR)), 0.0)
    left = -np.expm1(np.log1p(-options.threshold) - carried[wears])  # to be worn after the last change
    life = draws.life[wears] * (np.maximum(left, 0) / options.threshold) ** (1 / draws.power[wears])
    alike = np.ones(len(life))  # of one kind
    mean, stddev = average(options.threshold / draws.life[wears] * MONTH / YEAR, alike)
    return Wear(float(values.time[starts[segment]]), quantiles(-np.expm1(carried + change), draws.weight, options),
                mean, stddev, quantiles(begin + YEAR * life, alike, options), draws.probability[wear.KINDS[kind]])


def earlier_of(one, other):
    """The date as early as either says, the rest as the first."""
    return dataclasses.replace(one, date=(min(one.date[0], other.date[0]), *one.date[1:]))
