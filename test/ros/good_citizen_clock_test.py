#!/usr/bin/env python3
"""Wall time under use_sim_time, and a clock that stands still, jumps or is not there."""
import itertools
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from measured_drive import JUDGED_AFTER, PERIOD, MeasuredDrive
from ros_session import PACKAGE, statuses, values, wait_until
from rosgraph_msgs.msg import Clock

START = 1000.0  # [s]


class GoodCitizenClockTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = rospy.Publisher("/clock", Clock, queue_size=100)
        cls.drive = MeasuredDrive()
        wait_until(lambda: cls.clock.get_num_connections() >= 2, "test and manager on /clock")

    def setUp(self):
        self.assertTrue(self.drive.reset().success)
        self.drive.estimates.messages.clear()
        self.before = len(self.drive.diagnostics.messages)

    def set_clock(self, seconds):
        self.clock.publish(rospy.Time.from_sec(seconds))

    def feed(self, first, last, start=START):
        for begin in range(first, last, 10):
            self.set_clock(start + begin * PERIOD)
            self.drive.feed(begin, begin + 10, start)

    def test_wall_time_under_use_sim_time_with_a_paused_clock(self):
        self.feed(0, 400)
        status = self.drive.input_status(lambda s: "the clock stands still" in s.message,
                                         after=len(self.drive.diagnostics.messages))
        self.assertEqual(status.level, DiagnosticStatus.OK, status.message)
        self.assertNotIn("no message", status.message)
        self.assertTrue(all(value not in ("nan", "inf") for value in values(status).values()), values(status))
        self.feed(400, 700)  # and on
        self.drive.assert_estimate_is_good(self)
        self.assertEqual(values(self.drive.input_status(lambda s: values(s)["samples"] == "700", after=self.before))["gaps"], "0")

    def test_a_paused_clock_does_not_make_silent_sensors_arrive(self):
        self.feed(0, 400)
        status = self.drive.input_status(lambda s: "nothing arrives at present; the clock stands still" in s.message,
                                         after=len(self.drive.diagnostics.messages))
        self.assertEqual(status.level, DiagnosticStatus.OK, status.message)

    def test_silence_is_measured_by_the_clock(self):
        self.feed(0, JUDGED_AFTER)
        clock = itertools.count(START + JUDGED_AFTER * PERIOD, 0.1)

        def told(task, words):
            self.set_clock(next(clock))  # it runs on, the sensors do not
            return [s for s in statuses(self.drive.diagnostics.messages[self.before:], task) if words in s.message]
        silent = wait_until(lambda: told(self.drive.input_task, "no message on"), "an error for silent sensors")
        self.assertEqual(silent[-1].level, DiagnosticStatus.ERROR)
        unknown = wait_until(lambda: told("monitor: Health", "no reading accepted for"), "health that is not known")
        self.assertEqual(unknown[-1].level, DiagnosticStatus.STALE)
        self.feed(0, JUDGED_AFTER, next(clock))  # and is known again
        wait_until(lambda: statuses(self.drive.diagnostics.messages, "monitor: Health")[-1].level == DiagnosticStatus.OK,
                   "health OK")

    def test_clock_that_jumps_back(self):
        self.feed(0, 400)
        self.feed(0, 400, START - 500.0)
        self.drive.assert_estimate_is_good(self)
        counted = values(self.drive.input_status(lambda s: values(s)["samples"] == "800", after=self.before))
        self.assertEqual(counted["clock jumps"], "1")

    def test_clock_that_jumps_forward(self):
        self.feed(0, 400)
        self.feed(400, 800, START + 3600.0)
        self.drive.assert_estimate_is_good(self)
        counted = values(self.drive.input_status(lambda s: values(s)["samples"] == "800", after=self.before))
        self.assertEqual((counted["clock jumps"], counted["gaps"]), ("0", "1"))

    def test_diagnostics_are_stamped_by_the_clock(self):
        def stamps():
            return [array.header.stamp.to_sec() for array in self.drive.diagnostics.messages[self.before:]
                    if statuses([array], self.drive.input_task)]
        self.feed(0, 300, 5000.0)
        wait_until(stamps, "a status of the input")
        self.assertLess(max(stamps()), 1e6)


if __name__ == "__main__":
    rospy.init_node("good_citizen_clock_test")
    rostest.rosrun(PACKAGE, "good_citizen_clock", GoodCitizenClockTest)
