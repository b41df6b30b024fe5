"""The trend of a strut as a band over time, past and to come."""
import dataclasses
from typing import List, Tuple

import numpy as np

from .history import MONTH, YEAR
from .part_wear import PARTS, SIGN, quantiles

_POINTS = 25
_MOST_AHEAD = 5.0  # [years] of a picture


@dataclasses.dataclass(frozen=True)
class Trend:
    """Of a part's number against the other's, as a share of what it was when the part was new; without the season."""
    part: str  # of PARTS
    new: float  # log(b1/b0) of the new part
    times: np.ndarray  # (T,) [s since 1970], from the last change on
    shares: np.ndarray  # (3, T) quantiles
    earlier: List[Tuple[float, float, float, float]]  # begin, end, share there and there, of the trends before


def trend(prognosis, draws):
    part = prognosis.dated or PARTS[0]
    begins = [prognosis.first, *(change.time for change in prognosis.changes)]
    levels, ends = _levels(draws)
    new = float(np.average(levels[begins.index(prognosis.wear[part].since)], weights=draws.weight))
    times = np.linspace(begins[-1], _end(prognosis, begins[-1]), _POINTS)
    since = (times - begins[-1]) / YEAR
    shares = [quantiles(np.exp(SIGN[part] * (levels[-1] - new + draws.change(elapsed))), draws.weight,
                        prognosis.options) for elapsed in since]

    def mean_share(level):
        return float(np.exp(SIGN[part] * (np.average(level, weights=draws.weight) - new)))
    earlier = [(begin, change.before, mean_share(first), mean_share(last))
               for begin, change, first, last in zip(begins, prognosis.changes, levels, ends)]
    return Trend(part, new, times, np.array(shares).T, earlier)


def _levels(draws):
    """log(b1/b0) at begin and end of every segment, the last one's end without its wear; rows of draws."""
    begins, ends, level = [], [], draws.coefficients[:, 0]
    for segment, length in enumerate(draws.lengths):
        if segment:
            level = level + draws.coefficients[:, draws.layout.step(segment)]
        begins.append(level)
        level = level + draws.coefficients[:, draws.layout.slope(segment)] * length
        ends.append(level)
    return begins, ends


def _end(prognosis, begin):
    """Where the date is past, half as far ahead as the drives reach back otherwise."""
    ahead = 0.5 * (prognosis.last - begin)
    if prognosis.dated:
        ahead = max(ahead, 1.1 * (prognosis.wear[prognosis.dated].date[2] - prognosis.last))
    return prognosis.last + min(max(ahead, MONTH), _MOST_AHEAD * YEAR)
