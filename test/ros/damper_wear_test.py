#!/usr/bin/env python3
"""A worn damper is warned of, then reported as an error; a healthy one never is."""
import os
import tempfile
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from ros_session import PACKAGE, Collector, launch, read_bag, statuses, values, wait_until
from suspension_health_monitor.msg import SuspensionHealth

OK, WARN, ERROR, STALE = (DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR, DiagnosticStatus.STALE)
TASK = "monitor: Health"
# Damping b1 falls from 3 to 2 1/s between 40 s and 100 s: 15 % below nominal at 67 s, 30 % below at 94 s. The estimate
# is up to 0.16 1/s off (the largest error of 20 drives), which is 9.6 s of the ramp, and lags it by the filter's two
# horizons, the memory of 50 rows and the confirmation: 1.2 + 1 + 1 s.
WARN_TIME, ERROR_TIME = 67.0, 94.0
SLACK = 9.6
LAG = 3.2
HEALTH, DIAGNOSTICS = "/monitor/health", "/diagnostics"


class Drive:
    """The drive of the paper without a sensor fault, and what the monitor said of it."""

    def __init__(self, damping_ramp):
        live = Collector(DIAGNOSTICS, DiagnosticArray)
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "drive.bag")
            with launch("paper.launch", scenario="paper_clean", seed=4, real_time_factor=0, damping_ramp=damping_ramp,
                        record=bag, record_topics=f"{HEALTH} {DIAGNOSTICS}"):
                wait_until(lambda: os.path.exists(bag), "the end of the drive")
                count = len(statuses(live.messages, TASK))
                wait_until(lambda: len(statuses(live.messages, TASK)) > count + 1, "a status after the drive")
            recorded = read_bag(bag)
        live.stop()
        self.health = recorded[HEALTH]
        self.statuses = statuses(recorded[DIAGNOSTICS], TASK)
        self.last_status = statuses(live.messages, TASK)[-1]
        self.levels = [health.level for health in self.health]
        self.reported = [status.level for status in self.statuses]


class DamperWearTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.worn = Drive("true")
        cls.healthy = Drive("false")

    def test_wear_is_warned_of_and_then_an_error(self):
        self.assertEqual(list(dict.fromkeys(self.worn.levels)), [STALE, OK, WARN, ERROR], "order of appearance")
        self.assertEqual([level for level in dict.fromkeys(self.worn.reported) if level != STALE], [OK, WARN, ERROR])
        self.assertEqual((self.worn.levels[-1], self.worn.reported[-1]), (ERROR, ERROR))

    def test_levels_change_when_the_damping_has_changed_that_much(self):
        for level, time in ((WARN, WARN_TIME), (ERROR, ERROR_TIME)):
            stamp = self.worn.health[self.worn.levels.index(level)].header.stamp.to_sec()
            self.assertGreater(stamp, time - SLACK)
            self.assertLess(stamp, time + SLACK + LAG)

    def test_change_of_level_is_in_diagnostics_at_once(self):
        """The first status of a level is that of the very sample at which the level changed."""
        for level in (WARN, ERROR):
            health = self.worn.health[self.worn.levels.index(level)]
            status = self.worn.statuses[self.worn.reported.index(level)]
            self.assertEqual(values(status)["damping_to_mass change [%]"], f"{100.0 * health.damping_change:+.1f}")
            self.assertEqual(status.message, health.reason)

    def test_reason_and_values_name_the_damping(self):
        last = self.worn.health[-1]
        self.assertRegex(last.reason, r"^damping 3[0-9] % below nominal")
        self.assertAlmostEqual(last.damping_change, -1.0 / 3.0, delta=0.16 / 3.0)
        self.assertLess(last.stiffness_significance, 4.0)
        status = self.worn.last_status
        self.assertRegex(status.message, r"^damping 3[0-9] % below nominal")
        change = float(values(status)["damping_to_mass change [%]"])
        self.assertAlmostEqual(change, 100.0 * last.damping_change, delta=0.1)

    def test_healthy_drive_stays_ok(self):
        self.assertEqual(list(dict.fromkeys(self.healthy.levels)), [STALE, OK])
        self.assertEqual([level for level in dict.fromkeys(self.healthy.reported) if level != STALE], [OK])


if __name__ == "__main__":
    rospy.init_node("damper_wear_test")
    rostest.rosrun(PACKAGE, "damper_wear", DamperWearTest)
