#!/usr/bin/env python3
"""The estimates against the simulator's truth, by stamp, through real topics."""
import math
import tempfile
import unittest

import rospy
import rostest
from ros_session import PACKAGE, Collector, Pace, launch, record_drive, settings, start_node
from suspension_health_monitor.msg import ParameterEstimate, SimulationTruth

# Errors of b1 [1/s] and b0 [1/s^2] in the paper's experiments (lambda 0.98, L 30), t > 10 s, measured over 20 noise
# seeds with an independent implementation. "largest" is the largest of 20 drives: one more drive stays below it but for
# a chance of 1/21, hence the fixed seed. The rms of one drive scatters by 1 / sqrt(2 * 110 s / 1 s of memory) = 7 %.
LARGEST = {"ls, no fault": (0.16, 0.63), "la, no fault": (0.16, 0.28), "la, data loss": (0.31, 0.61)}
RMS = {"ls, no fault": (0.047, 0.170), "la, no fault": (0.069, 0.099), "la, data loss": (0.075, 0.129),
       "ls, data loss": (0.537, 0.826)}
RMS_SCATTER = 0.07
SETTLED = 10.0  # [s]
TIMES = (12.0, 20.0, 38.0, 55.0, 62.0, 80.0, 95.0, 119.0)  # [s], none within 10 s after a loss (25..26 s, 65..66 s)
DURATION = 120.0
SEED = 4
TOPICS = LS, LA, TRUTH = ("/monitor/ls", "/monitor/la", "/simulator/truth")


class SimulatedDriveTest(unittest.TestCase):
    def errors(self, estimates, truths, start_time):
        """(b1 error, b0 error) by drive time [s], from 10 s on."""
        truth_at = {truth.header.stamp: truth for truth in truths}
        result = {}
        for estimate in estimates:
            time = round(estimate.header.stamp.to_sec() - start_time, 6)
            if time >= SETTLED:
                self.assertTrue(estimate.valid or time not in TIMES, f"at {time} s")
                truth = truth_at[estimate.header.stamp]
                result[time] = (estimate.damping_to_mass - truth.damping_to_mass,
                                estimate.stiffness_to_mass - truth.stiffness_to_mass)
        self.assertEqual(len(result), round((DURATION - SETTLED) * 50) + 1, "an estimate for every sample")
        return result

    def assert_close_at_times(self, errors, what):
        for time in TIMES:
            for error, largest in zip(errors[time], LARGEST[what]):
                self.assertLessEqual(abs(error), largest, f"{what}: {errors[time]} at {time} s")

    def assert_rms_as_in_table(self, errors, what):
        for parameter, expected in enumerate(RMS[what]):
            rms = math.sqrt(sum(error[parameter]**2 for error in errors.values()) / len(errors))
            self.assertLessEqual(abs(rms / expected - 1.0), 5 * RMS_SCATTER, f"{what}: rms {rms}, table {expected}")

    def test_nodelets_in_one_manager_follow_the_truth_through_data_loss(self):
        with tempfile.TemporaryDirectory() as folder:
            drive = record_drive(folder, TOPICS, scenario="paper_outliers", seed=SEED)
        ls, la = (self.errors(drive[topic], drive[TRUTH], 0.0) for topic in (LS, LA))
        self.assert_close_at_times(ls, "ls, no fault")
        self.assert_close_at_times(la, "la, data loss")
        self.assert_rms_as_in_table(ls, "ls, data loss")
        self.assert_rms_as_in_table(la, "la, data loss")

    def test_hidden_effect_is_told_on_the_truth_alone(self):
        la, truth = Collector(LA, ParameterEstimate), Collector(TRUTH, SimulationTruth)
        with launch("simulation.launch", scenario="iso_road", hidden="bump_stop=47,g=0.013; quadratic_damping=1.6",
                    effects="quadratic_damping", duration=3600):
            estimate = la.wait_for(lambda message: message.effect_names, "an effect in the model")
            told = truth.wait_for(lambda message: True, "the truth")
            topics = [topic for topic, _ in rospy.get_published_topics("/simulator")]
        la.stop()
        truth.stop()
        self.assertEqual(estimate.effect_names, ["quadratic_damping"])
        self.assertEqual(dict(zip(told.effect_names, told.effect_coefficients)),
                         {"bump_stop": 47.0, "quadratic_damping": 1.6})
        self.assertEqual(topics, [TRUTH])

    def test_separate_nodes_follow_the_truth(self):
        start_time = 1000.0
        drive = {"scenario": "paper_clean", "start_time": start_time, "real_time_factor": 0.0, "seed": SEED}
        collectors = {topic: Collector(topic, SimulationTruth if topic == TRUTH else ParameterEstimate)
                      for topic in TOPICS}
        pace = Pace("/simulated_drive_test/pace", *collectors.values())
        rospy.set_param("/use_sim_time", False)
        with start_node("monitor_node", "monitor", settings("paper.yaml")):
            collectors[LA].wait_for_publisher()
            collectors[LS].wait_for_publisher()
            with start_node("simulator_node", "simulator", drive, pace="/simulated_drive_test/pace"):
                last = rospy.Time.from_sec(start_time + DURATION)
                for collector in collectors.values():
                    collector.wait_for(lambda message: message.header.stamp == last, "the end of the drive")
        pace.stop()
        for collector in collectors.values():
            collector.stop()
        for topic, name in ((LS, "ls, no fault"), (LA, "la, no fault")):
            errors = self.errors(collectors[topic].messages, collectors[TRUTH].messages, start_time)
            self.assert_close_at_times(errors, name)
            self.assert_rms_as_in_table(errors, name)


if __name__ == "__main__":
    rospy.init_node("simulated_drive_test")
    rostest.rosrun(PACKAGE, "simulated_drive", SimulatedDriveTest)
