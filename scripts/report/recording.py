"""What one run through the nodelets published, as columns over time."""
import dataclasses

import numpy
import rosbag

TIME_TOLERANCE = 1e-6  # [s]
COMPARISON_DELAY = 12  # samples after which the free run answers: the last ones of a drive have no comparison

ESTIMATE_FIELDS = ("damping_to_mass", "stiffness_to_mass", "valid")
FIELDS = {
    "ls": ("/monitor/ls", ESTIMATE_FIELDS),
    "la": ("/monitor/la", ESTIMATE_FIELDS),
    "comparison": ("/monitor/comparison", ("measured", "predicted", "residual", "rmse", "fit_percent")),
    "health": ("/monitor/health", ("level", "reason", "damping_change", "nominal_damping_to_mass")),
    "truth": ("/simulator/truth", ("damping_to_mass", "stiffness_to_mass", "road")),
}


class IncompleteRecording(Exception):
    """A recording lacks rows, so nothing that is computed from it can be trusted."""


@dataclasses.dataclass
class Recording:
    """Columns by topic; every topic has `time`, the stamps [s], e.g. `recording.la.damping_to_mass` [1/s]."""
    ls: numpy.recarray
    la: numpy.recarray
    comparison: numpy.recarray
    health: numpy.recarray
    truth: numpy.recarray

    def true_value(self, parameter, time):
        """The simulator's value of the parameter at the times [s]."""
        return numpy.interp(time, self.truth.time, self.truth[parameter])


def columns(messages, fields):
    """One record per message: its stamp [s] and the fields named."""
    names = ("time", *fields)
    values = [[message.header.stamp.to_sec() for message in messages],
              *([getattr(message, field) for message in messages] for field in fields)]
    return numpy.rec.fromarrays(values, names=names) if messages else numpy.recarray(
        0, dtype=[(name, float) for name in names])


def read_recording(path):
    """Reads the topics of FIELDS from the bag."""
    topics = {topic: name for name, (topic, _) in FIELDS.items()}
    messages = {name: [] for name in FIELDS}
    with rosbag.Bag(str(path)) as bag:
        for topic, message, _ in bag.read_messages(topics=list(topics)):
            messages[topics[topic]].append(message)
    return Recording(**{name: columns(messages[name], fields) for name, (_, fields) in FIELDS.items()})


def missing_times(rows, first, last, period):
    """The times first, first + period, ..., last [s] that have no row."""
    wanted = first + period * numpy.arange(int(round((last - first) / period)) + 1)
    if len(rows) == 0:
        return wanted
    nearest = numpy.abs(wanted[:, None] - rows.time[numpy.clip(
        numpy.searchsorted(rows.time, wanted)[:, None] + numpy.array([-1, 0]), 0, len(rows) - 1)]).min(axis=1)
    return wanted[nearest > TIME_TOLERANCE]


def require_complete(recording, name, first, last, period):
    """Every topic has its row at every sample from `first` to `last` [s], and every estimate there is a number.

    @throws IncompleteRecording  naming the recording, the topic and what is missing.
    """
    for field, (topic, _) in FIELDS.items():
        rows = getattr(recording, field)
        end = last - COMPARISON_DELAY * period if field == "comparison" else last
        missing = missing_times(rows, first, end, period)
        if len(missing):
            total = int(round((end - first) / period)) + 1
            raise IncompleteRecording(f"{name}: {topic} lacks {len(missing)} of {total} rows from {first:g} s to "
                                      f"{end:g} s, the first at {missing[0]:.2f} s")
    for field in ("ls", "la"):
        rows = getattr(recording, field)
        due = rows.time >= first - TIME_TOLERANCE
        numbers = numpy.isfinite(rows.damping_to_mass) & numpy.isfinite(rows.stiffness_to_mass)
        if not numbers[due].all():
            raise IncompleteRecording(f"{name}: {FIELDS[field][0]} has {numpy.sum(due & ~numbers)} estimates that are "
                                      f"no number, the first at {rows.time[due & ~numbers][0]:.2f} s")
