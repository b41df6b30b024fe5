#!/usr/bin/env python3
"""What /diagnostics says of the input: how often, and when a sensor is silent or the settings do not fit."""
import itertools
import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from measured_drive import JUDGED_AFTER, PERIOD, STIFFNESS_TO_MASS, MeasuredDrive, make_imu
from ros_session import PACKAGE, Collector, load_nodelet, statuses, values, wait_until
from suspension_health_monitor.msg import ParameterEstimate

START = 1000.0  # [s]
SHORT_TIMEOUT = {"sample_period": PERIOD, "input_timeout": 0.3}


def load_monitor(name, parameters):
    """A monitor that reads NAME/sprung and NAME/unsprung."""
    return load_nodelet("MonitorNodelet", name, {"input_timeout": 3600.0, **parameters},
                        **{"sprung/imu": f"/{name}/sprung", "unsprung/imu": f"/{name}/unsprung"})


def drive_for(name):
    return MeasuredDrive(name, f"/{name}/sprung", f"/{name}/unsprung")


def publish(drive, samples, change):
    """Readings that no estimate follows, change(index, imu) made to each."""
    for index in range(samples):
        for publisher, imu in zip(drive.publishers, drive.pair(index, START)):
            change(index, imu)
            publisher.publish(imu)


class InputDiagnosticsTest(unittest.TestCase):
    def test_diagnostics_come_once_a_second_whatever_the_sensor_rate(self):
        drive = MeasuredDrive()
        drive.feed(0, JUDGED_AFTER, START)  # a change of level would be told at once
        before = len(drive.diagnostics.messages)
        for index in range(JUDGED_AFTER, len(drive.readings)):
            drive.feed(index, index + 1, START)
        wait_until(lambda: len(drive.diagnostics.messages) > before + 2, "statuses after it")
        stamps = [array.header.stamp.to_sec() for array in drive.diagnostics.messages[before:]
                  if statuses([array], drive.input_task)]
        self.assertLessEqual(len(stamps), stamps[-1] - stamps[0] + 2)
        status = drive.input_status(lambda _: True, after=before)
        self.assertEqual((status.level, status.hardware_id), (DiagnosticStatus.OK, "monitor"))
        self.assertAlmostEqual(float(values(status)["rate [Hz]"]), 1.0 / PERIOD, delta=0.01)
        drive.stop()

    def test_silent_sensors_are_an_error(self):
        with load_monitor("silent", SHORT_TIMEOUT):
            drive = drive_for("silent")

            def is_error_that_says(text):
                return lambda status: status.level == DiagnosticStatus.ERROR and text in status.message
            drive.input_status(is_error_that_says("no message yet on /silent/sprung"))
            drive.input_status(is_error_that_says("no message yet on /silent/unsprung"))
            drive.feed(0, 200, START)
            before = len(drive.diagnostics.messages)
            drive.input_status(is_error_that_says("no message on /silent/sprung for"), after=before)
            drive.input_status(is_error_that_says("no message on /silent/unsprung for"), after=before)
            drive.stop()

    def test_one_silent_sensor_is_named(self):
        with load_monitor("half", SHORT_TIMEOUT):
            drive = drive_for("half")
            drive.feed(0, 200, START)
            before = len(drive.diagnostics.messages)
            stamps = itertools.count(START + 200 * PERIOD, PERIOD)

            def status_while_sprung_goes_on(task, words):
                drive.publishers[MeasuredDrive.SPRUNG].publish(make_imu(next(stamps), 0.0))
                return next((status for status in statuses(drive.diagnostics.messages[before:], task)
                             if words in status.message and "/half/sprung" not in status.message), None)
            status = wait_until(lambda: status_while_sprung_goes_on(drive.input_task, "no message on"),
                                "an error for the silent sensor")
            self.assertEqual(status.level, DiagnosticStatus.ERROR)
            self.assertIn("no message on /half/unsprung for", status.message)
            status = wait_until(lambda: status_while_sprung_goes_on("half: Health", ", /half/unsprung is silent; before: "),
                                "the health that names the silent sensor")
            self.assertEqual(status.level, DiagnosticStatus.STALE)
            drive.stop()

    def test_stamps_that_do_not_fit_the_sample_period_are_named(self):
        """LS and LA go by sample_period; health goes by the estimate, which goes by the stamps."""
        with load_monitor("mistimed", {"sample_period": 1.1 * PERIOD}):
            estimate = Collector("/mistimed/estimate", ParameterEstimate)
            estimate.wait_for_publisher()
            drive = drive_for("mistimed")
            drive.feed(0, JUDGED_AFTER, START)
            before = len(drive.diagnostics.messages)
            status = drive.input_status(lambda s: "stamps do not fit sample_period" in s.message, after=before)
            self.assertEqual(status.level, DiagnosticStatus.WARN)
            self.assertFalse(any(la.valid for la in drive.estimates.messages))
            self.assertIn("stamps do not fit sample_period", drive.estimates.messages[-1].reason)
            last = estimate.messages[-1]
            self.assertTrue(last.valid, last.reason)
            self.assertAlmostEqual(last.stiffness_to_mass, STIFFNESS_TO_MASS, delta=3.0 * last.stiffness_to_mass_stddev)
            health = statuses(drive.diagnostics.messages, "mistimed: Health")[-1]
            self.assertEqual(health.level, DiagnosticStatus.OK, health.message)
            estimate.stop()
            drive.stop()

    def test_stamps_that_run_backwards_are_named(self):
        with load_monitor("backward", {}):  # it has to measure the sample period
            drive = drive_for("backward")
            publish(drive, 200, lambda index, imu: setattr(imu.header, "stamp", rospy.Time(START - index * PERIOD)))
            counted = {"rejected time_went_back": str(2 * 199)}
            status = drive.input_status(lambda s: counted.items() <= values(s).items())
            self.assertEqual(status.level, DiagnosticStatus.WARN, status.message)
            drive.stop()

    def test_reasons_of_rejection_are_named_in_one_list(self):
        with load_monitor("two_reasons", {"sample_period": PERIOD}):
            drive = drive_for("two_reasons")

            def spoil(index, imu):
                if index % 2:
                    imu.linear_acceleration.z = float("nan")
                else:
                    imu.linear_acceleration_covariance[0] = -1.0
            publish(drive, 200, spoil)
            status = drive.input_status(lambda s: "readings rejected: not_measured, not_finite" in s.message)
            self.assertEqual(status.message.count("readings rejected"), 1)
            drive.stop()

    def test_stamps_ahead_of_the_clock_are_no_negative_lag(self):
        with load_monitor("ahead", {"sample_period": PERIOD}):
            drive = drive_for("ahead")
            drive.feed(0, 200, rospy.Time.now().to_sec() + 1000.0)
            found = values(drive.input_status(lambda s: values(s).get("samples") == "200"))
            for side in ("sprung", "unsprung"):
                self.assertEqual(found[f"{side} lag [s]"], "0.000")
                self.assertAlmostEqual(float(found[f"{side} ahead of the clock [s]"]), 1000.0, delta=500.0)
            drive.stop()

    def test_readings_that_come_too_seldom_for_the_sample_period_are_named(self):
        with load_monitor("seldom", {"sample_period": 0.1 * PERIOD}):
            drive = drive_for("seldom")
            publish(drive, 200, lambda index, imu: None)
            status = drive.input_status(lambda s: "readings come every 0.02 s (50 Hz)" in s.message)
            self.assertEqual(status.level, DiagnosticStatus.WARN)
            self.assertIn("sample_period = 0.002 [s]", status.message)
            drive.stop()

    def test_readings_that_were_never_usable_do_not_become_good_when_they_end(self):
        with load_monitor("useless", {"sample_period": PERIOD}):
            drive = drive_for("useless")
            publish(drive, 200, lambda _, imu: setattr(imu.linear_acceleration, "z", float("nan")))
            drive.input_status(lambda s: values(s).get("rejected not_finite") == "400")
            after = len(drive.diagnostics.messages)
            status = drive.input_status(lambda s: "readings rejected" not in s.message, after=after)
            self.assertEqual((status.level, status.message), (DiagnosticStatus.WARN, "no usable pair of readings yet"))
            drive.stop()

    def test_a_wrong_axis_is_named(self):
        with load_monitor("sideways", {"sample_period": PERIOD, "unsprung_axis": "y"}):
            drive = drive_for("sideways")
            publish(drive, 1200, lambda index, imu: setattr(imu.linear_acceleration, "y", 0.1 * math.sin(index)))
            status = drive.input_status(lambda s: "is on another axis" in s.message)
            self.assertEqual(status.level, DiagnosticStatus.WARN)
            self.assertIn("gravity of the unsprung IMU is on another axis: give unsprung_axis: z", status.message)
            drive.stop()

    def test_horizon_too_short_for_the_measured_period_is_an_error_until_reset(self):
        with load_monitor("coarse", {"integration_horizon": 0.009}):  # less than half a sample
            drive = drive_for("coarse")
            publish(drive, 100, lambda index, imu: None)
            status = drive.input_status(lambda s: "must be at least 1" in s.message)
            self.assertEqual(status.level, DiagnosticStatus.ERROR)
            self.assertIn("stopped listening until reset", status.message)
            self.assertNotIn("no message", status.message)
            self.assertTrue(drive.reset().success)
            for publisher in drive.publishers:
                wait_until(publisher.get_num_connections, f"the monitor back on {publisher.name}")
            drive.period = 0.01  # one sample
            drive.feed(0, 300, START)
            before = len(drive.diagnostics.messages)
            drive.input_status(lambda s: values(s).get("horizon_samples") == "1", after=before)
            drive.stop()


if __name__ == "__main__":
    rospy.init_node("input_diagnostics_test")
    rostest.rosrun(PACKAGE, "input_diagnostics", InputDiagnosticsTest)
