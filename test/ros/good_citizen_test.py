#!/usr/bin/env python3
"""What users of neighbouring packages have complained of, one test each; the time under use_sim_time is in
good_citizen_clock_test.py, zero copy in good_citizen_zero_copy.cpp, dynamic_reconfigure in reconfigure_test.py."""
import itertools
import math
import unittest

import numpy as np
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from measured_drive import (DAMPING_TO_MASS, GRAVITY, JUDGED_AFTER, LARGEST_ERROR, PERIOD, VALID_AFTER, MeasuredDrive,
                            make_imu)
from ros_session import PACKAGE, Collector, load_nodelet, statuses, values, wait_until
from suspension_health_monitor.msg import ModelComparison, ParameterEstimate, SuspensionHealth
from tf2_msgs.msg import TFMessage

START = 1000.0  # [s]
LOOPS = 4
OLDEST_DATA = 60.0  # [s] health/oldest_data
STAY = 10.0  # [s] of a vehicle that stands, at once
NOISE = 0.024  # [m/s^2] of the sensors, which a vehicle that stands has, too


def load_monitor(name, **parameters):
    """A monitor that reads NAME/sprung and NAME/unsprung."""
    return load_nodelet("MonitorNodelet", name, {"sample_period": PERIOD, "input_timeout": 3600.0, **parameters},
                        **{"sprung/imu": f"/{name}/sprung", "unsprung/imu": f"/{name}/unsprung"})


def drive_for(name):
    return MeasuredDrive(name, f"/{name}/sprung", f"/{name}/unsprung")


def pitch(frame, target, angle):
    """A frame that is turned by an angle [rad] about y."""
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = target, frame
    transform.transform.rotation.y, transform.transform.rotation.w = math.sin(angle / 2), math.cos(angle / 2)
    return transform


