#!/usr/bin/env python3
"""The estimates say what their fields promise, whichever way the IMUs are mounted."""
import math
import unittest

import rospy
import rostest
from measured_drive import DAMPING_TO_MASS, LARGEST_ERROR, STIFFNESS_TO_MASS, MeasuredDrive
from ros_session import PACKAGE, load_nodelet, settings

START = 1000.0  # [s]
SAMPLES = 600
MASS = 50.0  # [kg], of config/paper.yaml


def turn(side, axis, sign):
    """A change of MeasuredDrive.feed: what points up is sign * axis; on z the sensor reads something else."""
    def change(index, pair):
        acceleration = pair[side].linear_acceleration
        setattr(acceleration, axis, sign * acceleration.z)
        acceleration.z = math.sin(index)
    return change


class EstimateMessageTest(unittest.TestCase):
    def estimate(self, name, parameters, change=lambda index, pair: None):
        """The estimate after 12 s of the drive."""
        topics = {"sprung": f"/{name}/sprung", "unsprung": f"/{name}/unsprung"}
        with load_nodelet("MonitorNodelet", name, parameters,
                          **{f"{side}/imu": topic for side, topic in topics.items()}):
            drive = MeasuredDrive(name, **topics)
            drive.feed(0, SAMPLES, START, change)
            drive.assert_estimate_is_good(self)
            drive.stop()
            return drive.estimates.messages[-1]

    def test_fields_and_units(self):
        la = self.estimate("full", settings("paper.yaml"))
        self.assertEqual((la.estimator, la.effect_names), ("la", []))
        self.assertAlmostEqual(la.damping, MASS * DAMPING_TO_MASS, delta=MASS * LARGEST_ERROR[0])
        self.assertAlmostEqual(la.stiffness, MASS * STIFFNESS_TO_MASS, delta=MASS * LARGEST_ERROR[1])
        self.assertAlmostEqual(la.natural_frequency, math.sqrt(la.stiffness_to_mass) / (2 * math.pi), places=9)
        self.assertAlmostEqual(la.damping_ratio, la.damping_to_mass / (2 * math.sqrt(la.stiffness_to_mass)), places=9)
        self.assertGreater(la.damping_to_mass_stddev, 0.0)
        self.assertGreater(la.stiffness_to_mass_stddev, 0.0)
        self.assertAlmostEqual(la.effective_rows, 50.0, delta=0.1)  # 1 / (1 - 0.98)
        self.assertTrue(math.isnan(la.offset))

    def test_without_mass_the_ratios_alone_are_known(self):
        parameters = settings("paper.yaml")
        del parameters["sprung_mass"]
        la = self.estimate("massless", parameters)
        self.assertTrue(math.isnan(la.damping) and math.isnan(la.stiffness))

    def test_turned_sensors_give_the_same_estimate(self):
        upright = self.estimate("upright", settings("paper.yaml"))
        sprung, unsprung = turn(MeasuredDrive.SPRUNG, "x", -1.0), turn(MeasuredDrive.UNSPRUNG, "y", 1.0)

        def change(index, pair):
            sprung(index, pair)
            unsprung(index, pair)
        turned = self.estimate("turned", settings("paper.yaml", sprung_axis="-x", unsprung_axis="y"), change)
        self.assertEqual((turned.damping_to_mass, turned.stiffness_to_mass),
                         (upright.damping_to_mass, upright.stiffness_to_mass))

    def test_sample_period_is_measured_when_it_is_not_given(self):
        parameters = settings("paper.yaml")
        del parameters["sample_period"]
        measured = self.estimate("unclocked", parameters)
        given = self.estimate("clocked", settings("paper.yaml"))
        self.assertEqual((measured.damping_to_mass, measured.stiffness_to_mass),
                         (given.damping_to_mass, given.stiffness_to_mass))


if __name__ == "__main__":
    rospy.init_node("estimate_message_test")
    rostest.rosrun(PACKAGE, "estimate_message", EstimateMessageTest)
