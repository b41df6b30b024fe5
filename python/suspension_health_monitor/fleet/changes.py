"""What a part was before its last change: which steps are its own, and what it has lost since it was new."""
import dataclasses
from typing import Optional

import numpy as np

from .change_points import with_change
from .laws import DRAWS
from .view import Regression

PARTS = ("damping", "stiffness")
SIGN = {"damping": 1.0, "stiffness": -1.0}  # of its number in log(b1/b0)
_LEAST = 0.01  # of a part's median: it has some number


@dataclasses.dataclass(frozen=True)
class ChangePoint:
    """Between two drives the strut became another one."""
    time: float  # [s since 1970] of the first drive after it
    before: float  # of the last one before it
    step: float  # of log(b1/b0), right there
    step_stddev: float
    part: Optional[str]  # that changed, of PARTS, where stiffness/mass tells


@dataclasses.dataclass(frozen=True)
class Change:
    """With the segments at both sides of it, as draws in the numbers of the view."""
    point: ChangePoint
    begin: np.ndarray  # of the segment before
    end: np.ndarray
    after: np.ndarray  # where the segment after it begins


def of_view(part, view, stiffness, starts, certain):
    """The changes at `starts`.

    :param stiffness: a View of b0 alone, which has a step of the spring's with the other sign.
    """
    bounds, found = [*starts, len(view.time)], []
    for first, start, last in zip(bounds, bounds[1:], bounds[2:]):
        draws = _draws(view.between(first, last), start - first)
        alone = _draws(stiffness.between(first, last), start - first)
        step, there = (np.log(each[2] / each[1]) for each in (draws, alone))
        step, stddev = SIGN[part] * step.mean(), step.std()
        log_odds = ((there.mean() + step) ** 2 - there.mean() ** 2) / (2 * (there.var() + stddev ** 2))
        limit = np.log(certain / (1 - certain))
        of = "damping" if log_odds > limit else "stiffness" if log_odds < -limit else None
        point = ChangePoint(float(view.time[start]), float(view.time[start - 1]), float(step), float(stddev), of)
        found.append(Change(point, *draws))
    return found


def _draws(view, drive):
    """(begin of the segment before a change, its end, begin of the one after it)."""
    grid, fits = with_change(view, Regression(view), drive)
    best = grid.log_density.argmax()
    level, slope, bend, step = np.random.default_rng(0).multivariate_normal(
        fits.coefficients[best, :4], fits.covariance[best, :4, :4], 2 * DRAWS).T
    end = level + (slope + bend * view.share[drive]) * view.share[drive]
    return tuple(np.maximum(each, _LEAST) for each in (level, end, end + step))


def new_level(part, changes, level, certain):
    """(segment that began new, what the part's number was then), from the draws of what the last segment began with.

    A part that rises at once is new. One that falls at once is not: what it has lost stays lost. A step of the other part
    changes the number, not the part; what may be either's is the damper's: springs break seldom and do not stiffen.
    """
    level = np.maximum(level, _LEAST)
    for segment in range(len(changes), 0, -1):
        change = changes[segment - 1]
        own = change.point.part == part or (change.point.part is None and part == "damping")
        if own and np.mean(change.after > change.end) >= certain:
            return segment, level
        if own:
            level = level * change.end / change.after
        level = level * np.maximum(change.begin / change.end, 1.0)  # what rises is the other part's wear
    return 0, level
