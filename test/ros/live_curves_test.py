#!/usr/bin/env python3
"""The latched topics ~damper_curve and ~spring_curve: of the newest samples, once a minute of drive, beside ~diagnose."""
import unittest

import rospy
import rostest
from live_drive import COEFFICIENT, DRIVE, START, STIFFNESS_TO_MASS, Call, load_monitor, proxy
from ros_session import PACKAGE, PATIENCE, Collector, Pace, load_nodelet, wait_until
from sensor_msgs.msg import Imu
from suspension_health_monitor.msg import ParameterEstimate, StrutCurve
from suspension_health_monitor.srv import Diagnose

EVERY = 60.0  # [s] of drive
DAMPING_TO_MASS = 4.0  # of the vehicle "ugv" [1/s]
LAWS = {"damper": ("velocity", lambda v: DAMPING_TO_MASS * v + COEFFICIENT * v * abs(v)),
        "spring": ("travel", lambda d: STIFFNESS_TO_MASS * d)}


class LiveCurvesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        imu, estimates = Collector("/sprung/imu", Imu), Collector("/curves/estimate", ParameterEstimate)
        cls.curves = {name: Collector(f"/curves/{name}_curve", StrutCurve) for name in LAWS}
        with load_monitor("curves"):
            for collector in (estimates, *cls.curves.values()):
                collector.wait_for_publisher()
            pace = Pace("/live_curves_test/pace", imu, estimates)
            with load_nodelet("SimulatorNodelet", "drive", DRIVE, pace="/live_curves_test/pace"):
                wait_until(lambda: len(cls.curves["damper"].messages) > 1, "two curves")
                search = Call(proxy("curves", "diagnose", Diagnose), 0.0)
                wait_until(lambda: len(cls.curves["damper"].messages) > 2, "a curve during or after a search")
                wait_until(search.ended, "the end of the search")
                cls.found = search.response
                with pace.held():
                    cls.late = {name: rospy.wait_for_message(f"/curves/{name}_curve", StrutCurve, PATIENCE) for name in LAWS}
            pace.stop()

    def test_their_bands_hold_the_laws(self):
        for name, (variable, law) in LAWS.items():
            for curve in self.curves[name].messages:
                self.assertEqual(curve.variable, variable)
                self.assertGreater(len(curve.at), 10)
                self.assertEqual(list(curve.at), sorted(curve.at))
                for at, force, stddev in zip(curve.at, curve.force, curve.stddev):
                    self.assertLessEqual(abs(force - law(at)), 4.0 * stddev, f"{name} at {at}")

    def test_they_come_once_a_minute_of_drive_and_stay(self):
        for name in LAWS:
            stamps = [curve.header.stamp.to_sec() for curve in self.curves[name].messages]
            self.assertGreater(stamps[0], START)
            for before, after in zip(stamps, stamps[1:]):
                self.assertGreaterEqual(after - before, EVERY - 1e-6)  # of stamps as floats
            self.assertIn(self.late[name].header.stamp.to_sec(), stamps, "who comes late gets the last one")

    def test_a_search_goes_on_beside_them(self):
        self.assertTrue(self.found.success, self.found.message)
        self.assertEqual(self.found.verdict, "effect_found")


if __name__ == "__main__":
    rospy.init_node("live_curves_test")
    rostest.rosrun(PACKAGE, "live_curves", LiveCurvesTest)
