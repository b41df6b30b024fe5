#!/usr/bin/env python3
"""The launch file of four corners as users start it, on a simulated sedan: a worn corner is named, in its message and in the
tree, by estimates that are free of what the corners do to one another; and what its arguments make of the vehicle."""
import os
import tempfile
import unittest

import rosgraph
import rosnode
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from ros_session import PACKAGE, Collector, launch, wait_until
from suspension_health_monitor.msg import CornerComparison, CouplingInUse

CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
WORN = "rear_left"
FRACTION = 0.65
DAMPING_TOLERANCE = 0.05  # memory 5 s of a stochastic road; the bound that still tells 0.65 from 0.75. A corner of the sedan
                          # that is judged alone is off by 7 to 34 %.
RATIO_TOLERANCE = 0.05
SEDAN = ((1.0, 0.078, 0.381, -0.419), (0.078, 1.0, -0.419, 0.381),  # a_ij / a_jj, as `suspension_bag simulate
         (0.428, -0.470, 1.0, 0.221), (-0.470, 0.428, 0.221, 1.0))  # --vehicle-model sedan` prints them
SERVICES = ("set_effects", "save_model", "save_baseline", "diagnose", "reset")
TOPICS = ("estimate", "ls", "la", "comparison", "health", "model")


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
            and level("vehicle/Coupling") == DiagnosticStatus.OK
            and level("vehicle/Input") is not None
            and all(level(f"{corner}/Health") == (DiagnosticStatus.ERROR if corner == WORN else DiagnosticStatus.OK)
                    for corner in CORNERS))


def is_undecided(message):
    return message.level == CornerComparison.STALE and message.sentence.startswith("cannot tell: 0 of 4 corners")


class FourCornersTest(unittest.TestCase):
    def setUp(self):
        self.comparison = Collector("/corners/comparison", CornerComparison)
        self.tree = Collector("/diagnostics_agg", DiagnosticArray)
        self.coupling = Collector("/vehicle/coupling", CouplingInUse)

    def tearDown(self):
        self.comparison.stop()
        self.tree.stop()
        self.coupling.stop()

    def test_the_worn_corner_is_named_and_its_branch_of_the_tree_is_not_ok(self):
        diagnostics = Collector("/diagnostics", DiagnosticArray)
        with launch("four_corners_simulation.launch", worn=WORN, worn_fraction=FRACTION, real_time_factor=4,
                    duration=3600):
            named = self.comparison.wait_for(lambda message: message.level == CornerComparison.WARN, "a warning")
            self.tree.wait_for(is_as_expected, "every branch, the worn corner's not OK")
            state = rosgraph.Master(rospy.get_name()).getSystemState()
            driven = len(self.comparison.messages)
            said = {status.message for array in list(diagnostics.messages) for status in array.status}
            diagnostics.stop()
            rosnode.kill_nodes(["/simulator"])
            wait_until(lambda: any(map(is_undecided, self.comparison.messages[driven:])), "silent sensors that tell nothing")
        self.assertFalse([message for message in said if "no reading accepted" in message], "while all sensors arrive")
        self.assertEqual(tuple(named.corners), CORNERS)
        for corner, verdict in zip(named.corners, bytes(named.verdicts)):
            self.assertEqual(verdict, CornerComparison.DAMPER if corner == WORN else CornerComparison.ALIKE, corner)
            expected = FRACTION - 1.0 if corner == WORN else 0.0
            deviation = named.damping_deviation[CORNERS.index(corner)]
            self.assertAlmostEqual(deviation, expected, delta=DAMPING_TOLERANCE, msg=corner)
        self.assertTrue(named.sentence.startswith(f"{WORN} damping "), named.sentence)
        known = [message for message in self.coupling.messages if message.known][-1]
        self.assertEqual(tuple(known.names), CORNERS)
        for row, expected in enumerate(SEDAN):
            for column, ratio in enumerate(expected):
                self.assertAlmostEqual(known.ratios[4 * row + column], ratio, delta=RATIO_TOLERANCE)
        published, served = ({name for name, _ in part} for part in (state[0], state[2]))
        self.assertLessEqual({f"/{corner}/{name}" for corner in CORNERS for name in TOPICS}, published)
        self.assertLessEqual({f"/{corner}/{name}" for corner in CORNERS for name in SERVICES}, served)

    def test_arguments_make_the_vehicle(self):
        with tempfile.TemporaryDirectory() as folder:
            config = os.path.join(folder, "front_left.yaml")
            with open(config, "w", encoding="utf-8") as stream:
                stream.write("nominal: {damping_to_mass: 3.0, stiffness_to_mass: 40.0}\n")
            positions = {f"{corner}_position": f"[{x}, {y}, 0.1]" for corner, x, y in
                         zip(CORNERS, (1.0, 1.0, -1.5, -1.5), (0.7, -0.7, 0.7, -0.7))}
            with launch("four_corners.launch", body_imu="/imu/data", front_left_config=config, aggregate="false",
                        rear_left_sprung_imu="/rear_left/top", rear_left_unsprung_imu="/hub/data", **positions):
                self.coupling.wait_for(lambda message: True, "a vehicle that has started")
                self.comparison.wait_for(is_undecided, "that nobody can tell yet")
                heard = wait_until(self.topics_of_vehicle, "the IMUs that it listens to")
                settings = rospy.get_param("/vehicle/struts/front_left")
        self.assertEqual(settings, {"nominal": {"damping_to_mass": 3.0, "stiffness_to_mass": 40.0}})
        self.assertEqual(heard, {"/imu/data", "/rear_left/top", "/hub/data", "/front_left/unsprung/imu",
                                 "/front_right/unsprung/imu", "/rear_right/unsprung/imu"})

    @staticmethod
    def topics_of_vehicle():
        """The topics of IMUs that the manager subscribes, once it has all."""
        subscribers = rosgraph.Master(rospy.get_name()).getSystemState()[1]
        heard = {topic for topic, nodes in subscribers
                 if "/corners_manager" in nodes and ("imu" in topic or topic in ("/rear_left/top", "/hub/data"))}
        return heard if len(heard) >= 6 else None


if __name__ == "__main__":
    rospy.init_node("four_corners_test")
    rostest.rosrun(PACKAGE, "four_corners", FourCornersTest)
