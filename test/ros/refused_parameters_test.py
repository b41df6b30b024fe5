#!/usr/bin/env python3
"""A wrong parameter is refused at start, by name, value and what is allowed, and harms nobody else."""
import math
import unittest

import rospy
import rostest
from ros_session import PACKAGE, Collector, is_finite, load_nodelet, settings, start_node, wait_until
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu
from suspension_health_monitor.msg import ParameterEstimate, SimulationTruth

# What is wrong: the parameters, and what the message must hold. Names are those of config/monitor.yaml.
WRONG = {
    "out of range": ({"forgetting_factor": 1.2}, ["forgetting_factor = 1.2", "must be in [0.9, 1]"]),
    "nested": ({"health": {"payload_range": -1.0}}, ["health/payload_range = -1", "must be in [0, 10]"]),
    "unknown": ({"forgeting_factor": 0.98}, ["unknown option forgeting_factor = 0.98", "forgetting_factor"]),
    "wrong type": ({"forgetting_factor": "high"}, ['forgetting_factor = "high"', "must be in [0.9, 1]"]),
    "not whole": ({"publish_every": 30.5}, ["publish_every = 30.5", "a whole number in [1, 1000000]"]),
    "list": ({"forgetting_factor": [0.98, 0.99]}, ["forgetting_factor = [0.98, 0.99] [-], must be in [0.9, 1]"]),
    "list of this and that": ({"effects": ["quadratic_damping", 3]},
                              ["effects = [quadratic_damping, 3] [-], must be any text or a list of texts"]),
    "not one of the words": ({"preset": "papers"}, ['preset = "papers"', "default, paper"]),
    "unknown effect": ({"effects": ["quadratic_damping", "bump"]},
                       ['effects = "quadratic_damping, bump"', "effect bump, must be one of", "bump_stop"]),
    "shape that nobody knows": ({"effects": "bump_stop"}, ["bump_stop/g [m] is not known yet", "model_file"]),
    "model that is a folder": ({"model_file": "/"}, ["model_file = /: is a folder, must be a YAML file"]),
    "laws that are not there": ({"effects_file": "/none.yaml"}, ["effects_file = /none.yaml: cannot be read"]),
    "a relative path": ({"effects_file": "my_laws.yaml"}, ["my_laws.yaml: cannot be read in /", "must be a YAML file"]),
    "nested, of the search": ({"diagnose": {"window": 0}}, ["diagnose/window = 0", "must be in [0.01, 1000000]"]),
    "contradiction": ({"health": {"damping_warn": 0.5}}, ["health/damping_error = 0.3", "at least health/damping_warn"]),
    "former option": ({"forgetting_rule": "exponential"}, ["forgetting_rule is no option any more: preset: paper"]),
    "former name": ({"hardware_id": "rover"}, ["hardware_id is no option any more: it is the name of the node"]),
}
WRONG_SIMULATION = {"scenario": "paper_dirty"}
DRIVE = {"real_time_factor": 20.0, "duration": 3600.0}
START, DURATION = 1000.0, 3600.0  # [s] of a drive that ends long before


class RefusedParametersTest(unittest.TestCase):
    def setUp(self):
        self.rosout = Collector("/rosout", Log)

    def tearDown(self):
        self.rosout.stop()

    def assert_refused_in_rosout(self, name, parts):
        wanted = [*parts, "/" + name]
        self.rosout.wait_for(lambda log: log.level >= Log.ERROR and all(part in log.msg for part in wanted), f"an error with {wanted}")

    def assert_all_refused(self, class_name, cases):
        for number, (parameters, parts) in enumerate(cases.values()):
            name = f"wrong_{class_name}_{number}"
            with load_nodelet(class_name, name, parameters) as wrong:
                self.assertNotEqual(wrong.wait_for_end(), 0)
                self.assert_refused_in_rosout(name, parts)

    def test_nodelet_is_refused_and_a_good_one_works_beside_it(self):
        self.rosout.wait_for_publisher()
        self.assert_all_refused("MonitorNodelet", WRONG)
        estimates = Collector("/good/la", ParameterEstimate)
        with load_nodelet("MonitorNodelet", "good", settings("paper.yaml")):
            estimates.wait_for_publisher()
            with load_nodelet("SimulatorNodelet", "drive", DRIVE):
                estimates.wait_for(lambda estimate: estimate.valid and is_finite(estimate), "a valid estimate")
        estimates.stop()

    def test_drive_of_a_strut_that_runs_away_ends_in_words(self):
        self.rosout.wait_for_publisher()
        truth = Collector("/runaway/truth", SimulationTruth)
        unstable = {"scenario": "iso_road", "hidden": "quadratic_damping=-5", "real_time_factor": 20.0,
                    "duration": DURATION, "start_time": START}
        topics = {f"{side}/imu": f"/runaway/{side}" for side in ("sprung", "unsprung")}
        with load_nodelet("SimulatorNodelet", "runaway", unstable, **topics) as nodelet:
            truth.wait_for_publisher()
            listeners = [Collector(topic, Imu) for topic in topics.values()]  # for whom the drive waits
            self.rosout.wait_for(lambda log: log.level >= Log.ERROR and "quadratic_damping = -5 is unstable" in log.msg, "an error that names the effect")
            wait_until(lambda: truth.messages, "the truth until then")
            self.assertTrue(nodelet.running(), "and harms nobody else")
        for collector in (truth, *listeners):
            collector.stop()
        self.assertTrue(all(math.isfinite(each.sprung_acceleration) for each in truth.messages))
        self.assertLess(truth.messages[-1].header.stamp.to_sec(), START + DURATION)

    def test_refused_simulator_leaves_no_topic(self):
        self.rosout.wait_for_publisher()
        with load_nodelet("SimulatorNodelet", "wrong_drive", WRONG_SIMULATION) as wrong:
            self.assertNotEqual(wrong.wait_for_end(), 0)
        self.assert_refused_in_rosout("wrong_drive", ['scenario = "paper_dirty"', "paper_clean, paper_outliers"])
        self.assertNotIn("/wrong_drive/truth", [topic for topic, _ in rospy.get_published_topics()])

    def test_nodes_end_with_an_error_and_say_why(self):
        for program, parameters, parts in (("monitor_node", *WRONG["out of range"]),
                                           ("monitor_node", *WRONG["unknown"]),
                                           ("simulator_node", WRONG_SIMULATION, ['scenario = "paper_dirty"'])):
            with start_node(program, "wrong_node", parameters) as node:
                self.assertNotEqual(node.wait_for_end(), 0)
                for part in [*parts, "/wrong_node"]:
                    self.assertIn(part, node.output())


if __name__ == "__main__":
    rospy.init_node("refused_parameters_test")
    rostest.rosrun(PACKAGE, "refused_parameters", RefusedParametersTest)
