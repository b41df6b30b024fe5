#!/usr/bin/env python3
"""The missing effect found, added and saved while the drive goes on: ~diagnose, ~set_effects, ~save_model."""
import os
import tempfile
import threading
import unittest

import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from ros_session import PACKAGE, Collector, load_nodelet, start_node, statuses, values, wait_until
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger
from suspension_health_monitor.msg import ModelComparison, ParameterEstimate
from suspension_health_monitor.srv import Diagnose, SetEffects

START = 1000.0  # [s] stamp of the first sample
# The wheel of the vehicle "ugv" on its road, b1 = 4 1/s, b0 = 40 1/s^2, and what the strut hides.
EFFECT, COEFFICIENT, STIFFNESS_TO_MASS = "quadratic_damping", 1.6, 40.0
DRIVE = {"scenario": "iso_road", "vehicle": "ugv", "rate": 100.0, "noise": 0.03, "start_time": START,
         "duration": 3600.0, "real_time_factor": 10.0, "effects": {EFFECT: {"coefficient": COEFFICIENT}}}
SETTINGS = {"diagnose": {"window": 60.0}}
KEPT = 60.0  # [s]
WINDOW = 10.0  # [s] memory of rmse
SETTLED = 5 * WINDOW  # the square of what was before has decayed to exp(-5)


def proxy(monitor, service, service_type):
    rospy.wait_for_service(f"/{monitor}/{service}", 10.0)
    return rospy.ServiceProxy(f"/{monitor}/{service}", service_type)


class Services:
    def __init__(self, monitor):
        self.diagnose = proxy(monitor, "diagnose", Diagnose)
        self.set_effects = proxy(monitor, "set_effects", SetEffects)
        self.save_model = proxy(monitor, "save_model", Trigger)


def load_monitor(name, **parameters):
    return load_nodelet("MonitorNodelet", name, {**SETTINGS, **parameters})


class Call(threading.Thread):
    """A service call that goes on beside the test."""

    def __init__(self, service, *arguments):
        super().__init__(daemon=True)
        self._call = lambda: service(*arguments)
        self.response = self.error = None
        self.start()

    def run(self):
        try:
            self.response = self._call()
        except rospy.ServiceException as error:
            self.error = error

    def ended(self):
        return not self.is_alive()


