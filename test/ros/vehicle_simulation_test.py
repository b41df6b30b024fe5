#!/usr/bin/env python3
"""The simulator's node drives the vehicle that the command line drives."""
import os
import tempfile
import unittest

import rospy
import rostest
from ros_session import PACKAGE, Collector, read_bag, run_tool, start_node
from sensor_msgs.msg import Imu

DRIVE = {"vehicle_model": "half_sedan", "duration": 4.0, "rate": 50.0, "seed": 7, "start_time": 1000.0,
         "sprung_imus": "front", "struts": {"rear": {"effects": {"quadratic_damping": {"coefficient": 1.5}}}},
         "known_forces": {"tow_bar": {"rms": 100.0}}}
WHEELS = ("/front/unsprung/imu", "/rear/unsprung/imu")
OTHERS = ("/front/sprung/imu", "/imu/data", "/tow_bar/wrench", "/simulator/truth", "/simulator/front/truth",
          "/simulator/rear/truth")


def assignments(settings, prefix=""):
    """NAME=VALUE of every setting, nested names joined with '/'."""
    return [text for name, value in settings.items()
            for text in (assignments(value, f"{prefix}{name}/") if isinstance(value, dict)
                         else [f"{prefix}{name}={value}"])]


class VehicleSimulationTest(unittest.TestCase):
    def test_node_and_command_line_drive_the_same(self):
        wheels = [Collector(topic, Imu) for topic in WHEELS]  # the drive waits for somebody who listens to every wheel
        with tempfile.TemporaryDirectory() as folder:
            live, offline = (os.path.join(folder, name) for name in ("live.bag", "offline.bag"))
            playing = {"real_time_factor": 0.0, "record": live, "record_topics": " ".join((*WHEELS, *OTHERS)),
                       "shutdown_at_end": True}
            with start_node("simulator_node", "simulator", {**DRIVE, **playing}) as simulator:
                self.assertEqual(simulator.wait_for_end(), 0, simulator.output())
            run_tool("simulate", "-o", offline, *(f"--set={text}" for text in assignments(DRIVE)))
            driven, expected = read_bag(live), read_bag(offline)
        for wheel in wheels:
            wheel.stop()
        self.assertEqual(set(expected), {*WHEELS, *OTHERS})
        self.assertEqual(set(driven), set(expected))
        for topic, messages in expected.items():
            self.assertEqual(len(messages), 201, topic)
            for message, live_message in zip(messages, driven[topic]):
                live_message.header.seq = message.header.seq
                self.assertEqual(live_message, message, topic)


if __name__ == "__main__":
    rospy.init_node("vehicle_simulation_test")
    rostest.rosrun(PACKAGE, "vehicle_simulation", VehicleSimulationTest)
