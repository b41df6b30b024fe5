"""How far a part is worn, and when it must go."""
import dataclasses
from typing import List, Optional

import numpy as np

from . import change_points, changes, laws
from .changes import Change
from .history import MONTH
from .ranged import Ranged, option
from .view import View, view


@dataclasses.dataclass(frozen=True)
class Options(Ranged):
    """Of the prognosis."""
    threshold: float = option(0.3, 0.01, 0.9, "share of a new part's damping or stiffness that it loses in its life")
    level: float = option(0.9, 0.5, 0.99, "probability of the intervals")
    season: float = option(0.06, 0, 0.5, "yearly swing of the damping: standard deviation of its sine and its cosine")
    false_dates: float = option(0.2, 1e-6, 0.5, "probability that a part with a date does not go on wearing, at most")
    false_changes: float = option(0.005, 1e-6, 1, "changes a year of a strut that are none, at most")

    @property
    def certain(self):
        return (1 + self.level) / 2


@dataclasses.dataclass(frozen=True)
class Wear:
    """Of one part since it was new: the first drive, or the last change that made it new."""
    since: float  # [s since 1970]
    loss: tuple  # quantiles (low, median, high) of the worn share at the last drive
    rate: float  # [1/month] of what it was after the last change, at the last drive, if it goes on wearing
    rate_stddev: float
    date: tuple  # quantiles of when the threshold is reached, if it goes on [s since 1970]
    probability: dict  # of laws.KINDS


@dataclasses.dataclass(frozen=True)
class Part:
    """What is known of a part, with the draws that it is known by."""
    name: str  # of changes.PARTS
    view: View  # of all drives
    last: View  # of those since the last change
    changes: List[Change]
    likely: Optional[float]  # first drive after a change that is more probable than none [s since 1970]
    posterior: laws.Posterior  # since the last change
    new: float  # number of the new part, in the mean
    wear: Wear

    def is_dated(self, options):
        """A trend across a change that is likely says nothing."""
        return self.likely is None and self.wear.probability[laws.FALLS] >= 1 - options.false_dates


def part(name, history, options):
    """None without a drive."""
    seen = view(history, name, options.season)
    if seen is None:
        return None
    starts, likely = change_points.find(seen, options.false_changes)
    alone = view(history, None, options.season)
    found = changes.of_view(name, seen, alone, starts, options.certain)
    last = seen.between(starts[-1], None)
    posterior = laws.posterior(last, options.threshold)
    segment, new = changes.new_level(name, found, of_all(posterior, lambda draws: draws.path(0.0)), options.certain)
    wear = _wear(float(seen.time[starts[segment]]), last, posterior, np.split(new, 2), options)
    return Part(name, seen, last, found, None if likely is None else float(seen.time[likely]), posterior,
                float(np.average(new, weights=posterior.weight)), wear)


def of_all(posterior, number):
    """A number of the falling draws, then of the others."""
    return np.concatenate([number(draws) for draws in (posterior.falling, posterior.other)])


def _wear(since, last, posterior, new, options):
    now, falling = last.share[-1], posterior.falling
    left = of_all(posterior, lambda draws: draws.without_rise().path(now))
    loss = 1 - left / np.concatenate(new)
    date = last.time[0] + last.span * falling.when(new[0] * (1 - options.threshold))
    rate = falling.rate(now or 1.0) / falling.level * MONTH / last.span
    alike = np.ones(len(date))
    return Wear(since, quantiles(loss, posterior.weight, options), float(rate.mean()), float(rate.std()),
                quantiles(date, alike, options), posterior.probability)


def quantiles(values, weights, options):
    """(low, median, high), each one of the values: between two of them may be infinity."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order]) / weights.sum()
    places = np.searchsorted(reached, [1 - options.certain, 0.5, options.certain])
    return tuple(float(each) for each in values[order[np.minimum(places, len(order) - 1)]])
