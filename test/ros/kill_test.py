#!/usr/bin/env python3
"""kill -9 of the node at any moment, while ~save_model is called again and again: every file stays whole."""
import os
import random
import tempfile
import threading
import time
import unittest

import rospy
import rostest
import yaml
from measured_drive import DAMPING_TO_MASS, PERIOD, MeasuredDrive
from ros_session import PACKAGE, PATIENCE, start_node, wait_until
from std_srvs.srv import Trigger

START = 1000.0  # [s]
KILLS = 6
SEED = 7
MOST_SAVES = 30  # before a kill


class Saving(threading.Thread):
    """Calls ~save_model until the node is dead."""

    def __init__(self):
        super().__init__(daemon=True)
        self.successes = 0
        self._service = rospy.ServiceProxy("/monitor/save_model", Trigger, persistent=True)
        self.start()

    def run(self):
        try:
            while self._service().success:
                self.successes += 1
        except (rospy.ServiceException, rospy.exceptions.TransportException, OSError):
            pass


class KillTest(unittest.TestCase):
    def test_files_are_whole_after_every_kill(self):
        chance = random.Random(SEED)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.yaml")
            for _ in range(KILLS):
                self.save_and_kill(path, chance.randint(1, MOST_SAVES), chance.uniform(0.0, 0.01))
            self.assertLessEqual(len(os.listdir(folder)), 2, "no heap of unfinished files")
            with start_node("monitor_node", "monitor", {"sample_period": PERIOD, "model_file": path}):
                self.drive()
                self.assertTrue(rospy.ServiceProxy("/monitor/save_model", Trigger)().success)
            self.assertEqual(os.listdir(folder), ["model.yaml"])

    def drive(self):
        drive = MeasuredDrive()
        drive.feed(0, 400, START)
        drive.stop()

    def save_and_kill(self, path, saves, after):
        """Kills the node `after` seconds after that many saves, in the middle of one of the next."""
        with start_node("monitor_node", "monitor", {"sample_period": PERIOD, "model_file": path}) as node:
            self.drive()
            saving = Saving()
            wait_until(lambda: saving.successes >= saves, "the model saved again and again")
            time.sleep(after)
            node.kill()
        saving.join(PATIENCE)
        self.assertFalse(saving.is_alive())
        with open(path, encoding="utf-8") as file:
            model = yaml.safe_load(file)
        self.assertEqual(set(model), {"damping_to_mass", "stiffness_to_mass"})
        self.assertAlmostEqual(model["damping_to_mass"], DAMPING_TO_MASS, delta=0.5)


if __name__ == "__main__":
    rospy.init_node("kill_test")
    rostest.rosrun(PACKAGE, "kill", KillTest)
