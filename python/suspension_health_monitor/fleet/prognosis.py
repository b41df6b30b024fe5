"""What a strut's drives say of its wear, and when it must go to the workshop."""
import dataclasses
from typing import List, Optional

import numpy as np

from . import change_points, wear
from .history import MONTH, YEAR, StrutHistory, effect_spans, series
from .segments import lay_out

PARTS = ("damping", "stiffness")
_FALLS = {"damping": 1, "stiffness": 2}  # index into wear.KINDS: b1/b0 rises when the spring wears
_SIGN = {"damping": 1.0, "stiffness": -1.0}  # of its loss in log(b1/b0)


@dataclasses.dataclass(frozen=True)
class Options:
    threshold: float = 0.30  # of a part, worn: its end
    level: float = 0.90  # of every interval
    season: float = 0.04  # the yearly swing of damping, standard deviation of its sine and its cosine
    false_dates: float = 0.02  # share of healthy struts that ever get a date
    false_changes: float = 1 / 200  # [1/year] of a strut

    def __post_init__(self):
        for name, least, most in (("threshold", 0, 1), ("level", 0, 1), ("season", -1e-300, 1), ("false_dates", 0, 1),
                                  ("false_changes", 0, np.inf)):
            if not least < getattr(self, name) < most:
                raise ValueError(f"{name} = {getattr(self, name)}, must lie between {max(least, 0)} and {most}")


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
    rate: float  # [1/month] of what it was after the last change; median where it wears
    rate_stddev: float
    date: tuple  # quantiles (early, median, late) of when the threshold is reached, if the part wears [s since 1970]
    probability: float  # that it wears


@dataclasses.dataclass(frozen=True)
class Prognosis:
    vehicle: str
    strut: str
    drives: int
    changes: List[ChangePoint]
    wear: dict  # of PARTS
    dated: Optional[str]  # the part whose date is known, of PARTS
    season_or_wear: bool  # without a season there would be a date
    both_fall: bool  # b1/M and b0/M: payload, or both parts worn
    effects: list
    options: Options
    draws: wear.Posterior


def prognosis(history: StrutHistory, options: Options = Options()) -> Optional[Prognosis]:
    """None without a single drive whose estimates are valid."""
    ratio, *own = series(history)
    if not len(ratio.time):
        return None
    own = dict(zip(PARTS, own))
    starts = change_points.find(ratio, options.season, options.false_changes)
    draws = wear.posterior(ratio, starts, options.season, options.threshold)
    changes = _changes(ratio, own["stiffness"], draws, options)
    certain = 1 / (1 + options.false_dates)  # its odds: by Markov's inequality a Bayes factor this large is no more frequent
    falls = {part: wear.posterior(own[part], starts, 0.0, options.threshold) for part in PARTS}
    dated = None
    if draws.probability["falls"] >= certain:
        dated = "damping"
    elif draws.probability["rises"] >= certain and falls["stiffness"].probability["falls"] >= _side(options):
        dated = "stiffness"  # not without a sign of it in b0/M: damping may rise by itself, springs do not grow stiffer
    both_fall = all(each.probability["falls"] >= certain for each in falls.values())
    found = {part: _wear(part, ratio, draws, changes, options) for part in PARTS}
    if dated and both_fall:
        found[dated] = _earlier(found[dated], _wear_alone(own[dated], falls[dated], options))
    season_or_wear = not dated and options.season > 0 and wear.posterior(
        ratio, starts, 0.0, options.threshold).probability["falls"] >= certain
    return Prognosis(history.vehicle, history.strut, len(ratio.time), changes, found, dated, season_or_wear, both_fall,
                     effect_spans(history.findings), options, draws)


def _side(options):
    return (1 + options.level) / 2


def _quantiles(draws, options):
    ordered = np.sort(draws)  # not between two of them: one may be infinite
    return tuple(float(ordered[int(share * len(ordered))]) for share in (1 - _side(options), 0.5, _side(options)))


def _changes(ratio, stiffness, draws, options):
    """Which part a step is of: if it is the spring's, stiffness/mass has it, too, with the other sign."""
    starts = draws.layout.starts
    if len(starts) == 1:
        return []
    layout, grid, fits = lay_out(stiffness, starts, 0.0)
    best = grid.log_density.argmax()
    found = []
    for segment in range(1, len(starts)):
        column = layout.step(segment)
        steps = draws.coefficients[:, column]
        step, stddev = steps.mean(), steps.std()
        there, variance = fits.coefficients[best, column], fits.covariance[best, column, column] + stddev ** 2
        log_odds = ((there + step) ** 2 - there ** 2) / (2 * variance)
        limit = np.log(_side(options) / (1 - _side(options)))
        part = "damping" if log_odds > limit else "stiffness" if log_odds < -limit else None
        start = starts[segment]
        found.append(ChangePoint(float(ratio.time[start]), float(ratio.time[start - 1]), float(step), float(stddev), part))
    return found


def _carried(part, draws, changes, options):
    """(segment that began new, draws of what the logarithm has lost from there to the last change)."""
    layout, sign = draws.layout, _SIGN[part]
    segment = 0
    for place, change in enumerate(changes, start=1):
        rises = np.mean(sign * draws.coefficients[:, layout.step(place)] > 0) >= _side(options)
        if rises and change.part in (None, part):
            segment = place
    carried = np.zeros(len(draws.kind))
    for place in range(segment, len(changes)):
        carried += sign * draws.coefficients[:, layout.slope(place)] * draws.lengths[place]
        if changes[place].part in (None, part):
            carried += sign * draws.coefficients[:, layout.step(place + 1)]
    return segment, carried


def _wear(part, ratio, draws, changes, options):
    segment, carried = _carried(part, draws, changes, options)
    return _of_draws(_FALLS[part], ratio, draws, segment, carried, options)


def _wear_alone(own, draws, options):
    return _of_draws(1, own, draws, len(draws.layout.starts) - 1, np.zeros(len(draws.kind)), options)


def _of_draws(kind, values, draws, segment, carried, options):
    starts = draws.layout.starts
    begin, last = values.time[starts[-1]], values.time[-1]
    falls = draws.kind == kind
    rate = np.where(falls, draws.rate, 0.0)
    now = carried + np.log1p(-np.minimum(rate * (last - begin) / YEAR, 1 - 1e-9))
    left = -np.expm1(np.log1p(-options.threshold) - carried)  # share that is still to be worn at the last change
    with np.errstate(divide="ignore", invalid="ignore"):
        elapsed = np.where(left <= 0, 0.0, left / rate)
    wears = falls if falls.any() else np.ones_like(falls)  # no draw at all: as those that stay as they are, never
    return Wear(float(values.time[starts[segment]]), _quantiles(-np.expm1(now), options),
                float(np.median(rate[wears])) * MONTH / YEAR, float(rate[wears].std()) * MONTH / YEAR,
                _quantiles((begin + YEAR * elapsed)[wears], options), float(falls.mean()))


def _earlier(one, other):
    """The date as early as either says, the rest as the first."""
    return dataclasses.replace(one, date=(min(one.date[0], other.date[0]), *one.date[1:]))
