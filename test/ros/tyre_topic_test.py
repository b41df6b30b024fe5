#!/usr/bin/env python3
"""Wheel and tyre live: ~tyre_ls and ~tyre_la against the simulated car, and the task "Tyre"."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from dynamic_reconfigure.client import Client
from ros_session import PACKAGE, PATIENCE, Collector, start_node, statuses
from suspension_health_monitor.msg import TyreEstimate

DRIVE = {"scenario": "iso_road", "rate": 500.0, "duration": 3600.0, "start_time": 1000.0,
         "real_time_factor": 4.0}
END = rospy.Time(1019)
PACED = {"pace": "/monitor/la"}
# The golden car: beta/m, K/m, K0/m and m/M. Tolerances as in test/cli/tyre_test.py.
TRUTH = {"damping_to_wheel_mass": 40.0, "stiffness_to_wheel_mass": 422.0, "tyre_to_wheel_mass": 4353.3,
         "mass_ratio": 0.15}
MONITOR = {"sample_period": 0.002, "forgetting_factor": 1.0, "tyre": {"enabled": True}}


class TyreTopicTest(unittest.TestCase):
    def setUp(self):
        self.estimates = {name: Collector(f"/monitor/tyre_{name}", TyreEstimate) for name in ("ls", "la")}
        self.diagnostics = Collector("/diagnostics", DiagnosticArray)
        rospy.set_param("/use_sim_time", False)

    def tearDown(self):
        for collector in (*self.estimates.values(), self.diagnostics):
            collector.stop()

    def wait_for_task(self, level, words):
        self.diagnostics.wait_for(lambda _: any(status.level == level and words in status.message
                                                for status in statuses(self.diagnostics.messages, "monitor: Tyre")), f"Tyre: {words}")

    def test_wheel_and_tyre_of_the_simulated_car(self):
        with start_node("monitor_node", "monitor", MONITOR):
            for collector in self.estimates.values():
                collector.wait_for_publisher()
            with start_node("simulator_node", "simulator", dict(DRIVE, road_imu=True), **PACED):
                for name, collector in self.estimates.items():
                    estimate = collector.wait_for(lambda message: message.header.stamp >= END, "the end")
                    self.assertEqual(estimate.estimator, name)
                    self.assertTrue(estimate.valid)
                    for field, truth in TRUTH.items():
                        self.assertAlmostEqual(getattr(estimate, field) / truth, 1.0, delta=0.02, msg=f"{name} {field}")
                self.wait_for_task(DiagnosticStatus.OK, "wheel and tyre are known")

    def test_memory_that_is_turned_reaches_the_tyre(self):
        estimates = self.estimates["la"]
        with start_node("monitor_node", "monitor", MONITOR):
            estimates.wait_for_publisher()
            client = Client("/monitor", timeout=PATIENCE)
            with start_node("simulator_node", "simulator", dict(DRIVE, road_imu=True), **PACED):
                estimates.wait_for(lambda message: message.effective_rows > 1000.0, "a long memory")
                client.update_configuration({"memory": 0.2})
                later = rospy.Time.from_sec(DRIVE["start_time"] + 2.0)  # 1000 rows
                short = estimates.wait_for(lambda message: message.header.stamp > later and
                                           message.effective_rows < 150.0, "a short memory")
            client.close()
        self.assertTrue(short.valid)

    def test_silent_road_imu_is_told_and_nothing_is_valid(self):
        with start_node("monitor_node", "monitor", MONITOR):
            self.estimates["la"].wait_for_publisher()
            with start_node("simulator_node", "simulator", DRIVE, **PACED):
                self.wait_for_task(DiagnosticStatus.WARN, "the road's IMU is silent")
        self.assertFalse(any(message.valid for message in self.estimates["la"].messages))


if __name__ == "__main__":
    rospy.init_node("tyre_topic_test")
    rostest.rosrun(PACKAGE, "tyre_topic", TyreTopicTest)
