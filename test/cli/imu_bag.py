"""Bags with the two Imu topics, written by rosbag's own Python writer."""
import csv
import pathlib

import genpy
import numpy as np
import rosbag
from sensor_msgs.msg import Imu

SPRUNG = "/sprung/imu"
UNSPRUNG = "/unsprung/imu"
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
REFERENCE_FOLDER = REPOSITORY / "test/core/data"


def read_table(path):
    """The columns of a CSV file by name."""
    with open(path, newline="") as stream:
        lines = list(csv.reader(stream))
    return dict(zip(lines[0], np.array(lines[1:], dtype=float).reshape(-1, len(lines[0])).T))


def paper_drive():
    """time [s], sprung and unsprung acceleration [m/s^2] without gravity, shape (2001,) each."""
    table = read_table(REFERENCE_FOLDER / "input_paper.csv")
    return table["time"], table["sprung_acceleration"], table["unsprung_acceleration"]


def to_time(nanoseconds):
    return genpy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def imu(stamp, acceleration):
    message = Imu()
    message.header.stamp = to_time(stamp)
    message.header.frame_id = "imu"
    message.linear_acceleration.z = acceleration
    return message


def interleave(stamps, order):
    """(side, sample, time of recording [ns]) in the order in which they are written."""
    samples = range(len(stamps))
    if order == "in pairs":
        return [(side, k, stamps[k]) for k in samples for side in (SPRUNG, UNSPRUNG)]
    if order == "wheel first":
        return [(side, k, stamps[k]) for k in samples for side in (UNSPRUNG, SPRUNG)]
    if order == "one topic after the other":  # chunks of the two overlap in time
        return [(side, k, stamps[k]) for side in (SPRUNG, UNSPRUNG) for k in samples]
    if order == "body recorded 1 s late":
        late = [(SPRUNG, k, stamps[k] + 10**9) for k in samples]
        return sorted(late + [(UNSPRUNG, k, stamps[k]) for k in samples], key=lambda entry: entry[2])
    raise ValueError(order)


def write_bag(path, drive, gravity=9.81, start=1_700_000_000, order="in pairs", compression="none",
              chunk_size=768 * 1024):
    """drive: as paper_drive(). start: first stamp [s]. chunk_size [bytes]."""
    times, *accelerations = drive
    stamps = [start * 10**9 + round(time * 1e9) for time in times]
    by_side = dict(zip((SPRUNG, UNSPRUNG), accelerations))
    with rosbag.Bag(str(path), "w", compression=compression, chunk_threshold=chunk_size) as bag:
        for side, k, recorded in interleave(stamps, order):
            message = imu(stamps[k], by_side[side][k] + gravity)
            bag.write(side, message, to_time(max(recorded, 1)))  # a bag cannot hold time 0
    return path
