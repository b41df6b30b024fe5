#!/usr/bin/env python3
"""vehicle.launch on the messages of a simulated half car with a tow bar whose force is measured: both struts, their
coupling and what the bar does to them near the truth, the services, silent sensors named, and vehicle files and
parameters that are refused."""
import os
import tempfile
import unittest

import numpy as np
import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import WrenchStamped
from ros_session import (PACKAGE, PATIENCE, UNLIMITED, Collector, launch, load_nodelet, read_bag, run_tool, statuses,
                         values, wait_until)
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger
from suspension_health_monitor.msg import CouplingInUse, ParameterEstimate, StrutCurve
from suspension_health_monitor.srv import Diagnose, DiagnoseVehicle, SetEffects

STRUTS = ("front", "rear")
DURATION = 60.0  # [s]
SEARCHED = 30.0  # [s]
BATCH = 100  # instants on their way at once; fewer than any queue holds
DEAD, DEAD_FOR = "/front/unsprung/imu", 500  # a topic, and how many instants it ends before the others
COUPLED = 1500  # instants after which the coupling is known for long; before, no estimates tell what has been taken in
# Of LA with its memory of 2 s the median over the second half of the drive; both struts of a half car at 100 Hz with
# noise of 0.03 m/s^2 lie within 2 %.
TOLERANCE = 0.03
COUPLING_TOLERANCE = 0.03  # of the ratios [-], and of the tow bar's coefficients, as shares of the largest
TOW_BAR = ("--set", "known_forces/tow_bar/x=-2.5", "--set", "known_forces/tow_bar/rms=150")


def service(name, service_type):
    rospy.wait_for_service(name, PATIENCE)
    return rospy.ServiceProxy(name, service_type)


class VehicleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        bag, cls.vehicle = (os.path.join(cls.folder.name, name) for name in ("drive.bag", "vehicle.yaml"))
        run_tool("simulate", "--vehicle-model", "half_sedan", "--duration", str(DURATION), "--rate", "100",
                 "--seed", "7", *TOW_BAR, "-o", bag, "--vehicle-file", cls.vehicle)
        cls.baselines = {name: os.path.join(cls.folder.name, f"{name}.yaml") for name in STRUTS}
        cls.strut_config = cls.write("struts.yaml", {
            "struts": {name: {"baseline_file": path} for name, path in cls.baselines.items()}})
        with open(cls.vehicle, encoding="utf-8") as stream:
            cls.layout = yaml.safe_load(stream)
        cls.messages = read_bag(bag)
        cls.rosout = Collector("/rosout", Log)
        cls.diagnostics = Collector("/diagnostics", DiagnosticArray)
        cls.tree = Collector("/diagnostics_agg", DiagnosticArray)
        cls.coupling = Collector("/vehicle/coupling", CouplingInUse)
        cls.la = {name: Collector(f"/{name}/la", ParameterEstimate) for name in STRUTS}
        cls.springs = {name: Collector(f"/{name}/spring_curve", StrutCurve) for name in STRUTS}
        cls.models = cls.write("models.yaml", {"struts": {"front": {"damping_to_mass": 3.0, "stiffness_to_mass": 50.0}}})
        cls.program = launch("vehicle.launch", vehicle=cls.vehicle, strut_config=cls.strut_config,
                             model_file=cls.models, aggregate="true")
        for collector in cls.la.values():
            collector.wait_for_publisher()
        cls.unknown = cls.coupling.wait_for(lambda message: True, "what is known at first")
        for task in ("front: Health", "rear: Health", "vehicle: Coupling"):
            wait_until(lambda name=task: statuses(cls.diagnostics.messages, name), f"a status of {task}")
        cls.drive()

    @classmethod
    def tearDownClass(cls):
        cls.program.stop()
        for collector in (cls.rosout, cls.diagnostics, cls.tree, cls.coupling, *cls.la.values()):
            collector.stop()
        cls.folder.cleanup()

    @classmethod
    def write(cls, name, content):
        path = os.path.join(cls.folder.name, name)
        with open(path, "w", encoding="utf-8") as stream:
            yaml.safe_dump(content, stream)
        return path

    @classmethod
    def drive(cls):
        """Publishes the drive by batches, each of which the monitor has taken in before the next one; then nothing
        comes any more, until that is told."""
        topics = {strut[side]: Imu for strut in cls.layout["struts"].values()
                  for side in ("sprung_imu", "unsprung_imu")}
        topics[cls.layout["known_forces"]["tow_bar"]["topic"]] = WrenchStamped
        publishers = {topic: rospy.Publisher(topic, kind, queue_size=UNLIMITED, tcp_nodelay=True)
                      for topic, kind in topics.items()}
        for publisher in publishers.values():
            wait_until(publisher.get_num_connections, f"a subscriber of {publisher.name}")
        first = next(iter(topics))
        count = len(cls.messages[first])
        for begin in range(0, count, BATCH):
            end = min(begin + BATCH, count)
            for index in range(begin, end):
                for topic, publisher in publishers.items():
                    if topic != DEAD or index < count - DEAD_FOR:
                        publisher.publish(cls.messages[topic][index])
            if COUPLED <= end <= count - DEAD_FOR:
                cls.wait_until_taken_in(first, end - 1)
        cls.stale = {name: wait_until(lambda task=f"{name}: Health": next(
            (status for status in statuses(cls.diagnostics.messages, task) if f", {DEAD} is silent; " in status.message),
            None), f"{name} to name the topic that has ended") for name in STRUTS}
        cls.silence = wait_until(lambda: next(
            (status for status in statuses(cls.diagnostics.messages, "vehicle: Input")
             if all(f"no message on {topic}" in status.message for topic in topics)), None), "the silent sensors")

    @classmethod
    def wait_until_taken_in(cls, topic, index):
        late = 2.0  # [s] that estimates may be behind: filters of alignment, coupling and free run
        stamp = cls.messages[topic][index].header.stamp - rospy.Duration(late)
        for name, collector in cls.la.items():
            collector.wait_for(lambda message: message.header.stamp >= stamp, f"{name} at sample {index}")

    def truth(self, name):
        return self.messages[f"/simulator/{name}/truth"][0]

    def test_struts_are_near_the_truth(self):
        for name, collector in self.la.items():
            half = self.messages["/simulator/truth"][0].header.stamp + rospy.Duration(0.5 * DURATION)
            late = [message for message in collector.messages if message.header.stamp > half and message.valid]
            self.assertGreater(len(late), 1000, name)
            for figure in ("damping_to_mass", "stiffness_to_mass"):
                true = getattr(self.truth(name), figure)
                found = float(np.median([getattr(message, figure) for message in late]))
                self.assertAlmostEqual(found / true, 1.0, delta=TOLERANCE, msg=f"{name} {figure}")

    def test_curves_of_every_strut_are_its_own(self):
        for name, collector in self.springs.items():
            curve = collector.wait_for(lambda message: True, "a curve of the spring")
            self.assertGreater(len(curve.at), 10)
            for at, force, stddev in zip(curve.at, curve.force, curve.stddev):  # which do not know of the coupling's error
                true = self.truth(name).stiffness_to_mass * at
                self.assertAlmostEqual(force, true, delta=4.0 * stddev + COUPLING_TOLERANCE * abs(true), msg=f"{name} at {at}")

    def test_coupling_is_not_known_at_first_and_then_that_of_the_body(self):
        self.assertFalse(self.unknown.known)
        self.assertTrue(self.unknown.reason)
        self.assertTrue(np.isnan(self.unknown.ratios).all())
        known = self.coupling.wait_for(lambda message: message.known, "the coupling")
        self.assertEqual((tuple(known.names), known.reason), (STRUTS, ""))
        truth = self.messages["/simulator/truth"][0]
        self.assertEqual(tuple(truth.struts), STRUTS)
        last = self.coupling.messages[-1]
        self.assertTrue(last.known)
        np.testing.assert_allclose(last.ratios, truth.coupling, atol=COUPLING_TOLERANCE)
        self.assertLess(max(last.stddevs), COUPLING_TOLERANCE)
        self.assertTrue(np.isnan(last.mass_to_pitch_inertia), "two struts do not tell")
        self.assertEqual(list(last.forces), ["tow_bar"])
        true = self.force_coefficients()
        self.assertLess(true[0], 0.0, "what lifts the rear lowers the front")
        np.testing.assert_allclose(last.force_coefficients, true, atol=COUPLING_TOLERANCE * max(true))
        self.assertLess(max(last.force_stddevs), COUPLING_TOLERANCE * max(true))

    def force_coefficients(self):
        """@return 1/M + x_i x / Iyy by strut, from the simulator's forces and accelerations, which have no noise."""
        body = self.messages["/simulator/truth"]
        columns = np.array([[*message.forces, *message.known_forces] for message in body])
        return [np.linalg.lstsq(columns, np.array([message.sprung_acceleration for message in
                                                   self.messages[f"/simulator/{name}/truth"]]), rcond=None)[0][-1]
                for name in STRUTS]

    def test_diagnostics_have_tasks_of_struts_and_vehicle(self):
        def told(task):
            return [status for status in statuses(self.diagnostics.messages, task)
                    if status.message != "Node starting up"]  # what an updater says of a task that is added

        for name in STRUTS:
            begin = told(f"{name}: Health")[0]
            self.assertEqual((begin.level, begin.hardware_id), (DiagnosticStatus.STALE, name))
            judged = statuses(self.diagnostics.messages, f"{name}: Health")
            self.assertTrue(any("la valid" in values(status) for status in judged), f"{name} has been judged")
            self.assertTrue(statuses(self.diagnostics.messages, f"{name}: Model"))
        coupled = told("vehicle: Coupling")
        self.assertEqual((coupled[0].level, coupled[-1].level), (DiagnosticStatus.STALE, DiagnosticStatus.OK))
        self.assertIn("front moved by rear", values(coupled[-1]))
        self.assertIn("rear moved by tow_bar", values(coupled[-1]))

    def test_tree_has_the_struts_below_every_task(self):
        expected = {f"/Suspension/{task}/{name}: {task}" for task in ("Health", "Model", "Input") for name in STRUTS}
        expected |= {"/Suspension/Coupling/vehicle: Coupling", "/Suspension/Input/vehicle: Input"}
        self.tree.wait_for(lambda array: expected <= {status.name for status in array.status}, sorted(expected))

    def test_silent_sensors_are_named(self):
        self.assertEqual(self.silence.level, DiagnosticStatus.ERROR)
        for name, status in self.stale.items():
            self.assertEqual(status.level, DiagnosticStatus.STALE, name)
            self.assertTrue(status.message.startswith("cannot tell: no reading accepted for "), status.message)
        inputs = {name: self.next_status(f"{name}: Input") for name in STRUTS}
        self.assertIn(f"no message on {DEAD}", inputs["front"].message)
        self.assertNotIn(DEAD, inputs["rear"].message)

    def test_search_answers_by_strut(self):
        answer = service("/vehicle/diagnose", DiagnoseVehicle)(SEARCHED)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.verdict, "nothing_missing", answer.message)
        self.assertEqual((tuple(answer.strut), list(answer.verdicts), list(answer.selected)),
                         (STRUTS, ["nothing_missing"] * 2, [""] * 2))
        self.assertIn("must be in [0, 120]", service("/vehicle/diagnose", DiagnoseVehicle)(-1.0).message)
        own = service("/rear/diagnose", Diagnose)(SEARCHED)
        self.assertTrue(own.success, own.message)
        self.assertEqual((own.verdict, list(own.selected)), ("nothing_missing", []))
        self.assertGreater(own.noise_floor, 0.0)

    def test_services_of_a_strut_change_this_strut(self):
        answer = service("/rear/set_effects", SetEffects)(["bump"], [], [])
        self.assertFalse(answer.success)
        self.assertIn("effect bump", answer.message)
        answer = service("/rear/set_effects", SetEffects)(["quadratic_damping"], [], [])
        self.assertTrue(answer.success, answer.message)
        self.assertIn("quadratic_damping", answer.message)
        models = {name: self.next_status(f"{name}: Model") for name in STRUTS}
        self.assertIn("quadratic_damping", models["rear"].message)
        self.assertEqual(models["front"].message, "the linear strut")
        self.assertTrue(service("/rear/set_effects", SetEffects)([], [], []).success)
        saved = service("/front/save_baseline", Trigger)()
        self.assertTrue(saved.success, saved.message)
        self.assertTrue(os.path.exists(self.baselines["front"]))

    def test_models_of_all_struts_are_one_file(self):
        saved = service("/rear/save_model", Trigger)()
        self.assertTrue(saved.success, saved.message)
        with open(self.models, encoding="utf-8") as stream:
            models = yaml.safe_load(stream)["struts"]
        self.assertEqual(models["front"], {"damping_to_mass": 3.0, "stiffness_to_mass": 50.0})
        true = self.truth("rear")
        self.assertAlmostEqual(models["rear"]["damping_to_mass"] / true.damping_to_mass, 1.0, delta=0.1)

    def next_status(self, task):
        begin = len(statuses(self.diagnostics.messages, task))
        return wait_until(lambda: statuses(self.diagnostics.messages, task)[begin:], f"a status of {task}")[0]

    def test_wrong_files_and_parameters_are_refused_by_name(self):
        no_wheel = self.write("no_wheel.yaml", {"struts": {"front": {"sprung_imu": "/a"}}})
        no_field = self.write("no_field.yaml", {"struts": {"front": {"sprung_imu": "/a", "unsprung_imu": "/b"}},
                                                "known_forces": {"bar": {"topic": "/c", "field": "force"}}})
        strangers = self.write("strangers.yaml", {"struts": {"middle": {"damping_to_mass": 3, "stiffness_to_mass": 50}}})
        cases = ({}, ["vehicle is missing"]), \
            ({"vehicle": "/none.yaml"}, ["vehicle = /none.yaml"]), \
            ({"vehicle": no_wheel}, [no_wheel, "struts/front/unsprung_imu is missing"]), \
            ({"vehicle": no_field}, [no_field, 'known_forces/bar/field = "force"', "must be one of force.x"]), \
            ({"vehicle": self.vehicle, "struts": {"middle": {"sprung_mass": 100.0}}},
             ["struts/middle", "must be one of front, rear"]), \
            ({"vehicle": self.vehicle, "struts": {"rear": {"sprung_mass": -1.0}}}, ["struts/rear: sprung_mass = -1"]), \
            ({"vehicle": self.vehicle, "struts": {"rear": {"sample_period": 0.01}}},
             ["struts/rear/sample_period", "of the whole vehicle"]), \
            ({"vehicle": {"struts": {"front": {"sprung_imu": "/a"}}}},
             ["vehicle: struts/front/unsprung_imu is missing"]), \
            ({"vehicle": self.vehicle, "model_file": strangers}, [strangers, "struts/middle", "front, rear"]), \
            ({"vehicle": self.vehicle, "baseline_file": "/tmp/one.yaml"}, ["baseline_file", "front", "rear"]), \
            ({"vehicle": self.vehicle, "memry": 2.0}, ["unknown option memry"])
        for number, (parameters, parts) in enumerate(cases):
            name = f"wrong_vehicle_{number}"
            with load_nodelet("VehicleNodelet", name, parameters) as wrong:
                self.assertNotEqual(wrong.wait_for_end(), 0)
                self.rosout.wait_for(lambda log: log.level >= Log.ERROR and all(part in log.msg for part in
                                                                               [*parts, "/" + name]), parts)


if __name__ == "__main__":
    rospy.init_node("half_car_test")
    rostest.rosrun(PACKAGE, "half_car", VehicleTest)
