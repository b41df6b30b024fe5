"""What a strut's drives say of its wear, and when it must go to the workshop."""
import dataclasses
from typing import List, Optional

import numpy as np

from . import change_points, wear
from .fan import Trend, trend
from .history import StrutHistory, effect_spans, series
from .part_wear import PARTS, ChangePoint, Options, average, earlier_of, side, wear_alone, wear_of_part
from .segments import lay_out


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
    both_fall: bool  # b1/M and b0/M, probably: payload, or both parts worn; a date is then as early as that says
    effects: list
    options: Options
    trend: Optional[Trend]  # as a picture has it

    @property
    def told(self):
        """The wear of the parts of which something is known: where it may be the damping that grows, the spring's is not."""
        return {part: each for part, each in self.wear.items() if part == "damping" or not self.stiffer_or_softer}

    @property
    def reached(self):
        """The parts that have certainly lost the threshold, whether they wear or were broken at once."""
        return [part for part, each in self.told.items() if each.loss[0] >= self.options.threshold]


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
    # By Markov's inequality a Bayes factor with these odds is no more frequent.
    certain = 1 / (1 + options.false_dates)
    trends = {kind for kind, probability in draws.probability.items() if likely is None and probability >= certain}
    dated = None  # a trend across a change that is likely says nothing
    if "falls" in trends:
        dated = "damping"
    elif "rises" in trends and falls["stiffness"].probability["falls"] >= side(options):
        dated = "stiffness"  # not without a sign of it in b0/M: damping may rise by itself, springs do not grow stiffer
    found = {part: wear_of_part(part, ratio, draws, changes, options) for part in PARTS}
    other = falls[PARTS[dated == PARTS[0]]].probability["falls"]
    if dated and other > 0.5:
        found[dated] = earlier_of(found[dated], wear_alone(own[dated], falls[dated], options))
    both_fall = bool(dated) and other > 0.5 or all(each.probability["falls"] >= certain for each in falls.values())
    season_or_wear = bool(
        not trends and likely is None and options.season > 0
        and wear.posterior(ratio, starts, 0.0, options.threshold).probability["falls"] >= certain)
    result = Prognosis(
        history.vehicle, history.strut, len(ratio.time), float(ratio.time[0]), float(ratio.time[-1]), changes,
        None if likely is None else float(ratio.time[likely]), found, dated,
        season_or_wear=season_or_wear, stiffer_or_softer="rises" in trends and not dated, both_fall=both_fall,
        effects=effect_spans(history.findings), options=options, trend=None)
    return dataclasses.replace(result, trend=trend(result, draws))


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
        step, stddev = average(draws.coefficients[:, column], draws.weight)
        there, variance = fits.coefficients[best, column], fits.covariance[best, column, column] + stddev ** 2
        log_odds = ((there + step) ** 2 - there ** 2) / (2 * variance)
        limit = np.log(side(options) / (1 - side(options)))
        part = "damping" if log_odds > limit else "stiffness" if log_odds < -limit else None
        start = starts[segment]
        found.append(ChangePoint(float(ratio.time[start]), float(ratio.time[start - 1]), step, stddev, part))
    return found
