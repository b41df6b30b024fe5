#!/usr/bin/env python3
"""A replayed bag gives live what suspension_bag gives offline: every estimate and every change of level, at the
measurement's own stamp."""
import csv
import math
import os
import tempfile
import unittest
from decimal import Decimal

import rosbag
import rospy
import rostest
from geometry_msgs.msg import Quaternion, Transform, TransformStamped
from ros_session import PACKAGE, Collector, is_finite, replayed, run_tool, settings_file
from std_msgs.msg import Header
from suspension_health_monitor.msg import ModelComparison, ParameterEstimate, SuspensionHealth
from tf2_msgs.msg import TFMessage

DURATION = 75.0  # [s], with both losses of readings and the first damage
OLDEST_DATA = 5.0  # [s], less than an estimate ages during a loss of readings: "cannot tell" comes and goes
FILLING = 60  # samples before the first regression row: two horizons of 30
DELAY = 12  # samples that the comparison is late, so the last ones have none
RATE = 20  # bag seconds per wall second
TOLERANCE = 1e-9  # relative; both ways run the same code
LEVELS = ("OK", "WARN", "ERROR", "STALE")
NOT_COMPARED = ModelComparison(predicted=math.nan, residual=math.nan)


def read_csv(path):
    """The lines of `identify --csv` by stamp in nanoseconds."""
    with open(path, encoding="utf-8", newline="") as stream:
        return {int(Decimal(line["time"]) * 10**9): {name: float(value) for name, value in line.items()}
                for line in csv.DictReader(stream)}


def changes(moments):
    """Those of (stamp, level, reason) at which the level is not that before; all begins with STALE."""
    before = ["STALE", *(level for _, level, _ in moments)]
    return [moment for moment, level in zip(moments, before) if moment[1] != level]


def read_levels(path):
    """(stamp in nanoseconds, level, reason) of each row of `health --csv`."""
    with open(path, encoding="utf-8", newline="") as stream:
        return [(int(Decimal(row["time"]) * 10**9), row["level"], row["message"]) for row in csv.DictReader(stream)]


def turn_wheel_imu(source, path):
    """The same drive of a robot whose wheel IMU is mounted upside down; the latched /tf_static of the bag says so."""
    frames = [TransformStamped(header=Header(frame_id="strut"), child_frame_id=frame, transform=Transform(rotation=rotation))
              for frame, rotation in (("sprung_imu", Quaternion(w=1.0)), ("unsprung_imu", Quaternion(x=1.0)))]
    latched = {"topic": "/tf_static", "type": TFMessage._type, "md5sum": TFMessage._md5sum, "latching": "1",
               "message_definition": TFMessage._full_text}
    with rosbag.Bag(source) as bag, rosbag.Bag(path, "w") as turned:
        for topic, message, time in bag.read_messages(["/sprung/imu", "/unsprung/imu"]):
            if turned.get_message_count() == 0:
                turned.write("/tf_static", TFMessage(frames), time, connection_header=latched)
            if topic == "/unsprung/imu":
                message.linear_acceleration.z *= -1.0
            turned.write(topic, message, time)


class BagReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            bag, table = os.path.join(folder, "drive.bag"), os.path.join(folder, "estimates.csv")
            config = settings_file(folder, "paper.yaml", health={"oldest_data": OLDEST_DATA})
            run_tool("simulate", "--scenario", "paper_outliers", "--seed", "3", "--duration", str(DURATION), "-o", bag)
            run_tool("identify", bag, "--config", config, "--csv", table)
            cls.offline = read_csv(table)
            run_tool("health", bag, "--config", config, "--csv", table)
            cls.levels = read_levels(table)
            with rosbag.Bag(bag) as messages:
                cls.stamps = {message.header.stamp.to_nsec() for _, message, _ in messages.read_messages("/sprung/imu")}
            cls.replay(bag, config)

    @classmethod
    def replay(cls, bag, config):
        collectors = [Collector("/monitor/ls", ParameterEstimate), Collector("/monitor/la", ParameterEstimate),
                      Collector("/monitor/comparison", ModelComparison),
                      Collector("/monitor/health", SuspensionHealth)]
        with replayed(collectors, bag=bag, rate=RATE, config=config) as player:
            status = player.wait_for_end()
        if status != 0:
            raise AssertionError(f"replay.launch ended with {status}:\n{player.output()}")
        cls.ls, cls.la, cls.comparison, cls.health = (collector.by_stamp() for collector in collectors)

    def test_every_sample_of_the_bag_gives_an_estimate_with_its_stamp(self):
        self.assertEqual(len(self.stamps), DURATION * 50 + 1)
        self.assertEqual(set(self.la), self.stamps)
        self.assertEqual(set(self.ls), self.stamps)
        self.assertEqual(sorted(self.comparison), sorted(self.stamps)[:-DELAY])

    def test_estimates_begin_when_the_filter_is_full(self):
        rows = sorted(stamp for stamp, estimate in self.la.items() if is_finite(estimate))
        self.assertEqual(rows, sorted(self.stamps)[FILLING:])
        self.assertEqual(rows, sorted(self.offline))

    def test_live_equals_offline(self):
        for stamp, line in self.offline.items():
            ls, la = self.ls[stamp], self.la[stamp]
            comparison = self.comparison.get(stamp, NOT_COMPARED)
            if comparison is NOT_COMPARED:
                self.assertIn(stamp, sorted(self.stamps)[-DELAY:])
                comparison.measured = line["measured"]
            for name, live in (("ls_damping_to_mass", ls.damping_to_mass), ("la_damping_to_mass", la.damping_to_mass),
                               ("ls_stiffness_to_mass", ls.stiffness_to_mass),
                               ("la_stiffness_to_mass", la.stiffness_to_mass), ("measured", comparison.measured),
                               ("predicted", comparison.predicted), ("residual", comparison.residual)):
                offline = line[name]
                same = math.isclose(live, offline, rel_tol=TOLERANCE) or (math.isnan(live) and math.isnan(offline))
                self.assertTrue(same, f"{name} at {stamp} ns: live {live}, offline {offline}")

    def test_levels_change_live_as_offline(self):
        live = [(stamp, LEVELS[health.level], health.reason) for stamp, health in sorted(self.health.items())]
        self.assertEqual(set(self.health), self.stamps)
        self.assertEqual(changes(self.levels), changes(live))
        self.assertEqual({level for _, level, _ in changes(live)}, {"OK", "WARN", "STALE"}, "a drive in which something happens")
        self.assertGreaterEqual(len(changes(live)), 4)
        for stamp, level, reason in self.levels[1:]:  # the first row is that of the first reading, before any report
            self.assertEqual((level, reason), (LEVELS[self.health[stamp].level], self.health[stamp].reason))

    def test_static_transforms_of_the_bag_are_played_and_wait_for_nobody(self):
        with tempfile.TemporaryDirectory() as folder:
            level, bag = os.path.join(folder, "level.bag"), os.path.join(folder, "turned.bag")
            run_tool("simulate", "--scenario", "paper_clean", "--duration", "20", "-o", level)
            turn_wheel_imu(level, bag)
            for target_frame in ("strut", ""):  # a monitor without one does not hear them
                estimates = Collector("/monitor/la", ParameterEstimate)
                config = settings_file(folder, "paper.yaml", target_frame=target_frame)
                with replayed([estimates], bag=bag, rate=RATE, config=config) as player:
                    self.assertEqual(player.wait_for_end(), 0, player.output())
                estimates.stop()
                last = estimates.messages[-1]
                self.assertEqual(last.valid, target_frame == "strut", last.reason)
                if last.valid:
                    self.assertAlmostEqual(last.damping_to_mass, 3.0, delta=0.31)

    def test_estimates_are_those_of_the_drive(self):
        last = self.la[max(self.la)]
        self.assertAlmostEqual(last.damping_to_mass, 3.0 - (DURATION - 40.0) / 60.0, delta=0.31)
        self.assertAlmostEqual(last.stiffness_to_mass, 13.8, delta=0.61)


if __name__ == "__main__":
    rospy.init_node("bag_replay_test")
    rostest.rosrun(PACKAGE, "bag_replay", BagReplayTest)
