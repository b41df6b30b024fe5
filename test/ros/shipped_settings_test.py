#!/usr/bin/env python3
"""Every file of config/ is accepted by the nodelet that it is for."""
import pathlib
import unittest

import rospy
import rostest
from ros_session import PACKAGE, REPOSITORY, load_nodelet, settings, wait_until

SIMULATOR_FILES = ("simulator.yaml",)
VEHICLE_FILES = ("four_corners.yaml", "four_corners_simulation.yaml")
OTHER_FILES = ("four_corners_aggregator.yaml", "vehicle_aggregator.yaml")  # of diagnostic_aggregator
VEHICLE = {"struts": {name: {"sprung_imu": f"{name}/sprung/imu", "unsprung_imu": f"{name}/unsprung/imu"}
                      for name in ("front_left", "front_right", "rear_left", "rear_right")}}


def published_topics():
    return [topic for topic, _ in rospy.get_published_topics()]


class ShippedSettingsTest(unittest.TestCase):
    def test_every_file_is_accepted(self):
        files = sorted(path.name for path in pathlib.Path(REPOSITORY, "config").glob("*.yaml")
                       if path.name not in OTHER_FILES)
        self.assertLessEqual({"monitor.yaml", "paper.yaml", *SIMULATOR_FILES, *VEHICLE_FILES}, set(files))
        for number, file in enumerate(files):
            with self.subTest(file=file):
                name = f"shipped_{number}"
                nodelet, topic, more = (("SimulatorNodelet", "truth", {}) if file in SIMULATOR_FILES
                                        else ("VehicleNodelet", "coupling", {"vehicle": VEHICLE})
                                        if file in VEHICLE_FILES else ("MonitorNodelet", "la", {}))
                with load_nodelet(nodelet, name, {**settings(file), **more}) as loaded:
                    wait_until(lambda: f"/{name}/{topic}" in published_topics() or not loaded.running(), file)
                    self.assertTrue(loaded.running(), loaded.output())


if __name__ == "__main__":
    rospy.init_node("shipped_settings_test")
    rostest.rosrun(PACKAGE, "shipped_settings", ShippedSettingsTest)
