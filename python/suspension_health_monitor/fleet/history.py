"""What is known of a strut over its drives, and what of it is free of the payload."""
import dataclasses
from typing import List, Optional, Tuple

import numpy as np

YEAR = 365.25 * 86400.0  # [s]
MONTH = YEAR / 12
MOST_SPREAD = 1e3  # standard deviation over an estimate that says anything


@dataclasses.dataclass(frozen=True)
class Event:
    """A change of level that the health monitor has said."""
    time: float  # [s since 1970]
    level: str
    message: str
    path: str


@dataclasses.dataclass(frozen=True)
class Finding:
    """What the search for a missing effect has said of a drive."""
    time: float  # [s since 1970]
    verdict: str
    effects: List[str]
    path: str
    page: Optional[str] = None


@dataclasses.dataclass(frozen=True)
class StrutHistory:
    """Drives of one strut whose estimates are valid, by time."""
    vehicle: str
    strut: str
    time: np.ndarray  # (N,) start of the drive [s since 1970], rising
    damping_to_mass: np.ndarray  # (N,) b1 [1/s]
    damping_to_mass_stddev: np.ndarray
    stiffness_to_mass: np.ndarray  # (N,) b0 [1/s^2]
    stiffness_to_mass_stddev: np.ndarray
    path: List[str]
    events: List[Event] = dataclasses.field(default_factory=list)
    findings: List[Finding] = dataclasses.field(default_factory=list)
    wrong_clocks: int = 0  # drives that are left out, since their dates cannot be
    former: Optional[np.ndarray] = None  # (N,) whether it was estimated otherwise than the others; None: all alike
    temperature: Optional[np.ndarray] = None  # (N,) [deg C], NaN where it is not known; None: of no drive
    formerly: Tuple[Tuple[str, float], ...] = ()  # names that the vehicle had, and its last drive under each [s since 1970]
    perhaps: Tuple[str, ...] = ()  # names that it may have had, between which its struts do not tell

    @property
    def last_event(self) -> Optional[Event]:
        """The newest that judges the strut: one that says "cannot tell" or "learning" takes no ERROR back."""
        judging = [event for event in self.events if event.level != "STALE" and not event.message.startswith("learning")]
        return (judging or self.events or [None])[-1]


@dataclasses.dataclass(frozen=True)
class Series:
    """Natural logarithms over time, with their standard deviations."""
    time: np.ndarray  # (N,) [s since 1970]
    value: np.ndarray
    stddev: np.ndarray
    former: Optional[np.ndarray] = None  # as of StrutHistory
    temperature: Optional[np.ndarray] = None


@dataclasses.dataclass(frozen=True)
class EffectSpan:
    """When an effect was found."""
    name: str
    first: float  # [s since 1970]
    last: float
    present: bool  # in the newest finding


def series(history):
    """The logarithms of b1/b0, b1 and b0, as (ratio, damping, stiffness).

    b1 = beta/M and b0 = K/M: a payload moves log b1 and log b0 alike, so that log(b1/b0) = log(beta/K) is free of it,
    drive by drive and whatever its distribution is. Drives whose numbers have no logarithm, or no standard deviation
    that tells of them, are left out.
    """
    known = np.ones(len(history.time), dtype=bool)
    for number, stddev in ((history.damping_to_mass, history.damping_to_mass_stddev),
                           (history.stiffness_to_mass, history.stiffness_to_mass_stddev)):
        known &= np.isfinite(number) & (0 < stddev) & (stddev / MOST_SPREAD < number)
    time = np.asarray(history.time, dtype=float)[known]
    damping, damping_stddev, stiffness, stiffness_stddev = (
        np.asarray(number, dtype=float)[known] for number in (
            history.damping_to_mass, history.damping_to_mass_stddev, history.stiffness_to_mass,
            history.stiffness_to_mass_stddev))
    of_damping, of_stiffness = damping_stddev / damping, stiffness_stddev / stiffness
    seen = [None if each is None else np.asarray(each, dtype=float)[known]
            for each in (history.former, history.temperature)]
    return (Series(time, np.log(damping / stiffness), np.hypot(of_damping, of_stiffness), *seen),
            Series(time, np.log(damping), of_damping, *seen), Series(time, np.log(stiffness), of_stiffness, *seen))


def effect_spans(findings):
    """Effects that have come, and gone unless the newest finding has them; by when they came."""
    ordered = sorted(findings, key=lambda finding: finding.time)
    names = list(dict.fromkeys(name for finding in ordered for name in finding.effects))
    spans = []
    for name in names:
        times = [finding.time for finding in ordered if name in finding.effects]
        spans.append(EffectSpan(name, times[0], times[-1], name in ordered[-1].effects))
    return spans
