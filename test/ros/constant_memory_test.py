#!/usr/bin/env python3
"""Ten minutes of driving at 200 Hz through the node, with losses, jitter and somebody who listens: memory stays."""
import re
import unittest

import rospy
import rostest
from ros_session import PACKAGE, Collector, start_node
from suspension_health_monitor.msg import ParameterEstimate, SuspensionHealth

DRIVE = {"scenario": "iso_road", "rate": 200.0, "duration": 600.0, "real_time_factor": 0.0, "dropout": 0.001,
         "stamp_jitter": 0.0005, "start_time": 1000.0}
SETTINGS = {"diagnose": {"window": 10.0}, "publish_every": 20}  # what is kept for the search is full soon
PACED = {"pace": "/monitor/la"}
EARLY, END = 1060.0, 1590.0  # [s]
MOST_GROWTH = 0.01


class ConstantMemoryTest(unittest.TestCase):
    def test_memory_stays(self):
        estimates = Collector("/monitor/la", ParameterEstimate)
        health = Collector("/monitor/health", SuspensionHealth)
        with start_node("monitor_node", "monitor", SETTINGS) as monitor:
            estimates.wait_for_publisher()
            with start_node("simulator_node", "drive", DRIVE, **PACED):
                early = self.resident_at(EARLY, estimates, monitor)
                late = self.resident_at(END, estimates, monitor)
        self.assertLessEqual(late, (1.0 + MOST_GROWTH) * early, f"{early} kB, then {late} kB")
        self.assertGreater(sum(estimate.valid for estimate in estimates.messages), 1000, "it has worked all the time")
        estimates.stop()
        health.stop()

    def resident_at(self, stamp, estimates, program):
        """Resident memory [kB] of a program at a stamp of the drive [s]."""
        estimates.wait_for(lambda estimate: estimate.header.stamp.to_sec() >= stamp, f"{stamp} s of the drive")
        with open(f"/proc/{program.process_id()}/status", encoding="utf-8") as status:
            return int(re.search(r"VmRSS:\s+(\d+) kB", status.read()).group(1))


if __name__ == "__main__":
    rospy.init_node("constant_memory_test")
    rostest.rosrun(PACKAGE, "constant_memory", ConstantMemoryTest)