def two_searches(monitor):
    """Two calls at the same time."""
    return [Call(proxy(monitor, "diagnose", Diagnose), 0.0) for _ in range(2)]


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
        cls.programs.append(load_nodelet("SimulatorNodelet", "drive", DRIVE))
        cls.search_and_extend()

    @classmethod
    def tearDownClass(cls):
        for program in reversed(cls.programs):
            program.stop()
        cls.folder.cleanup()

    @classmethod
    def ask_everything_too_early(cls):
        return cls.services.diagnose(0.0), cls.services.set_effects(["bump_stop"], [], []), cls.services.save_model()

    @classmethod
    def drive_on(cls, seconds):
        """Waits until that much of the drive has been compared; the comparisons of this part."""
        begin = len(cls.comparison.messages)
        stamp = cls.now() + rospy.Duration(seconds)
        cls.comparison.wait_for(lambda message: message.header.stamp >= stamp, 30.0 + seconds, f"{seconds} s of drive")
        return cls.comparison.messages[begin:]

    @classmethod
    def now(cls):
        return cls.la.wait_for(lambda message: True, 10.0, "an estimate") and cls.la.messages[-1].header.stamp

    @classmethod
    def search_and_extend(cls):
        cls.drive_on(3.0)
        cls.after_three_seconds = cls.services.diagnose(0.0)
        cls.plain = cls.drive_on(KEPT)
        cls.imu_before, cls.la_before = len(cls.imu.messages), len(cls.la.messages)
        cls.found, cls.refused = cls.call_twice("live")
        cls.imu_after, cls.la_after = len(cls.imu.messages), len(cls.la.messages)
        cls.status_found = cls.next_status()
        cls.extended_answer = cls.services.set_effects(cls.found.selected, [], [])
        cls.drive_on(SETTLED)
        cls.extended = cls.drive_on(WINDOW)
        cls.status_extended = cls.next_status()
        cls.saved = cls.services.save_model()

    @classmethod
    def call_twice(cls, monitor):
        """(answer of the call that searched, answer of the call that came meanwhile)."""
        calls = two_searches(monitor)
        wait_until(lambda: all(call.ended() for call in calls), 60.0, "the end of the search")
        return sorted((call.response for call in calls), key=lambda answer: answer.success, reverse=True)

    @classmethod
    def next_status(cls):
        begin = len(statuses(cls.diagnostics, "live: Model"))
        return wait_until(lambda: statuses(cls.diagnostics, "live: Model")[begin:], 5.0, "a status of the model")[0]

    def test_too_early_is_said_in_words(self):
        diagnose, effects, save = self.before_the_drive
        self.assertFalse(diagnose.success or effects.success or save.success)
        self.assertIn("sample period", diagnose.message)
        self.assertIn("bump_stop/g [m] is not known yet", effects.message)
        self.assertIn("no valid estimate", save.message)
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
        arrived, estimated = self.imu_after - self.imu_before, self.la_after - self.la_before
        self.assertGreater(arrived, 20, "the search has taken no time: it says nothing")
        self.assertGreater(estimated, 0.5 * arrived)
        self.assertEqual(int(values(statuses(self.diagnostics, "live: Input")[-1])["gaps"]), 0)

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
        self.assertAlmostEqual(self.extended[-1].base_rmse, self.found.base_held_out_rmse,
                               delta=0.5 * self.found.base_held_out_rmse)

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
            estimates.wait_for(lambda message: message.effect_names == [EFFECT], 10.0, "the effect of the file")
        estimates.stop()

    def test_model_is_not_saved_where_no_file_can_be(self):
        path = os.path.join(self.folder.name, "none", "model.yaml")
        for name, parameters, words in (("unwritable", {"model_file": path}, path), ("fileless", {}, "model_file")):
            estimates = Collector(f"/{name}/la", ParameterEstimate)
            with load_monitor(name, **parameters):
                estimates.wait_for(lambda message: message.valid, 20.0, "a valid estimate")
                answer = Services(name).save_model()
            estimates.stop()
            self.assertFalse(answer.success)
            self.assertIn(words, answer.message)
        self.assertFalse(os.path.exists(os.path.dirname(path)))

    def test_wrong_effects_are_refused_and_change_nothing(self):
        for names, shapes, words in (
                (["bump"], {}, ["effect bump", "bump_stop", "quadratic_damping"]),
                (["clock_offset"], {}, ["effect clock_offset", "quadratic_damping"]),
                ([EFFECT, EFFECT], {}, [EFFECT, "twice"]),
                (["bump_stop"], {"bump_stop/gap": 0.1}, ["bump_stop/gap", "bump_stop/g"]),
                (["bump_stop"], {"bump_stop/g": -0.1}, ["bump_stop/g = -0.1", "above 0"])):
            answer = self.services.set_effects(names, list(shapes), list(shapes.values()))
            self.assertFalse(answer.success, names)
            for word in words:
                self.assertIn(word, answer.message)
        self.assertIn("shape_names", self.services.set_effects(["bump_stop"], ["bump_stop/g"], []).message)
        stamp = self.now()
        newest = self.la.wait_for(lambda message: message.header.stamp > stamp, 10.0, "a new estimate")
        self.assertEqual(newest.effect_names, [EFFECT])

    def test_window_beyond_what_is_kept_is_refused(self):
        for window in (-1.0, 2 * KEPT, float("nan")):
            answer = self.services.diagnose(window)
            self.assertFalse(answer.success)
            self.assertIn("must be in [0, 60", answer.message)

    def test_shapes_of_the_drive_are_taken_where_none_are_given(self):
        estimates = Collector("/shaped/la", ParameterEstimate)
        with load_monitor("shaped"):
            first = estimates.wait_for(lambda message: message.valid, 20.0, "a valid estimate").header.stamp
            estimates.wait_for(lambda message: (message.header.stamp - first).to_sec() > 10.0, 20.0, "motion")
            services = Services("shaped")
            for names, shapes in ((["bump_stop"], {}), (["bump_stop", EFFECT], {"bump_stop/g": 0.02}), ([], {})):
                answer = services.set_effects(names, list(shapes), list(shapes.values()))
                self.assertTrue(answer.success, answer.message)
                stamp = estimates.messages[-1].header.stamp
                newest = estimates.wait_for(
                    lambda message: message.header.stamp > stamp and message.effect_names == names, 10.0, f"{names}")
                self.assertEqual(len(newest.effect_coefficients), len(names))
        estimates.stop()

    def test_law_of_the_user_is_in_the_model_from_the_start(self):
        path = os.path.join(self.folder.name, "laws.yaml")
        with open(path, "w", encoding="utf-8") as stream:
            stream.write('effects: {my_damper: {force: "v * abs(v)", unit: "1/m"}}')
        estimates = Collector("/own/la", ParameterEstimate)
        with load_monitor("own", effects_file=path, effects=["my_damper", EFFECT]):
            estimates.wait_for(lambda message: message.effect_names == ["my_damper", EFFECT], 20.0, "both effects")
            answer = Services("own").set_effects(["my_damper"], [], [])
            self.assertTrue(answer.success, answer.message)
            last = estimates.wait_for(lambda message: message.effect_names == ["my_damper"] and message.valid, 20.0,
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
            comparisons.wait_for(lambda message: message.header.stamp >= end, 60.0, "enough to search in")
            services = Services("tilted")
            found = services.diagnose(0.0)
            answer = services.set_effects(found.selected, [], [])
        comparisons.stop()
        self.assertEqual((found.verdict, found.selected), ("effect_found", ["mount_tilt"]))
        for name, value in zip(found.coefficient_names, found.coefficients):
            self.assertAlmostEqual(value, {"mount_tilt/c_x": 0.06, "mount_tilt/c_y": -0.04}[name], delta=0.006)
        self.assertFalse(answer.success)
        self.assertIn("effect mount_tilt", answer.message)

    def test_end_of_the_node_ends_a_search(self):
        comparisons = Collector("/node/comparison", ModelComparison)
        with start_node("monitor_node", "node", SETTINGS) as node:
            first = comparisons.wait_for(lambda message: True, 20.0, "a comparison")
            comparisons.wait_for(lambda message: (message.header.stamp - first.header.stamp).to_sec() > 40.0, 30.0,
                                 "enough to search in")
            calls = two_searches("node")
            wait_until(lambda: any(call.ended() for call in calls), 10.0, "a refusal of the second call")
            node.stop()
            self.assertEqual(node.wait_for_end(0.0), 0, node.output())
        comparisons.stop()

    def test_unloading_ends_a_search(self):
        comparisons = Collector("/short_lived/comparison", ModelComparison)
        with load_monitor("short_lived") as monitor:
            first = comparisons.wait_for(lambda message: True, 20.0, "a comparison")
            comparisons.wait_for(lambda message: (message.header.stamp - first.header.stamp).to_sec() > 40.0, 30.0,
                                 "enough to search in")
            calls = two_searches("short_lived")
            wait_until(lambda: any(call.ended() for call in calls), 10.0, "a refusal of the second call")
            search = next(call for call in calls if not call.ended())
            monitor.stop()
            wait_until(search.ended, 10.0, "an answer of the service")
        comparisons.stop()
        self.assertIsNotNone(search.error)
        stamp = self.now()
        self.la.wait_for(lambda message: message.header.stamp > stamp, 10.0, "the other nodelets of the manager")


if __name__ == "__main__":
    rospy.init_node("live_search_test")
    rostest.rosrun(PACKAGE, "live_search", LiveSearchTest)
