#!/usr/bin/env python3
"""The baseline: learned while driving, kept in a file that is whole, loaded again after a kill, renewed after a service."""
import os
import signal
import tempfile
import unittest

import rospy
import rostest
import yaml
from ros_session import PACKAGE, Collector, Pace, start_node, wait_until
from sensor_msgs.msg import Temperature
from std_srvs.srv import Trigger
from suspension_health_monitor.msg import SuspensionHealth

B1, B0 = 3.0, 13.8
LEARN_TIME = 30.0  # [s]; the first estimate of this slow bounce's blocks of 4 s comes at 12 s
HEALTHY = {"real_time_factor": 20.0, "duration": 40.0, "scenario": "paper_clean", "damping_end_fraction": 1.0}
TOO_SHORT = {**HEALTHY, "duration": 0.8 * LEARN_TIME}
WORN = {**HEALTHY, "damping_to_mass": 0.6 * B1}


class BaselineTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "strut.yaml")
        self.parameters = {"baseline_file": self.path, "baseline": {"learn_time": LEARN_TIME}}
        self.health = Collector("/monitor/health", SuspensionHealth)
        self.pace = Pace("/baseline_test/pace", self.health)

    def tearDown(self):
        self.pace.stop()
        self.health.stop()
        self.folder.cleanup()

    def monitor(self, **changes):
        return start_node("monitor_node", "monitor", {**self.parameters, **changes})

    def simulator(self, parameters):
        return start_node("simulator_node", "drive", parameters, pace="/baseline_test/pace")

    def drive(self, parameters, accepts, what):
        """Lets the simulated strut drive until a message is accepted, which it returns."""
        self.health.wait_for_publisher()
        self.health.messages.clear()
        with self.simulator(parameters):
            return self.health.wait_for(accepts, what)

    def stored(self):
        with open(self.path, encoding="utf-8") as stream:
            return yaml.safe_load(stream)

    def test_is_learned_stored_and_loaded_after_a_kill(self):
        with self.monitor() as monitor:
            learning = self.drive(TOO_SHORT, lambda health: 0.3 < health.learning_progress < 0.9, "progress")
            self.assertRegex(learning.reason, r"^learning the baseline: [3-9][0-9] %")
            self.assertFalse(os.path.exists(self.path))
            learned = self.drive(HEALTHY, lambda health: abs(health.damping_change) < 1.0, "a judgement by the baseline")
            self.assertEqual(os.listdir(self.folder.name), ["strut.yaml"])
            monitor._process.send_signal(signal.SIGKILL)  # pylint: disable=protected-access
            monitor.wait_for_end()
        stored = self.stored()
        self.assertAlmostEqual(stored["damping_to_mass"], B1, delta=0.1)
        self.assertAlmostEqual(stored["stiffness_to_mass"], B0, delta=0.4)
        self.assertAlmostEqual(stored["integration_horizon"], 0.6, delta=1e-6)
        self.assertAlmostEqual(stored["sample_period"], 0.02, delta=1e-4)
        self.assertAlmostEqual(stored["dry_friction"], 0.0, delta=0.01)
        self.assertLess(stored["dry_friction_stddev"], 0.01)
        self.assertGreater(stored["friction_damping_gain"], 0.1)
        self.assertGreaterEqual(stored["learned_to"] - stored["learned_from"], LEARN_TIME - 1.0)
        self.assertAlmostEqual(learned.nominal_damping_to_mass, stored["damping_to_mass"], delta=1e-9)
        with self.monitor():
            worn = self.drive(WORN, lambda health: health.level == SuspensionHealth.ERROR, "an error")
        self.assertAlmostEqual(worn.nominal_damping_to_mass, stored["damping_to_mass"], delta=1e-9)
        self.assertRegex(worn.reason, r"^damping [34][0-9] % below baseline")
        self.assertEqual(self.stored(), stored)

    def test_has_the_temperature_of_the_damper(self):
        thermometer = rospy.Publisher("/damper/temperature", Temperature, queue_size=1)
        reading = Temperature(temperature=41.5)
        reading.header.stamp = rospy.Time.now()
        with self.monitor(temperature_topic="/damper/temperature"):
            timer = rospy.Timer(rospy.Duration(0.1), lambda _: thermometer.publish(reading))
            self.drive(HEALTHY, lambda health: abs(health.damping_change) < 1.0, "a judgement by the baseline")
            timer.shutdown()
        stored = self.stored()
        self.assertAlmostEqual(stored["temperature"], 41.5, delta=1e-9)
        self.assertAlmostEqual(stored["damping_per_kelvin"], 0.0, delta=1e-6)
        self.assertAlmostEqual(stored["damping_per_kelvin_stddev"], 0.005, delta=1e-6)

    def test_service_makes_the_present_strut_the_baseline(self):
        with self.monitor():
            rospy.wait_for_service("/monitor/save_baseline")
            save = rospy.ServiceProxy("/monitor/save_baseline", Trigger)
            refused = save()
            self.assertFalse(refused.success)
            self.assertIn("no valid estimate", refused.message)
            self.health.wait_for_publisher()
            with self.simulator({**WORN, "duration": 3600.0}):
                self.health.wait_for(lambda health: health.learning_progress > 0.5, "a valid estimate")
                saved = save()
                self.assertTrue(saved.success, saved.message)
                wait_until(lambda: "baseline" in self.health.messages[-1].reason
                           and "learning" not in self.health.messages[-1].reason, "a judgement by it")
        self.assertAlmostEqual(self.stored()["damping_to_mass"], 0.6 * B1, delta=0.1)

    def test_service_refuses_an_estimate_that_could_prove_nothing(self):
        with self.monitor(health={"damping_warn": 0.001, "damping_error": 0.002}):
            with self.simulator({**HEALTHY, "duration": 3600.0}):
                self.health.wait_for(lambda health: health.learning_progress > 0.3, "a valid estimate")
                refused = rospy.ServiceProxy("/monitor/save_baseline", Trigger)()
        self.assertFalse(refused.success)
        self.assertRegex(refused.message, r"too uncertain .* = [0-9.]+ \+- [0-9.]+, so that damage of 0.2 % would not be")
        self.assertFalse(os.path.exists(self.path))

    def test_broken_file_is_refused_by_name_key_value_and_what_is_allowed(self):
        broken = {"damping_to_mass: -3\nstiffness_to_mass: 13.8\n": ["damping_to_mass = -3", "must be in"],
                  "damping_to_mass: 3\n": ["stiffness_to_mass is missing"],
                  "damping_to_mass: 3\nstiffness_to_mass: 13.8\nstifness: 1\n": ["unknown option stifness"],
                  "damping_to_mass: 3\ndamping_to_mass_stddev: 2\nstiffness_to_mass: 13.8\n":
                      ["damping_to_mass_stddev = 2", "at most half"],
                  "damping_to_mass: 3\nstiffness_to_mass: 13.8\ndry_friction: 0.1\n": ["dry_friction_stddev is missing"],
                  "damping_to_mass: [": ["line 1"]}
        for text, parts in broken.items():
            with open(self.path, "w", encoding="utf-8") as stream:
                stream.write(text)
            with self.monitor() as monitor:
                self.assertNotEqual(monitor.wait_for_end(), 0)
                for part in [self.path, *parts]:
                    self.assertIn(part, monitor.output())

    def test_nominal_values_beside_a_file_are_refused(self):
        with self.monitor(nominal={"damping_to_mass": 3.0}) as monitor:
            self.assertNotEqual(monitor.wait_for_end(), 0)
            self.assertIn("baseline_file", monitor.output())
            self.assertIn("must be one of them: take nominal, which identify -o writes, out", monitor.output())


if __name__ == "__main__":
    rospy.init_node("baseline_test")
    rostest.rosrun(PACKAGE, "baseline", BaselineTest)
