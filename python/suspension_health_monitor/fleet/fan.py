"""The trend of a strut as a band over time, past and to come."""
import dataclasses
from typing import List, Tuple

import numpy as np

from .changes import SIGN
from .history import MONTH, YEAR
from .part_wear import of_all, quantiles

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


def trend(part, dated, options):
    begin, last = part.last.time[[0, -1]]
    ahead = 0.5 * (last - begin)  # or as far as the date
    if dated:
        ahead = max(ahead, 1.1 * (part.wear.date[2] - last))
    times = np.linspace(begin, last + min(max(ahead, MONTH), _MOST_AHEAD * YEAR), _POINTS)
    shares = [quantiles(of_all(part.posterior, lambda draws: draws.path(share)) / part.new, part.posterior.weight, options)
              for share in (times - begin) / part.last.span]
    begins = [part.view.time[0], *(change.point.time for change in part.changes)]
    earlier = [(begin, change.point.before, float(change.begin.mean() / part.new), float(change.end.mean() / part.new))
               for begin, change in zip(begins, part.changes)]
    return Trend(part.name, SIGN[part.name] * (part.view.log_unit + float(np.log(part.new))), times, np.array(shares).T,
                 earlier)
