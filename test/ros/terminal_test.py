#!/usr/bin/env python3
"""The terminal speaks: what a monitor listens to, every change of level once with its reason, and what it waits for."""
import re
import unittest

import rospy
import rostest
from ros_session import PACKAGE, launch, wait_until
from sensor_msgs.msg import Imu


class TerminalTest(unittest.TestCase):
    def test_every_change_of_level_is_told_once_with_its_reason(self):
        with launch("paper.launch", scenario="paper_clean", real_time_factor=0, shutdown_at_end="true") as program:
            self.assertEqual(program.wait_for_end(), 0)
            text = program.output()
        self.assertIn("listens to /sprung/imu (body) and /unsprung/imu (wheel); sample period 0.02 s, horizon 0.6 s", text)
        self.assertIn("health against nominal values", text)
        levels = re.findall(r"/monitor: (OK|WARN|ERROR|STALE): (.*)", text)
        names = [name for name, _ in levels]
        self.assertTrue(all(before != after for before, after in zip(names, names[1:])), names)
        self.assertEqual([name for name in names if name in ("WARN", "ERROR")][-1], "ERROR")
        self.assertTrue(all("damping" in reason for name, reason in levels if name in ("WARN", "ERROR")), levels)
        self.assert_summary_is_told_once(text)

    def assert_summary_is_told_once(self, text):
        """At the end of the drive of 120 s: the levels' times add up, and the last level is the one told last."""
        (driven, worst, levels), = re.findall(r"/monitor: driven for (\S+) s, worst level (\w+) \((.*)\)", text)
        self.assertAlmostEqual(float(driven), 120.0, delta=3.0)
        self.assertEqual(worst, "ERROR")
        self.assertAlmostEqual(sum(float(seconds) for seconds in re.findall(r"(\S+) s\b", levels)), float(driven), delta=0.3)
        (level, reason), = re.findall(r"/monitor: at the end (\w+), (.*)", text)
        self.assertEqual(level, "ERROR")
        self.assertIn("damping 3", reason)
        b1, = re.findall(r"/monitor: estimate: damping/mass (\S+) \+- \S+ 1/s, stiffness/mass \S+ \+- \S+ 1/s\^2", text)
        self.assertAlmostEqual(float(b1), 2.0, delta=0.3)

    def test_a_topic_that_nobody_publishes_is_told_with_those_that_are_there(self):
        other = rospy.Publisher("/a_robot/imu", Imu, queue_size=1)
        with launch("monitor.launch", sprung_imu="/a_robot/body") as program:
            wait_until(lambda: "no message yet on /a_robot/body" in program.output(), "the words")
            self.assertRegex(program.output(), r"no message yet on /a_robot/body \(sensor_msgs/Imu is on .*/a_robot/imu")
        other.unregister()

    def test_a_topic_that_appears_later_is_told_as_well(self):
        with launch("monitor.launch", sprung_imu="/late_robot/body") as program:
            wait_until(lambda: "no message yet on /late_robot/body" in program.output(), "the words")
            other = rospy.Publisher("/late_robot/imu", Imu, queue_size=1)
            wait_until(lambda: "/late_robot/imu" in program.output(), "the topic that has come")
            self.assertRegex(program.output(), r"no message yet on /late_robot/body \(sensor_msgs/Imu is on .*/late_robot/imu")
            other.unregister()


if __name__ == "__main__":
    rospy.init_node("terminal_test")
    rostest.rosrun(PACKAGE, "terminal", TerminalTest)
