#!/usr/bin/env python3
"""Each kind of faulty reading is counted under its name and does the estimates no harm."""
import re
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from measured_drive import FILLING, PERIOD, MeasuredDrive
from ros_session import PACKAGE, values

START = 1000.0  # [s] stamp of the first sample
FAULT = 450  # its sample; the estimates are valid by then
END = 1000
COUNTERS = ("rejected not_measured", "rejected not_finite", "rejected zero_stamp", "rejected repeated_stamp",
            "rejected time_went_back", "rejected missing_partner", "rejected too_soon", "gaps", "clock jumps")


def lose(indices, *sides):
    """A change of MeasuredDrive.feed: messages that never arrive."""
    def change(index, pair):
        if index in indices:
            for side in sides:
                pair[side] = None
    return change


class FaultyInputTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = MeasuredDrive()

    def setUp(self):
        self.assertTrue(self.drive.reset().success)
        self.drive.estimates.messages.clear()
        self.before = len(self.drive.diagnostics.messages)

    def assert_counted(self, samples, **counts):
        """All counters at the end, those not named at 0, the estimates good; the fault has been warned of."""
        self.drive.assert_estimate_is_good(self)
        expected = {name: counts.get(name.replace("rejected ", "").replace(" ", "_"), 0) for name in COUNTERS}
        status = self.drive.input_status(lambda status: values(status).get("samples") == str(samples),
                                         what=f"{samples} samples", after=self.before)
        self.assertEqual({name: int(values(status)[name]) for name in COUNTERS}, expected)
        for name in counts:
            text = "gap in the input" if name in ("gaps", "clock_jumps") else rf"readings rejected: [a-z_, ]*\b{name}\b"
            self.drive.input_status(lambda s: s.level == DiagnosticStatus.WARN and re.search(text, s.message),
                                    what=f"a warning of {name}", after=self.before)

    def test_no_fault(self):
        self.drive.feed(0, END, START)
        self.assert_counted(END)

    def test_not_a_number_and_infinity(self):
        def change(index, pair):
            if index == FAULT:
                pair[MeasuredDrive.SPRUNG].linear_acceleration.z = float("nan")
            if index == FAULT + 5:
                pair[MeasuredDrive.UNSPRUNG].linear_acceleration.z = float("-inf")
        self.drive.feed(0, END, START, change)
        self.assert_counted(END - 2, not_finite=2, missing_partner=2, gaps=2)

    def test_missing_partner(self):
        self.drive.feed(0, END, START, lose(range(FAULT, FAULT + 10), MeasuredDrive.UNSPRUNG))
        self.assert_counted(END - 10, missing_partner=10, gaps=1)

    def test_gap_of_both_sensors_empties_the_filter(self):
        lost = range(FAULT, FAULT + 40)
        self.drive.feed(0, END, START, lose(lost, MeasuredDrive.SPRUNG, MeasuredDrive.UNSPRUNG))
        self.assert_counted(END - len(lost), gaps=1)
        after = [estimate for estimate in self.drive.estimates.messages
                 if estimate.header.stamp.to_sec() > START + (lost[-1] + 0.5) * PERIOD]
        self.assertFalse(any(estimate.valid for estimate in after[:FILLING]))
        held = {(estimate.damping_to_mass, estimate.stiffness_to_mass) for estimate in after[:FILLING]}
        self.assertEqual(len(held), 1, "estimates hold while the filter fills")
        self.assertTrue(after[FILLING].valid)

    def test_acceleration_marked_as_not_measured(self):
        def change(index, pair):
            if index == FAULT:
                for imu in pair:
                    imu.linear_acceleration_covariance = [-1.0] + 8 * [0.0]
        self.drive.feed(0, END, START, change)
        self.assert_counted(END - 1, not_measured=2, gaps=1)

    def test_overtaken_message(self):
        def change(index, pair):
            if index == FAULT:
                pair[MeasuredDrive.SPRUNG].header.stamp -= rospy.Duration(5 * PERIOD)
        self.drive.feed(0, END, START, change)
        self.assert_counted(END - 1, time_went_back=1, missing_partner=1, gaps=1)

    def test_repeated_and_missing_stamps(self):
        def change(index, pair):
            if index == FAULT:
                pair[MeasuredDrive.SPRUNG].header.stamp -= rospy.Duration(PERIOD)
            if index == FAULT + 10:
                pair[MeasuredDrive.UNSPRUNG].header.stamp = rospy.Time(0)
        self.drive.feed(0, END, START, change)
        self.assert_counted(END - 2, repeated_stamp=1, zero_stamp=1, missing_partner=2, gaps=2)

    def test_clock_that_jumps_back_begins_a_new_series(self):
        self.drive.feed(0, FAULT, START)
        self.drive.feed(FAULT, END, START - 500.0)
        self.assert_counted(END, time_went_back=1, clock_jumps=1)

    def test_reset_starts_anew(self):
        self.drive.feed(0, FAULT, START, lose([FAULT - 200], MeasuredDrive.SPRUNG))
        self.assert_counted(FAULT - 1, missing_partner=1, gaps=1)
        self.setUp()
        self.drive.feed(0, FILLING, START)
        self.assertFalse(any(estimate.valid for estimate in self.drive.estimates.messages))
        self.assertTrue(all(estimate.effective_rows == 0.0 for estimate in self.drive.estimates.messages))
        self.drive.feed(FILLING, FAULT, START)
        self.assert_counted(FAULT)


if __name__ == "__main__":
    rospy.init_node("faulty_input_test")
    rostest.rosrun(PACKAGE, "faulty_input", FaultyInputTest)
