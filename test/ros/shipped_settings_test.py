#!/usr/bin/env python3
"""Every file of config/ is accepted by the nodelet that it is for."""
import pathlib
import unittest

import rospy
import rostest
from ros_session import PACKAGE, REPOSITORY, load_nodelet, settings, wait_until

SIMULATOR_FILES = ("simulator.yaml",)
OTHER_FILES = ("four_corners_aggregator.yaml",)  # of diagnostic_aggregator


def published_topics():
    return [topic for topic, _ in rospy.get_published_topics()]


class ShippedSettingsTest(unittest.TestCase):
    def test_every_file_is_accepted(self):
        files = sorted(path.name for path in pathlib.Path(REPOSITORY, "config").glob("*.yaml")
                       if path.name not in OTHER_FILES)
        self.assertLessEqual({"monitor.yaml", "paper.yaml", *SIMULATOR_FILES}, set(files))
        for number, file in enumerate(files):
            with self.subTest(file=file):
                name = f"shipped_{number}"
                nodelet, topic = (("SimulatorNodelet", "truth") if file in SIMULATOR_FILES
                                  else ("MonitorNodelet", "la"))
                with load_nodelet(nodelet, name, settings(file)) as loaded:
                    wait_until(lambda: f"/{name}/{topic}" in published_topics() or not loaded.running(), file)
                    self.assertTrue(loaded.running(), loaded.output())


if __name__ == "__main__":
    rospy.init_node("shipped_settings_test")
    rostest.rosrun(PACKAGE, "shipped_settings", ShippedSettingsTest)
