#!/usr/bin/env python3
"""A worn damper is warned of, then reported as an error; a healthy one never is."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from ros_session import PACKAGE, Collector, launch, statuses, values
from suspension_health_monitor.msg import SuspensionHealth

OK, WARN, ERROR, STALE = (DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR, DiagnosticStatus.STALE)
TASK = "monitor: Health"
DURATION = 120.0  # [s]
# Damping b1 falls from 3 to 2 1/s between 40 s and 100 s: 15 % below nominal at 67 s, 30 % below at 94 s. The estimate
# is up to 0.16 1/s off (the largest error of 20 drives), which is 9.6 s of the ramp, and lags it by the filter's two
# horizons, the memory of 50 rows and the confirmation: 1.2 + 1 + 1 s.
WARN_TIME, ERROR_TIME = 67.0, 94.0
SLACK = 9.6
LAG = 3.2
AT_ONCE = 0.2  # [s] wall time; /diagnostics by the timer alone would come up to 1 s later


class Drive:
    """The drive of the paper without a sensor fault, and what the monitor said of it."""

    def __init__(self, damping_ramp):
        self.diagnostics = Collector("/diagnostics", DiagnosticArray)
        self.health = Collector("/monitor/health", SuspensionHealth)
        with launch("paper.launch", scenario="paper_clean", real_time_factor=40, damping_ramp=damping_ramp):
            self.health.wait_for(lambda health: health.header.stamp.to_sec() >= DURATION, 20.0, "the last sample")
            count = len(self.diagnostics.messages)
            self.diagnostics.wait_for(
                lambda array: array in self.diagnostics.messages[count:] and any(s.name == TASK for s in array.status),
                5.0, "a status after the drive")
        self.diagnostics.stop()
        self.health.stop()
        self.levels = [health.level for health in self.health.messages]
        self.reported = [status.level for status in statuses(self.diagnostics, TASK)]

    def first_health(self, level):
        """(stamp, arrival) of the first ~health of this level."""
        index = self.levels.index(level)
        return self.health.messages[index].header.stamp.to_sec(), self.health.arrivals[index]

    def first_status(self, level):
        """Arrival of the first status of this level in /diagnostics."""
        return next(arrival for array, arrival in zip(self.diagnostics.messages, self.diagnostics.arrivals)
                    if any(status.name == TASK and status.level == level for status in array.status))


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
            stamp, _ = self.worn.first_health(level)
            self.assertGreater(stamp, time - SLACK)
            self.assertLess(stamp, time + SLACK + LAG)

    def test_change_of_level_is_in_diagnostics_at_once(self):
        for level in (WARN, ERROR):
            _, known = self.worn.first_health(level)
            self.assertLess(self.worn.first_status(level) - known, AT_ONCE)

    def test_reason_and_values_name_the_damping(self):
        last = self.worn.health.messages[-1]
        self.assertRegex(last.reason, r"^damping 3[0-9] % below nominal")
        self.assertAlmostEqual(last.damping_change, -1.0 / 3.0, delta=0.16 / 3.0)
        self.assertAlmostEqual(last.stiffness_change, 0.0, delta=0.28 / 13.8)
        status = statuses(self.worn.diagnostics, TASK)[-1]
        self.assertRegex(status.message, r"^damping 3[0-9] % below nominal")
        change = float(values(status)["damping_to_mass change [%]"])
        self.assertAlmostEqual(change, 100.0 * last.damping_change, delta=0.1)

    def test_healthy_drive_stays_ok(self):
        self.assertEqual(list(dict.fromkeys(self.healthy.levels)), [STALE, OK])
        self.assertEqual([level for level in dict.fromkeys(self.healthy.reported) if level != STALE], [OK])


if __name__ == "__main__":
    rospy.init_node("damper_wear_test")
    rostest.rosrun(PACKAGE, "damper_wear", DamperWearTest)
