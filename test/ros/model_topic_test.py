#!/usr/bin/env python3
"""The latched topic ~model: who comes late gets the model, too, and a new one after every change."""
import math
import unittest

import rospy
import rostest
import yaml
from measured_drive import BLOCKS, DAMPING_TO_MASS, LARGEST_ERROR, PERIOD, MeasuredDrive
from ros_session import PACKAGE, PATIENCE, load_nodelet, wait_until
from suspension_health_monitor.msg import ModelInUse
from suspension_health_monitor.srv import SetEffects

START = 1000.0  # [s]
DELAY = 12  # samples
EFFECTS = ["quadratic_damping", "bump_stop"]


def latched_model():
    """What a subscriber that comes now gets."""
    return rospy.wait_for_message("/monitor/model", ModelInUse, PATIENCE)


class ModelTopicTest(unittest.TestCase):
    def test_model_is_latched_and_follows_every_change(self):
        with load_nodelet("MonitorNodelet", "monitor", {"sample_period": PERIOD}):
            plain = latched_model()
            self.assertEqual((plain.effect_names, plain.yaml, plain.header.stamp.to_nsec()), ([], "", 0))
            self.assertTrue(math.isnan(plain.damping_to_mass))
            drive = MeasuredDrive()
            drive.feed(0, 400, START)
            last = latched_model()
            self.check_plain_model(last)
            self.add_effects(drive)
            self.feed_extended(drive, 400, 800)
            extended = latched_model()
            self.check_extended_model(extended)
            self.assertEqual(extended.header.seq - last.header.seq, 2, "set, and valid: not with every sample")
            self.assertTrue(drive.reset().success)
            self.assertEqual((latched_model().effect_names, latched_model().yaml), (EFFECTS, ""))
            drive.stop()

    def feed_extended(self, drive, first, last):
        """A model with effects reports DELAY samples late."""
        for begin in range(first, last, 100):
            for pair in (drive.pair(index, START) for index in range(begin, begin + 100)):
                for publisher, imu in zip(drive.publishers, pair):
                    publisher.publish(imu)
            wanted = drive.pair(begin + 99 - DELAY, START)[0].header.stamp
            wait_until(lambda: drive.estimates.messages[-1].header.stamp == wanted, f"sample {begin + 99 - DELAY}")

    def check_plain_model(self, model):
        self.assertEqual(model.effect_names, [])
        self.assertAlmostEqual(model.damping_to_mass, DAMPING_TO_MASS, delta=5 * LARGEST_ERROR[0])
        first_valid = START + BLOCKS * PERIOD
        self.assertTrue(first_valid <= model.header.stamp.to_sec() < first_valid + 1.0, "not the newest")
        self.assertEqual(yaml.safe_load(model.yaml), {"damping_to_mass": model.damping_to_mass,
                                                      "stiffness_to_mass": model.stiffness_to_mass})

    def add_effects(self, drive):
        service = rospy.ServiceProxy("/monitor/set_effects", SetEffects)
        stamp = drive.estimates.messages[-1].header.stamp
        self.assertTrue(service(EFFECTS, ["bump_stop/g"], [0.03]).success)
        model = latched_model()
        self.assertEqual(model.effect_names, EFFECTS)
        self.assertEqual((model.shape_names, model.shapes), (["bump_stop/g"], (0.03,)))
        self.assertEqual(model.header.stamp, stamp)
        self.assertEqual(model.yaml, "", "no valid estimate of this model yet")

    def check_extended_model(self, model):
        written = yaml.safe_load(model.yaml)
        self.assertEqual(list(written["effects"]), EFFECTS)
        self.assertEqual(written["effects"]["bump_stop"], {"coefficient": model.effect_coefficients[1], "g": 0.03})
        self.assertEqual(written["stiffness_to_mass"], model.stiffness_to_mass)


if __name__ == "__main__":
    rospy.init_node("model_topic_test")
    rostest.rosrun(PACKAGE, "model_topic", ModelTopicTest)
