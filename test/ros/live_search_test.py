#!/usr/bin/env python3
"""The missing effect found, added and saved while the drive goes on: ~diagnose, ~set_effects, ~save_model."""
import math
import os
import statistics
import tempfile
import unittest

import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from live_drive import COEFFICIENT, DRIVE, EFFECT, KEPT, STIFFNESS_TO_MASS, Services, load_monitor, refused_beside_a_search
from ros_session import PACKAGE, Collector, Pace, load_nodelet, statuses, values, wait_until
from sensor_msgs.msg import Imu
from suspension_health_monitor.msg import ModelComparison, ParameterEstimate

WINDOW = 10.0  # [s] memory of rmse
SETTLED = 5 * WINDOW  # the square of what was before has decayed to exp(-5)


class LiveSearchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.model_file = os.path.join(cls.folder.name, "model.yaml")
        cls.diagnostics = Collector("/diagnostics", DiagnosticArray)
        cls.imu = Collector("/sprung/imu", Imu)
        cls.la = Collector("/live/la", ParameterEstimate)
        cls.comparison = Collector("/live/comparison", ModelComparison)
        cls.programs = [load_monitor("live", model_file=cls.model_file)]
        cls.la.wait_for_publisher()
        cls.services = Services("live")
        cls.before_the_drive = cls.ask_everything_too_early()
        cls.pace = Pace("/live_search_test/pace", cls.imu, cls.la, cls.comparison)
        cls.programs.append(load_nodelet("SimulatorNodelet", "drive", DRIVE, pace="/live_search_test/pace"))
        cls.search_and_extend()

    @classmethod
    def tearDownClass(cls):
        for program in reversed(cls.programs):
            program.stop()
        cls.pace.stop()
        cls.folder.cleanup()

    @classmethod
    def ask_everything_too_early(cls):
        return cls.services.diagnose(0.0), cls.services.set_effects(["bump_stop"], [], []), cls.services.save_model()

    @classmethod
    def drive_on(cls, seconds):
        """Waits until that much of the drive has been compared; the comparisons of this part."""
        begin = len(cls.comparison.messages)
        stamp = cls.now() + rospy.Duration(seconds)
        cls.comparison.wait_for(lambda message: message.header.stamp >= stamp, f"{seconds} s of drive")
        return cls.comparison.messages[begin:]

    @classmethod
    def now(cls):
        return cls.la.wait_for(lambda message: True, "an estimate") and cls.la.messages[-1].header.stamp

    @classmethod
    def search_and_extend(cls):
        cls.drive_on(3.0)
        with cls.pace.held():
            cls.after_three_seconds = cls.services.diagnose(0.0)
        cls.plain = cls.drive_on(KEPT)
        begin = len(cls.la.messages)
        search, refused = refused_beside_a_search("live")
        wait_until(search.ended, "the end of the search")
        cls.found, cls.refused = search.response, refused.response
        cls.estimates_meanwhile = cls.la.messages[begin:]
        cls.status_found = cls.next_status()
        cls.extended_answer = cls.services.set_effects(cls.found.selected, [], [])
        cls.drive_on(SETTLED)
        cls.extended = cls.drive_on(WINDOW)
        cls.status_extended = cls.next_status()
        cls.saved = cls.services.save_model()

    @classmethod
    def next_status(cls):
        begin = len(statuses(cls.diagnostics.messages, "live: Model"))
        return wait_until(lambda: statuses(cls.diagnostics.messages, "live: Model")[begin:], "a status of the model")[0]

    def test_too_early_is_said_in_words(self):
        diagnose, effects, save = self.before_the_drive
        self.assertFalse(diagnose.success or effects.success or save.success)
        self.assertIn("sample period", diagnose.message)
        self.assertTrue(math.isnan(diagnose.base_held_out_rmse) and math.isnan(diagnose.damping_to_mass))
        self.assertIn("bump_stop/g [m] is not known yet", effects.message)
        self.assertIn("no valid estimate, drive on", save.message)
        self.assertFalse(self.after_three_seconds.success)
        self.assertRegex(self.after_three_seconds.message, r"the last [1-9][0-9.]* s .*drive on")

    def test_effect_is_named_with_its_size(self):
        found = self.found
        self.assertTrue(found.success, found.message)
        self.assertEqual((found.verdict, found.selected), ("effect_found", [EFFECT]))
        self.assertIn(EFFECT, found.message)
        self.assertEqual(found.coefficient_names, [EFFECT])
        self.assertAlmostEqual(found.coefficients[0], COEFFICIENT, delta=0.1 * COEFFICIENT)
        self.assertLess(abs(found.coefficients[0] - COEFFICIENT), 5.0 * found.coefficient_stddevs[0])
        self.assertAlmostEqual(found.stiffness_to_mass, STIFFNESS_TO_MASS, delta=0.05 * STIFFNESS_TO_MASS)
        self.assertLess(found.extended_held_out_rmse, 0.7 * found.base_held_out_rmse)
        self.assertGreater(found.extended_fit_percent, found.base_fit_percent)
        self.assertLess(found.noise_floor, 1.2 * found.extended_held_out_rmse)
        self.assertGreater(found.structured_share, 0.3)

    def test_ranking_is_whole_and_in_order(self):
        found = self.found
        self.assertEqual(found.ranked_effects[0], EFFECT)
        self.assertGreater(len(found.ranked_effects), 10)
        lengths = {len(found.ranked_effects), len(found.ranked_held_out_rmse), len(found.ranked_error_removed_percent),
                   len(found.ranked_significant)}
        self.assertEqual(len(lengths), 1)
        self.assertTrue(found.ranked_significant[0])

    def test_estimates_keep_pace_during_the_search(self):
        """The drive waits for a monitor that does not follow; this one has followed until the search was over."""
        self.assertGreater(len(self.estimates_meanwhile), 20, "the search has taken no time, or the monitor stood still")
        self.assertEqual(int(values(statuses(self.diagnostics.messages, "live: Input")[-1])["gaps"]), 0)

    def test_second_call_is_refused_while_one_searches(self):
        self.assertFalse(self.refused.success)
        self.assertIn("running", self.refused.message)

    def test_error_falls_with_the_effect_and_the_base_stays(self):
        self.assertTrue(self.extended_answer.success, self.extended_answer.message)
        self.assertIn(EFFECT, self.extended_answer.message)
        last = self.plain[-1]
        self.assertEqual((last.rmse, last.fit_percent), (last.base_rmse, last.base_fit_percent))
        for message in self.extended:
            self.assertLess(message.rmse, 0.7 * message.base_rmse)
            self.assertGreater(message.fit_percent, message.base_fit_percent)
        # Of the same linear strut as before, on another stretch of the same road.
        before, after = (statistics.mean(message.base_rmse for message in part)
                         for part in (self.plain[-len(self.extended):], self.extended))
        self.assertAlmostEqual(after, before, delta=0.3 * before)

    def test_estimates_go_on_with_the_effect(self):
        last = self.la.messages[-1]
        self.assertTrue(last.valid)
        self.assertEqual(last.effect_names, [EFFECT])
        self.assertAlmostEqual(last.stiffness_to_mass, STIFFNESS_TO_MASS, delta=0.1 * STIFFNESS_TO_MASS)

    def test_diagnostics_warn_until_the_effect_is_in_the_model(self):
        self.assertEqual(self.status_found.level, DiagnosticStatus.WARN)
        self.assertIn(f"not in the model: {EFFECT}", self.status_found.message)
        told = values(self.status_found)
        self.assertEqual((told["diagnosed"], told["diagnosed effects"]), ("effect_found", EFFECT))
        self.assertAlmostEqual(float(told["diagnosed noise floor [m/s^2]"]), self.found.noise_floor, places=3)
        self.assertLess(float(told["diagnosed from stamp [s]"]), float(told["diagnosed to stamp [s]"]) - 0.9 * KEPT)
        self.assertEqual(self.status_extended.level, DiagnosticStatus.OK)
        self.assertEqual(self.status_extended.message, f"the linear strut with {EFFECT}")
        told = values(self.status_extended)
        self.assertIn(f"{EFFECT} [1/m]", told)
        self.assertLess(float(told["rmse [m/s^2]"]), float(told["base rmse [m/s^2]"]))

    def test_saved_model_is_that_of_the_drive_and_starts_another_monitor(self):
        self.assertTrue(self.saved.success, self.saved.message)
        with open(self.model_file, encoding="utf-8") as stream:
            model = yaml.safe_load(stream)
        self.assertAlmostEqual(model["stiffness_to_mass"], STIFFNESS_TO_MASS, delta=0.1 * STIFFNESS_TO_MASS)
        self.assertAlmostEqual(model["effects"][EFFECT]["coefficient"], COEFFICIENT, delta=0.6 * COEFFICIENT)
        self.assertEqual(os.listdir(self.folder.name), ["model.yaml"])
        estimates = Collector("/again/la", ParameterEstimate)
        with load_monitor("again", model_file=self.model_file):
            estimates.wait_for(lambda message: message.effect_names == [EFFECT], "the effect of the file")
        estimates.stop()

    def test_wrong_effects_are_refused_and_change_nothing(self):
        for names, shapes, words in (
                (["bump"], {}, ["effect bump", "bump_stop", "quadratic_damping"]),
                (["clock_offset"], {}, ["effect clock_offset", "quadratic_damping"]),
                ([EFFECT, EFFECT], {}, [EFFECT, "twice"]),
                (["bump_stop"], {"bump_stop/gap": 0.1}, ["bump_stop/gap", "bump_stop/g"]),
                (["bump_stop"], {"bump_stop/g": -0.1}, ["bump_stop/g = -0.1", "must be in"])):
            answer = self.services.set_effects(names, list(shapes), list(shapes.values()))
            self.assertFalse(answer.success, names)
            for word in words:
                self.assertIn(word, answer.message)
        self.assertIn("shape_names", self.services.set_effects(["bump_stop"], ["bump_stop/g"], []).message)
        stamp = self.now()
        newest = self.la.wait_for(lambda message: message.header.stamp > stamp, "a new estimate")
        self.assertEqual(newest.effect_names, [EFFECT])

    def test_window_beyond_what_is_kept_is_refused(self):
        for window in (-1.0, 2 * KEPT, math.nan, math.copysign(math.nan, -1.0)):
            answer = self.services.diagnose(window)
            self.assertFalse(answer.success)
            self.assertIn("must be in [0, 60", answer.message)
            self.assertNotIn("-nan", answer.message)


if __name__ == "__main__":
    rospy.init_node("live_search_test")
    rostest.rosrun(PACKAGE, "live_search", LiveSearchTest)
