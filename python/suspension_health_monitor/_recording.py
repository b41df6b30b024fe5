"""From what callers have, arrays or paths, to what the compiled part reads."""
import os
from typing import Optional

from . import _core
from ._arrays import to_readings, to_stamps_of
from ._tables import in_order, is_frame, stacked
from ._types import Array

_ACROSS = ("a_x", "a_y", "w_x", "w_y")


class Recording:
    """Readings of one drive of a strut. It keeps copies: what becomes of the arrays afterwards does not matter.

    Recording(stamps, body, wheel)                       both sensors read at the same instants
    Recording(stamps_body, body, stamps_wheel, wheel)    each at its own
    Recording(period, body, wheel)                       evenly, `period` seconds apart
    Recording(frame)                                     a DataFrame with columns so named; stamps may be its index

    The arrays may be given by their names, too; time is another name of stamps.

    :param stamps: (n,) times of measurement, rising: floats in seconds, whole numbers in nanoseconds, datetimes, or
        dates as text such as "2026-05-01T12:00:00.25+02:00"; without a zone they are in UTC.
    :param body: (n,) acceleration of the body along the strut, up positive [m/s^2]; gravity may be in it. Arrays,
        lists and Series are taken alike; the index of a Series is ignored.
    :param wheel: (n,) or (m,) the same of the wheel carrier.
    :param road: (k,) the same where the tyre touches the road, with stamps_road (k,), of the tyre's identification.
    :param across: (n, 4) what else the body's IMU measures at its stamps: a_x, a_y [m/s^2], w_x, w_y [rad/s], with z up
        along the strut (of a DataFrame the columns of these names); NaN: not measured. It shows faults of that IMU,
        and nothing else.
    :raises ValueError: naming the array: another shape or type, empty, lengths that differ, stamps that are not finite
        or go back. Readings that are NaN are no error: they are kept out and counted.
    """

    def __init__(self, *arrays: Array, stamps_road: Optional[Array] = None, road: Optional[Array] = None,
                 across: Optional[Array] = None, **named: Array) -> None:
        arrays = in_order(arrays, named)
        if len(arrays) == 3:
            names, arrays = ("stamps", "stamps"), (arrays[0], arrays[1], arrays[0], arrays[2])
        else:
            names = ("stamps_body", "stamps_wheel")
        if (road is None) != (stamps_road is None):
            raise ValueError("road and stamps_road, must be given together")
        self.body, self.wheel = to_readings("body", arrays[1]), to_readings("wheel", arrays[3])
        self.stamps_body = to_stamps_of(names[0], arrays[0], "body", self.body)
        self.stamps_wheel = to_stamps_of(names[1], arrays[2], "wheel", self.wheel)
        self.road = self.stamps_road = self.across = None
        if road is not None:
            self.road = to_readings("road", road)
            self.stamps_road = to_stamps_of("stamps_road", stamps_road, "road", self.road)
        if across is not None:
            self.across = to_readings("across", stacked("across", across, _ACROSS), (len(self.body), len(_ACROSS)))

    def __repr__(self):
        stamps = self.stamps_body
        return f"<Recording: {len(self.body)} readings of the body, {len(self.wheel)} of the wheel, " \
               f"{1e-9 * (stamps[-1] - stamps[0]):.6g} s>"

    def _readings(self):
        streams = [(self.stamps_body, self.body), (self.stamps_wheel, self.wheel)]
        if self.road is not None:
            streams.append((self.stamps_road, self.road))
        return _core.Readings(streams, self.across)


def is_path(value):
    return isinstance(value, (str, os.PathLike))


def to_source(drives, named):
    """What a call is about: ("bags", paths) or ("arrays", recordings). named: arrays that were given by name."""
    if not drives and not named:
        raise ValueError("nothing is given, must be arrays, a DataFrame, recordings or paths of bags")
    if len(drives) == 1 and isinstance(drives[0], (list, tuple)):
        drives = tuple(drives[0])
        if not drives:
            raise ValueError("no drive is given, must be one or more")
    if named:
        return "arrays", [Recording(*drives, **named)]
    if all(map(is_path, drives)):
        return "bags", [_bag(os.fspath(path)) for path in drives]
    if all(isinstance(drive, (Recording, _core.Simulation)) or is_frame(drive) for drive in drives):
        return "arrays", [recording_of(drive) for drive in drives]
    return "arrays", [Recording(*drives)]


def _bag(path):
    """The path. What is no bag of any format is refused here; who reads bags tells all other faults."""
    if os.path.isfile(path) and os.access(path, os.R_OK):
        with open(path, "rb") as file:
            if file.read(4) != b"#ROS":
                raise ValueError(f"{path} is no bag: a CSV file is read by read_csv({path!r}), the contents of other "
                                 "files are given as arrays")
    return path


def recording_of(drive):
    if isinstance(drive, Recording):
        return drive
    if is_frame(drive):
        return Recording(drive)
    road = {} if len(drive.road) == 0 else {"road": drive.road, "stamps_road": drive.stamps_road}
    return Recording(drive.stamps_body, drive.body, drive.stamps_wheel, drive.wheel, across=drive.across, **road)
