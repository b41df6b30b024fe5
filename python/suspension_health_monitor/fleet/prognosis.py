"""What a strut's drives say of its wear, and when it must go to the workshop."""
import dataclasses
from typing import List, Optional

from .change_points import LEAST_DRIVES
from .changes import PARTS, ChangePoint
from .fan import Trend, trend
from .history import StrutHistory, effect_spans
from .part_wear import Options, part


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
    effects: list
    options: Options
    trend: Optional[Trend]  # as a picture has it

    @property
    def reached(self):
        """The parts that have certainly lost the threshold, whether they wear or were broken at once."""
        return [part for part, each in self.wear.items() if each.loss[0] >= self.options.threshold]


def prognosis(history: StrutHistory, options: Options = Options()) -> Optional[Prognosis]:
    """None without a single drive whose estimates are valid."""
    parts = {name: part(name, history, options) for name in PARTS}
    damping = parts["damping"]
    if damping is None:
        return None
    dated = [name for name, each in parts.items() if each.is_dated(options)]
    shown = parts[dated[0] if dated else "damping"]
    time = damping.view.time
    return Prognosis(
        history.vehicle, history.strut, len(time), float(time[0]), float(time[-1]), _changes(parts.values()),
        next((each.likely for each in parts.values() if each.likely), None),
        {name: each.wear for name, each in parts.items()}, dated[0] if dated else None,
        effects=effect_spans(history.findings), options=options, trend=trend(shown, bool(dated), options))


def _changes(parts):
    """Of all parts, by time: what both views have is one change."""
    found = []
    for each in parts:
        times = each.view.time
        for change in each.changes:
            near = [other for other in found if _drives_between(times, other.time, change.point.time) < LEAST_DRIVES]
            if not near:
                found.append(change.point)
    return sorted(found, key=lambda point: point.time)


def _drives_between(times, one, other):
    low, high = sorted(times.searchsorted([one, other]))
    return high - low