class GoodCitizenTest(unittest.TestCase):
    def setUp(self):
        self.drive = MeasuredDrive()
        self.assertTrue(self.drive.reset().success)
        self.drive.estimates.messages.clear()

    def tearDown(self):
        self.drive.stop()

    def counts(self, accepts, what):
        status = self.drive.input_status(lambda status: accepts(values(status)), what=what,
                                         after=len(self.drive.diagnostics.messages))
        return values(status)

    def test_filters_go_mad_when_a_bag_loops(self):
        for loop in range(LOOPS):
            before = len(self.drive.estimates.messages)
            self.drive.feed(0, 400, START)
            self.drive.assert_estimate_is_good(self)
            first = self.drive.estimates.messages[before:]
            if loop > 0:
                self.assertFalse(first[0].valid, "the last estimate, marked stale")
                self.assertTrue(math.isfinite(first[0].damping_to_mass))
        counted = self.counts(lambda v: v.get("samples") == str(LOOPS * 400), "all samples")
        self.assertEqual(int(counted["clock jumps"]), LOOPS - 1)
        self.assertEqual(int(counted["rejected time_went_back"]), LOOPS - 1)

    def test_zero_old_or_late_stamps_silently_ignored(self):
        before = len(self.drive.diagnostics.messages)

        def wrong_stamps(index, pair):
            sprung, unsprung = pair
            if index == 300:
                sprung.header.stamp = rospy.Time(0)
            elif index == 400:
                unsprung.header.stamp -= rospy.Duration(0.2)
        self.drive.feed(0, 900, START, wrong_stamps)
        counted = self.counts(lambda v: v.get("samples") == "898", "all samples but two")
        self.assertEqual((counted["rejected zero_stamp"], counted["rejected time_went_back"]), ("1", "1"))
        self.assertEqual((counted["sprung rejected"], counted["unsprung rejected"]), ("1", "1"))
        for side in ("sprung", "unsprung"):
            self.assertAlmostEqual(float(counted[f"{side} rate [Hz]"]), 1.0 / PERIOD, delta=0.01)
            self.assertLess(float(counted[f"{side} jitter [s]"]), 1e-6)
            self.assertAlmostEqual(float(counted[f"{side} lag [s]"]), rospy.get_time() - START, delta=100.0)
        for name in ("zero_stamp", "time_went_back"):
            self.drive.input_status(lambda s: "readings rejected: " in s.message and name in s.message, after=before)
        self.drive.assert_estimate_is_good(self)

    def test_late_messages_are_warned_of_when_asked(self):
        with load_monitor("late", max_lag=1.0):
            late = drive_for("late")
            late.feed(0, 200, START)  # decades ago
            late.input_status(lambda s: s.level == DiagnosticStatus.WARN and "sprung IMU is" in s.message)
            late.stop()

    def test_diagnostics_flood_at_sensor_rate(self):
        def stamps():
            return [array.header.stamp.to_sec() for array in self.drive.diagnostics.messages[before:]
                    if statuses([array], self.drive.input_task)]
        before = len(self.drive.diagnostics.messages)
        self.drive.feed(0, 1200, START)  # as fast as it can
        wait_until(lambda: len(stamps()) > 3, "some statuses")
        changes = 4  # of the health's level, at the most, are published at once
        self.assertLessEqual(len(stamps()), stamps()[-1] - stamps()[0] + 2 + changes)

    def test_expected_rate_hard_coded(self):
        with load_monitor("rated", expected_rate={"sprung": 1.0 / PERIOD, "unsprung": 2.0 / PERIOD}):
            rated = drive_for("rated")
            rated.feed(0, 300, START)
            status = rated.input_status(lambda s: "unsprung IMU comes at 50 Hz, expected 100" in s.message)
            self.assertEqual(status.level, DiagnosticStatus.WARN)
            self.assertNotIn("; sprung IMU comes", status.message)
            rated.stop()

    def test_exception_in_oninit_takes_the_manager_down_or_hides(self):
        with load_monitor("refused", forgetting_factor=2.0) as refused:
            self.assertNotEqual(refused.wait_for_end(), 0)
        self.drive.feed(0, 300, START)  # the monitor beside it lives
        self.drive.assert_estimate_is_good(self)

    def test_stale_diagnostics_not_shown(self):
        """A vehicle that stands keeps its level, and shows how old what it rests on is, until that is too old."""
        estimate = Collector("/monitor/estimate", ParameterEstimate)
        estimate.wait_for_publisher()
        noise = np.random.default_rng(1)

        def parked(_, pair):
            for imu in pair:
                imu.linear_acceleration.z = GRAVITY + NOISE * noise.standard_normal()

        def health():
            """The first status that is made from now on: of the newest sample."""
            now = rospy.Time.now()
            return wait_until(lambda: statuses([array for array in self.drive.diagnostics.messages if array.header.stamp > now],
                                               "monitor: Health"), "health")[0]

        def park(seconds, start):
            """@return the stamp of its end."""
            for begin in np.arange(start, start + seconds, STAY):
                self.drive.feed(0, round(STAY / PERIOD), begin, parked)
            return begin + STAY
        self.drive.feed(0, JUDGED_AFTER, START)
        driven = health()
        self.assertEqual(driven.level, DiagnosticStatus.OK, driven.message)
        stop = 300  # samples

        def slow_down(index, pair):
            """So slowly that the strut still moves as on a road."""
            share = (1.0 + math.cos(math.pi * (index - JUDGED_AFTER) / stop)) / 2.0
            for imu in pair:
                imu.linear_acceleration.z = GRAVITY + share * (imu.linear_acceleration.z - GRAVITY)
        self.drive.feed(JUDGED_AFTER, JUDGED_AFTER + stop, START, slow_down)
        end = park(OLDEST_DATA - STAY, START + (JUDGED_AFTER + stop) * PERIOD)
        held = health()
        self.assertEqual(held.level, DiagnosticStatus.OK, held.message)
        self.assertAlmostEqual(float(values(held)["estimate age [s]"]), OLDEST_DATA - STAY, delta=STAY)
        self.assertTrue(estimate.messages[-1].valid)
        park(2 * STAY, end)
        parked_for_long = health()
        self.assertEqual(parked_for_long.level, DiagnosticStatus.STALE)
        self.assertIn("cannot tell: parked: ", parked_for_long.message)
        self.assertFalse(estimate.messages[-1].valid)
        self.assertAlmostEqual(estimate.messages[-1].damping_to_mass, DAMPING_TO_MASS, delta=5 * LARGEST_ERROR[0])
        estimate.stop()

    def test_plots_use_the_receive_time(self):
        topics = {"la": type(None), "comparison": ModelComparison, "health": SuspensionHealth}
        collectors = [Collector(f"/monitor/{topic}", kind) for topic, kind in topics.items() if topic != "la"]
        for collector in collectors:
            collector.wait_for_publisher()
        self.drive.feed(0, 300, START)
        stamps = {imu.header.stamp for index in range(300) for imu in self.drive.pair(index, START)}
        for collector in [self.drive.estimates, *collectors]:
            wait_until(lambda: len(collector.messages) > 200, f"messages on {collector.topic}")
            self.assertTrue({message.header.stamp for message in collector.messages} <= stamps, collector.topic)
        for collector in collectors:
            collector.stop()

    def test_gravity_sign_ned_enu_covariance_minus_1(self):
        frames = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        frames.publish(TFMessage([pitch("tilted", "strut", math.radians(30.0)), pitch("ned", "strut", math.pi)]))
        with load_monitor("mounted", target_frame="strut"):
            mounted = drive_for("mounted")

            def as_mounted(index, pair):
                sprung, unsprung = pair
                for imu, frame, angle in ((sprung, "tilted", math.radians(30.0)), (unsprung, "ned", math.pi)):
                    up = imu.linear_acceleration.z  # in the frame of the strut; the IMU is turned against it
                    imu.header.frame_id = frame
                    imu.linear_acceleration.x = -math.sin(angle) * up
                    imu.linear_acceleration.z = math.cos(angle) * up
                if index == 100:
                    sprung.linear_acceleration_covariance[0] = -1.0  # none in this message
                if index == 150:
                    sprung.linear_acceleration_covariance[0] = 0.0  # unknown
            stamps = itertools.count(1.0, PERIOD)

            def accepts_readings():
                """Whether the latched transforms have come: readings before them are rejected."""
                stamp = next(stamps)
                pair = [make_imu(stamp, 0.0), make_imu(stamp, 0.0)]
                as_mounted(0, pair)
                for publisher, imu in zip(mounted.publishers, pair):
                    publisher.publish(imu)
                return any(int(values(status).get("samples", 0)) > 0
                           for status in statuses(mounted.diagnostics.messages, mounted.input_task))
            wait_until(accepts_readings, "the transforms of both IMUs")
            self.assertTrue(mounted.reset().success)
            mounted.estimates.messages.clear()
            mounted.feed(0, 2 * VALID_AFTER + 600, START, as_mounted)
            mounted.assert_estimate_is_good(self)
            status = mounted.input_status(lambda s: values(s).get("rejected not_measured") == "1")
            self.assertEqual(values(status)["rejected no_transform"], "0")
            mounted.stop()

    def test_mount_that_nobody_has_told(self):
        with load_monitor("lost", target_frame="strut_of_another_car"):
            lost = drive_for("lost")
            for index in range(50):
                for publisher, imu in zip(lost.publishers, lost.pair(index, START)):
                    imu.header.frame_id = "imu_link"
                    publisher.publish(imu)
            status = lost.input_status(lambda s: "no static transform from imu_link" in s.message)
            self.assertEqual(status.level, DiagnosticStatus.ERROR)
            lost.stop()

    def test_the_synchroniser_drops_everything_silently(self):
        before = len(self.drive.diagnostics.messages)
        for index in range(200):  # the other one is silent
            self.drive.publishers[MeasuredDrive.SPRUNG].publish(self.drive.pair(index, START)[MeasuredDrive.SPRUNG])
        self.drive.feed(300, 800, START)
        counted = self.counts(lambda v: v.get("samples") == "500", "the samples of both")
        self.assertEqual(int(counted["rejected missing_partner"]), 200)
        self.drive.input_status(lambda s: s.level == DiagnosticStatus.WARN and "missing_partner" in s.message,
                                after=before)
        self.drive.assert_estimate_is_good(self)


if __name__ == "__main__":
    rospy.init_node("good_citizen_test")
    rostest.rosrun(PACKAGE, "good_citizen", GoodCitizenTest)
