#!/usr/bin/env python3
"""Models that are chosen rather than found: by ~set_effects, by parameters, by a file of laws."""
import os
import tempfile
import unittest

import rospy
import rostest
import yaml
from live_drive import COEFFICIENT, DRIVE, EFFECT, KEPT, SETTINGS, START, Services, load_monitor
from ros_session import PACKAGE, Collector, Pace, load_nodelet
from sensor_msgs.msg import Imu
from suspension_health_monitor.msg import ModelComparison, ParameterEstimate


class ChosenModelTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.imu = Collector("/sprung/imu", Imu)
        cls.pace = Pace("/chosen_model_test/pace", cls.imu)
        cls.drive = load_nodelet("SimulatorNodelet", "drive", DRIVE, pace="/chosen_model_test/pace")

    @classmethod
    def tearDownClass(cls):
        cls.drive.stop()
        cls.pace.stop()
        cls.imu.stop()
        cls.folder.cleanup()

    def test_model_is_not_saved_where_no_file_can_be(self):
        path = os.path.join(self.folder.name, "none", "model.yaml")
        for name, parameters, words in (("unwritable", {"model_file": path}, path), ("fileless", {}, "model_file")):
            estimates = Collector(f"/{name}/la", ParameterEstimate)
            with load_monitor(name, **parameters):
                estimates.wait_for(lambda message: message.valid, "a valid estimate")
                answer = Services(name).save_model()
            estimates.stop()
            self.assertFalse(answer.success)
            self.assertIn(words, answer.message)
        self.assertFalse(os.path.exists(os.path.dirname(path)))

    def test_model_that_leaves_more_than_noise_is_saved_as_one(self):
        path = os.path.join(self.folder.name, "incomplete.yaml")
        with open(path, "w", encoding="utf-8") as stream:
            stream.write("damping_to_mass: 3.0\nstiffness_to_mass: 110.0\ncomplete: false\n")
        estimates = Collector("/incomplete/la", ParameterEstimate)
        with load_monitor("incomplete", model_file=path):
            estimates.wait_for(lambda message: message.valid, "a valid estimate")
            self.assertTrue(Services("incomplete").save_model().success)
        estimates.stop()
        with open(path, encoding="utf-8") as stream:
            saved = yaml.safe_load(stream)
        self.assertIs(saved["complete"], False)
        self.assertNotEqual(saved["stiffness_to_mass"], 110.0)

    def test_shapes_of_the_drive_are_taken_where_none_are_given(self):
        estimates = Collector("/shaped/la", ParameterEstimate)
        with load_monitor("shaped"):
            first = estimates.wait_for(lambda message: message.valid, "a valid estimate").header.stamp
            estimates.wait_for(lambda message: (message.header.stamp - first).to_sec() > 10.0, "motion")
            services = Services("shaped")
            for names, shapes in ((["bump_stop"], {}), (["bump_stop", EFFECT], {"bump_stop/g": 0.02}), ([], {})):
                answer = services.set_effects(names, list(shapes), list(shapes.values()))
                self.assertTrue(answer.success, answer.message)
                stamp = estimates.messages[-1].header.stamp
                newest = estimates.wait_for(
                    lambda message: message.header.stamp > stamp and message.effect_names == names, f"{names}")
                self.assertEqual(len(newest.effect_coefficients), len(names))
        estimates.stop()

    def test_law_of_the_user_is_in_the_model_from_the_start(self):
        path = os.path.join(self.folder.name, "laws.yaml")
        with open(path, "w", encoding="utf-8") as stream:
            stream.write('effects: {my_damper: {force: "v * abs(v)", unit: "1/m"}}')
        estimates = Collector("/own/la", ParameterEstimate)
        with load_monitor("own", effects_file=path, effects=["my_damper", EFFECT]):
            estimates.wait_for(lambda message: message.effect_names == ["my_damper", EFFECT], "both effects")
            answer = Services("own").set_effects(["my_damper"], [], [])
            self.assertTrue(answer.success, answer.message)
            last = estimates.wait_for(lambda message: message.effect_names == ["my_damper"] and message.valid,
                                      "the one effect")
            self.assertAlmostEqual(last.effect_coefficients[0], COEFFICIENT, delta=2.0 * COEFFICIENT)
        estimates.stop()
        os.remove(path)

    def test_fault_of_the_sensor_is_named_and_cannot_be_added(self):
        topics = {f"{side}/imu": f"/tilted/{side}" for side in ("sprung", "unsprung")}
        drive = {**DRIVE, "effects": {}, "hidden": "mount_tilt=0.06,c_y=-0.04", "body_acceleration": 1.0,
                 "body_rate": 0.1}
        comparisons = Collector("/tilted/comparison", ModelComparison)
        with load_nodelet("MonitorNodelet", "tilted", SETTINGS, **topics), \
                load_nodelet("SimulatorNodelet", "tilted_drive", drive, **topics):
            end = rospy.Time.from_sec(START + KEPT)
            comparisons.wait_for(lambda message: message.header.stamp >= end, "enough to search in")
            services = Services("tilted")
            found = services.diagnose(0.0)
            answer = services.set_effects(found.selected, [], [])
        comparisons.stop()
        self.assertEqual((found.verdict, found.selected), ("effect_found", ["mount_tilt"]))
        for name, value in zip(found.coefficient_names, found.coefficients):
            self.assertAlmostEqual(value, {"mount_tilt/c_x": 0.06, "mount_tilt/c_y": -0.04}[name], delta=0.006)
        self.assertFalse(answer.success)
        self.assertIn("effect mount_tilt", answer.message)


if __name__ == "__main__":
    rospy.init_node("chosen_model_test")
    rostest.rosrun(PACKAGE, "chosen_model", ChosenModelTest)
