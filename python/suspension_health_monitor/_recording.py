"""From what callers have, arrays or paths, to what the compiled part reads."""
import os
from typing import Optional

import numpy as np

from . import _core
from ._types import Array

_SHORTEST, _LONGEST = 1e-5, 10.0  # [s], as sample_period
_FARTHEST = 4e9  # [s], 126 years: the difference of two fits into nanoseconds
_FASTEST, _FEWEST = 1e-4, 10  # [s]: microseconds at 10 Hz and more are closer than that as nanoseconds; stamps to tell


class Recording:
    """Readings of one drive of a strut. It keeps copies: what becomes of the arrays afterwards does not matter.

    Recording(stamps, body, wheel)                       both sensors read at the same instants
    Recording(stamps_body, body, stamps_wheel, wheel)    each at its own
    Recording(period, body, wheel)                       evenly, `period` seconds apart

    :param stamps: (n,) times of measurement, rising: floats in seconds, whole numbers in nanoseconds, or datetime64.
    :param body: (n,) acceleration of the body along the strut, up positive [m/s^2]; gravity may be in it.
    :param wheel: (n,) or (m,) the same of the wheel carrier.
    :param road: (k,) the same where the tyre touches the road, with stamps_road (k,), of the tyre's identification.
    :param across: (n, 4) what else the body's IMU measures at its stamps: a_x, a_y [m/s^2], w_x, w_y [rad/s], with z up
        along the strut; NaN: not measured. Only faults of that IMU are told by it.
    :raises ValueError: naming the array: another shape or type, empty, lengths that differ, stamps that are not finite
        or go back. Readings that are NaN are no error: they are kept out and counted.
    """

    def __init__(self, *arrays: Array, stamps_road: Optional[Array] = None, road: Optional[Array] = None,
                 across: Optional[Array] = None) -> None:
        if len(arrays) == 3:
            names, arrays = ("stamps", "stamps"), (arrays[0], arrays[1], arrays[0], arrays[2])
        elif len(arrays) == 4:
            names = ("stamps_body", "stamps_wheel")
        else:
            raise ValueError(f"{len(arrays)} arrays, must be stamps, body, wheel or stamps_body, body, stamps_wheel, "
                             "wheel")
        if (road is None) != (stamps_road is None):
            raise ValueError("road and stamps_road, must be given together")
        self.body, self.wheel = to_readings("body", arrays[1]), to_readings("wheel", arrays[3])
        self.stamps_body = _to_stamps(names[0], arrays[0], self.body, "body")
        self.stamps_wheel = _to_stamps(names[1], arrays[2], self.wheel, "wheel")
        self.road = self.stamps_road = self.across = None
        if road is not None:
            self.road = to_readings("road", road)
            self.stamps_road = _to_stamps("stamps_road", stamps_road, self.road, "road")
        if across is not None:
            self.across = to_readings("across", across, (len(self.body), 4))

    def __repr__(self):
        stamps = self.stamps_body
        return f"<Recording: {len(self.body)} readings of the body, {len(self.wheel)} of the wheel, " \
               f"{1e-9 * (stamps[-1] - stamps[0]):.6g} s>"

    def _readings(self):
        streams = [(self.stamps_body, self.body), (self.stamps_wheel, self.wheel)]
        if self.road is not None:
            streams.append((self.stamps_road, self.road))
        return _core.Readings(streams, self.across)


def to_readings(name, values, shape=None):
    """An array of doubles; shape: that it must have, None: any length of one dimension."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name} is of type {array.dtype}, must be real numbers")
    wanted = shape or ("n",)
    fits = array.ndim == len(wanted) and all(w == "n" or w == size for w, size in zip(wanted, array.shape))
    if not fits:
        words = ", ".join(map(str, wanted)) + ("," if len(wanted) == 1 else "")
        raise ValueError(f"{name} has the shape {array.shape}, must be ({words})")
    if array.shape[0] == 0:
        raise ValueError(f"{name} is empty, must hold readings")
    return np.array(array, dtype=np.float64, order="C")


def _to_stamps(name, stamps, values, of):
    array = np.asarray(stamps)
    if array.ndim == 0 and array.dtype.kind in "fiu":
        return _evenly(name, float(array), len(values))
    return check_lengths(name, to_stamps(name, array), of, values)


def check_lengths(name, stamps, of, values):
    if len(stamps) != len(values):
        raise ValueError(f"{name} has {len(stamps)} and {of} {len(values)} entries, must be as many")
    return stamps


def _evenly(name, period, count):
    if not _SHORTEST <= period <= _LONGEST:
        raise ValueError(f"{name} = {period:.9g} [s], must be a period in [{_SHORTEST:g}, {_LONGEST:g}] or an array")
    return np.round(np.arange(count) * (1e9 * period)).astype(np.int64)


def to_stamps(name, stamps):
    """Whole nanoseconds, rising."""
    array = np.asarray(stamps)
    if array.dtype.kind in "mM":
        if np.isnat(array).any():
            raise ValueError(f"{name}[{np.isnat(array).argmax()}] = NaT, must be a time")
        array = array.astype(array.dtype.kind + "8[ns]").astype(np.int64)
    whole = array.dtype.kind in "iu"
    seconds = to_readings(name, array)
    bad = ~np.isfinite(seconds) | (np.abs(seconds) > (1e9 if whole else 1.0) * _FARTHEST)
    if bad.any():
        raise ValueError(f"{name}[{bad.argmax()}] = {seconds[bad.argmax()]:.9g}, must be finite seconds below "
                         f"{_FARTHEST:g}; whole numbers are nanoseconds")
    nanoseconds = array.astype(np.int64) if whole else np.round(seconds * 1e9).astype(np.int64)
    back = np.diff(nanoseconds) < 0
    if back.any():
        k = int(back.argmax()) + 1
        raise ValueError(f"{name} go back at {k}: {1e-9 * nanoseconds[k]:.9f} after {1e-9 * nanoseconds[k - 1]:.9f} "
                         "[s], must rise; give what is before and after as two recordings")
    if np.asarray(stamps).dtype.kind in "iu" and len(nanoseconds) >= _FEWEST:
        spacing = 1e-9 * np.median(np.diff(nanoseconds))
        if 0.0 < spacing < _FASTEST:
            raise ValueError(f"{name} are whole numbers, which are nanoseconds: one every {spacing:.3g} s, must be "
                             f"{_FASTEST:g} s or more apart; other units are to be given in seconds, as floats")
    return np.ascontiguousarray(nanoseconds)


def is_path(value):
    return isinstance(value, (str, os.PathLike))


def to_source(drives):
    """What a call is about: ("bags", paths) or ("arrays", recordings)."""
    if not drives:
        raise ValueError("nothing is given, must be arrays, recordings or paths of bags")
    if len(drives) == 1 and isinstance(drives[0], (list, tuple)):
        drives = tuple(drives[0])
        if not drives:
            raise ValueError("no drive is given, must be one or more")
    if all(map(is_path, drives)):
        return "bags", [os.fspath(path) for path in drives]
    if all(isinstance(drive, (Recording, _core.Simulation)) for drive in drives):
        return "arrays", [recording_of(drive) for drive in drives]
    return "arrays", [Recording(*drives)]


def recording_of(drive):
    if isinstance(drive, Recording):
        return drive
    road = {} if len(drive.road) == 0 else {"road": drive.road, "stamps_road": drive.stamps_road}
    return Recording(drive.stamps_body, drive.body, drive.stamps_wheel, drive.wheel, across=drive.across, **road)
