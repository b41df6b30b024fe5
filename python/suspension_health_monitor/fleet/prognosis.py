"""What a strut's drives say of its wear, and when it must go to the workshop."""
import dataclasses
from typing import List, Optional

import numpy as np

from . import change_points, wear
from .errors import UsageError
from .history import MONTH, YEAR, StrutHistory, effect_spans, series
from .segments import lay_out

PARTS = ("damping", "stiffness")
_FALLS = {"damping": 1, "stiffness": 2}  # index into wear.KINDS: b1/b0 rises when the spring wears
SIGN = {"damping": 1.0, "stiffness": -1.0}  # of its loss in log(b1/b0)


def _option(default, low, high, meaning):
    return dataclasses.field(default=default, metadata={"range": (low, high), "meaning": meaning})


@dataclasses.dataclass(frozen=True)
class Options:
    """:raises UsageError: a value that is not allowed."""
    threshold: float = _option(0.3, 0.01, 0.9, "share of a new part's damping or stiffness that is lost when it must go")
    level: float = _option(0.9, 0.5, 0.99, "probability of the intervals")
    season: float = _option(0.04, 0, 0.5, "yearly swing of the damping: standard deviation of its sine and its cosine")
    false_dates: float = _option(0.02, 1e-6, 0.5, "share of healthy struts that ever get a date, at most")
    false_changes: float = _option(0.005, 1e-6, 1, "changes a year of a strut that are none, at most")

    def __post_init__(self):
        for field in dataclasses.fields(self):
            value, (low, high) = getattr(self, field.name), field.metadata["range"]
            if not low <= value <= high:
                raise UsageError(f"--{field.name.replace('_', '-')} {value:g}, must lie in [{low:g}, {high:g}]: "
                                 f"{field.metadata['meaning']}")


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


@dataclasses.dataclass(frozen=True)
class Prognosis:
    vehicle: str
    strut: str
    drives: int
    first: float  # drive [s since 1970]
    last: float
    changes: List[ChangePoint]
    likely_change: Optional[float]  # first drive after a change that is more probable than none [s since 1970]
    wear: dict  # of PARTS
    dated: Optional[str]  # the part whose date is known, of PARTS
    season_or_wear: bool  # without a season there would be a date
    stiffer_or_softer: bool  # b1/b0 rises certainly: damping grows, or the spring wears
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
    starts, likely = change_points.find(ratio, options.season, options.false_changes)
    draws = wear.posterior(ratio, starts, options.season, options.threshold, bent=True)
    changes = _changes(ratio, own["stiffness"], draws, options)
    falls = {part: wear.posterior(own[part], starts, 0.0, options.threshold) for part in PARTS}
    certain = 1 / (1 + options.false_dates)  # its odds: by Markov's inequality a Bayes factor this large is no more frequent
    trends = {kind for kind, probability in draws.probability.items() if likely is None and probability >= certain}
    dated = None  # a trend across a change that is likely says nothing
    if "falls" in trends:
        dated = "damping"
    elif "rises" in trends and falls["stiffness"].probability["falls"] >= _side(options):
        dated = "stiffness"  # not without a sign of it in b0/M: damping may rise by itself, springs do not grow stiffer
    both_fall = all(each.probability["falls"] >= certain for each in falls.values())
    found = {part: _wear(part, ratio, draws, changes, options) for part in PARTS}
    if dated and both_fall:
        found[dated] = _earlier(found[dated], _wear_alone(own[dated], falls[dated], options))
    without_season = wear.posterior(ratio, starts, 0.0, options.threshold).probability["falls"]
    return Prognosis(
        history.vehicle, history.strut, len(ratio.time), float(ratio.time[0]), float(ratio.time[-1]), changes,
        None if likely is None else float(ratio.time[likely]), found, dated,
        season_or_wear=not trends and likely is None and options.season > 0 and without_season >= certain,
        stiffer_or_softer="rises" in trends and not dated, both_fall=both_fall, effects=effect_spans(history.findings),
        options=options, draws=draws)


def _side(options):
    return (1 + options.level) / 2


def quantiles(values, weights, options):
    """(low, median, high), each one of the values: between two of them may be infinity."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order]) / weights.sum()
    places = np.searchsorted(reached, [1 - _side(options), 0.5, _side(options)])
    return tuple(float(each) for each in values[order[np.minimum(places, len(order) - 1)]])


def _average(values, weights):
    """(mean, standard deviation)."""
    mean = np.average(values, weights=weights)
    return float(mean), float(np.sqrt(np.average((values - mean) ** 2, weights=weights)))


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
        step, stddev = _average(draws.coefficients[:, column], draws.weight)
        there, variance = fits.coefficients[best, column], fits.covariance[best, column, column] + stddev ** 2
        log_odds = ((there + step) ** 2 - there ** 2) / (2 * variance)
        limit = np.log(_side(options) / (1 - _side(options)))
        part = "damping" if log_odds > limit else "stiffness" if log_odds < -limit else None
        start = starts[segment]
        found.append(ChangePoint(float(ratio.time[start]), float(ratio.time[start - 1]), step, stddev, part))
    return found


def _is_of(part, change):
    """Whether a step counts for a part. What may be either is the damper's: springs break seldom, and never grow stiffer."""
    return change.part == part or (change.part is None and part == "damping")


def _carried(part, draws, changes, options):
    """(segment that began new, draws of what the part's logarithm has lost from there to the last change)."""
    layout, sign = draws.layout, SIGN[part]
    segment = 0
    for place, change in enumerate(changes, start=1):
        rises = np.average(sign * draws.coefficients[:, layout.step(place)] > 0, weights=draws.weight)
        if rises >= _side(options) and _is_of(part, change):
            segment = place
    carried = np.zeros(len(draws.kind))
    for place in range(segment, len(changes)):
        worn = sign * draws.coefficients[:, layout.slope(place)] * draws.lengths[place]
        carried += np.minimum(worn, 0)  # what rises is the other part's wear
        if _is_of(part, changes[place]):
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
    wears = draws.kind == kind
    # On another kind's way the part itself does not change.
    change = np.where(wears, wear.change_of_logarithm(1, draws.worn((last - begin) / YEAR)), 0.0)
    left = -np.expm1(np.log1p(-options.threshold) - carried[wears])  # to be worn after the last change
    life = draws.life[wears] * (np.maximum(left, 0) / options.threshold) ** (1 / draws.power[wears])
    alike = np.ones(len(life))  # of one kind
    mean, stddev = _average(options.threshold / draws.life[wears] * MONTH / YEAR, alike)
    return Wear(float(values.time[starts[segment]]), quantiles(-np.expm1(carried + change), draws.weight, options), mean,
                stddev, quantiles(begin + YEAR * life, alike, options), draws.probability[wear.KINDS[kind]])


def _earlier(one, other):
    """The date as early as either says, the rest as the first."""
    return dataclasses.replace(one, date=(min(one.date[0], other.date[0]), *one.date[1:]))
