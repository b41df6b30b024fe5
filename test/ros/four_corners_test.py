#!/usr/bin/env python3
"""The launch file of four corners as users start it: a worn corner is named, in its message and in the tree."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from ros_session import PACKAGE, Collector, launch
from suspension_health_monitor.msg import CornerComparison

CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
WORN = "rear_left"
FRACTION = 0.65
DAMPING_TOLERANCE = 0.05  # memory 1000 rows = 5 s of a stochastic road; the bound that still tells 0.65 from 0.75


def branch(array, name):
    return next((status for status in array.status if status.name == name), None)


def is_as_expected(tree):
    """Whether the tree has all branches, and warns of the worn corner alone."""
    def level(name):
        status = branch(tree, f"/Suspension/{name}")
        return status.level if status is not None else None
    tasks = [branch(tree, f"/Suspension/{corner}/{task}") for corner in CORNERS for task in ("Input", "Health", "Model")]
    return (all(status is not None and status.hardware_id == status.name.split("/")[2] for status in tasks)
            and level("vehicle/Corners") == DiagnosticStatus.WARN
            and all(level(f"{corner}/Health") == (DiagnosticStatus.ERROR if corner == WORN else DiagnosticStatus.OK)
                    for corner in CORNERS))


class FourCornersTest(unittest.TestCase):
    def setUp(self):
        self.comparison = Collector("/corners/comparison", CornerComparison)
        self.tree = Collector("/diagnostics_agg", DiagnosticArray)

    def tearDown(self):
        self.comparison.stop()
        self.tree.stop()

    def test_the_worn_corner_is_named_and_its_branch_of_the_tree_is_not_ok(self):
        with launch("four_corners_simulation.launch", worn=WORN, worn_fraction=FRACTION, real_time_factor=4,
                    duration=3600):
            named = self.comparison.wait_for(lambda message: message.level == CornerComparison.WARN, "a warning")
            self.tree.wait_for(is_as_expected, "every branch, the worn corner's not OK")
        self.assertEqual(tuple(named.corners), CORNERS)
        for corner, verdict in zip(named.corners, bytes(named.verdicts)):
            self.assertEqual(verdict, CornerComparison.DAMPER if corner == WORN else CornerComparison.ALIKE, corner)
        self.assertTrue(named.sentence.startswith(f"{WORN} damping "), named.sentence)
        self.assertAlmostEqual(named.damping_deviation[CORNERS.index(WORN)], FRACTION - 1.0, delta=DAMPING_TOLERANCE)


if __name__ == "__main__":
    rospy.init_node("four_corners_test")
    rostest.rosrun(PACKAGE, "four_corners", FourCornersTest)
