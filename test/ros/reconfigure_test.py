#!/usr/bin/env python3
"""What rqt_reconfigure does: settings turned while the estimates go on."""
import re
import subprocess
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import ConfigDescription
from measured_drive import EVERY, JUDGED_AFTER, MeasuredDrive, PERIOD
from ros_session import PACKAGE, PATIENCE, Collector, find_program, load_nodelet, wait_until
from rosgraph_msgs.msg import Log
from suspension_health_monitor.msg import SuspensionHealth

START = 1000.0  # [s]
# Not one of them is the default. b1 of the drive is 3 1/s: 25 % below nominal.
GIVEN = {"memory": 1.0, "publish_every": 1,
         "health": {"damping_warn": 0.2, "damping_error": 0.5, "stiffness_warn": 0.4, "stiffness_error": 2,
                    "confirm_time": 0.5, "payload_range": 0.3, "oldest_data": 90.0},
         "nominal": {"damping_to_mass": 4.0, "stiffness_to_mass": 13.8}}
AS_GIVEN = {"memory": 1.0, "publish_every": 1, "health/damping_warn": 0.2, "health/damping_error": 0.5,
            "health/stiffness_warn": 0.4, "health/stiffness_error": 2.0, "health/confirm_time": 0.5,
            "health/payload_range": 0.3, "health/oldest_data": 90.0}
# What is asked for, and what the warning must hold.
REFUSED = {
    "error below warn": ({"health/damping_error": 0.1}, ["health/damping_error = 0.1", "at least health/damping_warn"]),
    "warn above error": ({"health/stiffness_warn": 3.0}, ["health/stiffness_error", "at least health/stiffness_warn"]),
    "out of range": ({"memory": -1.0}, ["memory = -1", "must be in [0.0001, 1000000]"]),
    "too short": ({"memory": 0.1}, ["memory = 0.1 [s]", "must be at least 0.2 [s]"]),
    "not a number": ({"health/confirm_time": float("nan")}, ["health/confirm_time = nan", "must be in"]),
    "one wrong, one right": ({"publish_every": 0, "memory": 0.5}, ["publish_every = 0", "must be"]),
}


def options_by_name():
    """What `suspension_bag options` says, the table of all options."""
    output = subprocess.run([find_program(PACKAGE, "suspension_bag"), "options"], check=True, text=True, timeout=PATIENCE,
                            stdout=subprocess.PIPE).stdout
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in output.splitlines() if line.startswith("|")]
    return {row[0].strip("`"): row[1:] for row in rows}


class ReconfigureTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.program = load_nodelet("MonitorNodelet", "monitor", {"sample_period": PERIOD, **GIVEN})
        cls.rosout = Collector("/rosout", Log)
        cls.rosout.wait_for_publisher()
        cls.health = Collector("/monitor/health", SuspensionHealth)
        cls.drive = MeasuredDrive()
        cls.client = Client("/monitor", timeout=PATIENCE)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.drive.stop()
        cls.health.stop()
        cls.rosout.stop()
        cls.program.stop()

    def setUp(self):
        self.turn(**AS_GIVEN)
        self.drive.reset()
        self.drive.estimates.messages.clear()
        self.health.messages.clear()

    def turn(self, **changes):
        """@return all settings after the change."""
        return {name: value for name, value in self.client.update_configuration(changes).items() if name != "groups"}

    def now(self):
        return self.turn(**{})

    def level(self):
        """Of the newest sample that has an estimate."""
        newest = self.drive.estimates.messages[-1].header.stamp
        return self.health.wait_for(lambda health: health.header.stamp == newest, "the health of the newest sample").level

    def test_dynamic_reconfigure_overwrites_launch_parameters(self):
        topics = {"sprung/imu": "/fresh/sprung", "unsprung/imu": "/fresh/unsprung"}
        with load_nodelet("MonitorNodelet", "fresh", {"sample_period": PERIOD, **GIVEN}, **topics):
            client = Client("/fresh", timeout=PATIENCE)
            first = client.get_configuration(PATIENCE)
            self.assertEqual({name: first[name] for name in AS_GIVEN}, AS_GIVEN)
            self.assertEqual(rospy.get_param("/fresh/health"), GIVEN["health"])
            client.close()

    def test_a_change_jumps_no_other(self):
        for name, value in (("memory", 4.0), ("health/damping_error", 0.6), ("publish_every", 3)):
            before = self.now()
            self.assertEqual(self.turn(**{name: value}), {**before, name: value})
            self.assertEqual(rospy.get_param("/monitor/" + name), value)

    def test_impossible_settings_are_refused_by_the_old_ones_and_words(self):
        for request, words in REFUSED.values():
            before = self.now()
            self.assertEqual(self.turn(**request), before)
            self.rosout.wait_for(lambda log: log.level == Log.WARN and all(word in log.msg for word in words),
                                 f"a warning with {words}")
            self.assertTrue(all(rospy.get_param("/monitor/" + name) == before[name] for name in request))

    def description(self):
        """(message, smallest, largest, default), the last three by name."""
        message = rospy.wait_for_message("/monitor/parameter_descriptions", ConfigDescription, PATIENCE)
        by_name = ({number.name: number.value for number in [*config.ints, *config.doubles]}
                   for config in (message.min, message.max, message.dflt))
        return (message, *by_name)

    def test_defaults_and_texts_are_those_of_all_options_and_ranges_within_them(self):
        message, smallest, largest, default = self.description()
        table = options_by_name()
        self.assertEqual(set(smallest), set(AS_GIVEN))
        for parameter in [parameter for group in message.groups for parameter in group.parameters]:
            name, row = parameter.name, " ".join(table[parameter.name])
            low, high = map(float, re.search(r"\[(\S+), (\S+)\]", row).groups())
            self.assertTrue(low <= smallest[name] < largest[name] <= high, name)
            self.assertIn(f" {default[name]:.15g} ", f" {row} ".replace("|", " "))
            self.assertIn(parameter.description.split("] ", 1)[1], row)

    def test_sliders_can_be_used(self):
        """A hundredth of a slider is no more than the default, and what was given is on it."""
        _, smallest, largest, default = self.description()
        for name, value in AS_GIVEN.items():
            self.assertLessEqual((largest[name] - smallest[name]) / 100, default[name], name)
            self.assertTrue(smallest[name] <= value <= largest[name], name)
        self.assertEqual(largest["health/stiffness_error"], 2.0)  # as given, beyond the slider's usual end
        self.assertEqual(largest["health/damping_error"], 1.0)

    def test_settings_are_in_groups(self):
        message, *_ = self.description()
        groups = {group.name: [parameter.name for parameter in group.parameters] for group in message.groups}
        self.assertEqual(list(groups), ["Default", "estimation", "health", "output"])
        self.assertEqual([(group.id, group.parent) for group in message.groups], [(0, 0), (1, 0), (2, 0), (3, 0)])
        self.assertEqual((groups["Default"], groups["estimation"], groups["output"]), ([], ["memory"], ["publish_every"]))
        self.assertEqual(set(groups["health"]), {name for name in AS_GIVEN if name.startswith("health/")})
        table = options_by_name()
        self.assertEqual(set(groups["health"]), {name for name in table if name.startswith("health/")}, "all of them")

    def test_what_is_beyond_a_slider_can_be_set_all_the_same(self):
        self.assertEqual(self.turn(**{"health/confirm_time": 60.0})["health/confirm_time"], 60.0)

    def test_estimates_are_kept(self):
        self.drive.feed(0, 600, START)
        before = self.drive.estimates.messages[-1]
        self.assertTrue(before.valid)
        self.turn(**{"memory": 2.0, "health/damping_warn": 0.1})
        count = len(self.drive.estimates.messages)
        self.drive.feed(600, 700, START)
        for estimate in self.drive.estimates.messages[count:]:
            self.assertTrue(estimate.valid)
            self.assertGreaterEqual(estimate.effective_rows, 0.99 * before.effective_rows)
        first = self.drive.estimates.messages[count]
        self.assertAlmostEqual(first.damping_to_mass, before.damping_to_mass, delta=0.05)
        self.drive.assert_estimate_is_good(self)
        # The memory grows from 1/(1 - 0.98) towards 1/(1 - 0.99) rows, by 0.99^100 of the way in 100 rows.
        self.assertAlmostEqual(self.drive.estimates.messages[-1].effective_rows, 100.0 - 50.0 * 0.99**100, delta=1.0)

    def test_thresholds_and_confirmation_hold_at_once(self):
        self.drive.feed(0, JUDGED_AFTER, START)
        self.assertEqual(self.level(), SuspensionHealth.WARN)
        self.turn(**{"health/damping_error": 0.21})
        self.drive.feed(JUDGED_AFTER, JUDGED_AFTER + EVERY, START)
        self.assertEqual(self.level(), SuspensionHealth.ERROR)
        self.turn(**{"health/damping_error": 0.9, "health/damping_warn": 0.8})
        self.drive.feed(JUDGED_AFTER + EVERY, JUDGED_AFTER + 2 * EVERY, START)
        self.assertEqual(self.level(), SuspensionHealth.OK)

    def test_age_of_data_that_may_count_holds_at_once(self):
        """The blocks of an estimate reach seconds back."""
        self.drive.feed(0, JUDGED_AFTER, START)
        self.assertEqual(self.level(), SuspensionHealth.WARN)
        self.turn(**{"health/oldest_data": 1.0})
        self.drive.feed(JUDGED_AFTER, JUDGED_AFTER + EVERY, START)
        self.assertEqual(self.level(), SuspensionHealth.STALE)
        self.turn(**{"health/oldest_data": 30.0})
        self.drive.feed(JUDGED_AFTER + EVERY, JUDGED_AFTER + 2 * EVERY, START)
        self.assertEqual(self.level(), SuspensionHealth.WARN)

    def test_settings_outlive_a_reset(self):
        before = self.turn(**{"publish_every": 3})
        self.drive.reset()
        self.assertEqual(self.now(), before)
        self.drive.estimates.messages.clear()
        for pair in (self.drive.pair(index, START) for index in range(90)):
            for publisher, imu in zip(self.drive.publishers, pair):
                publisher.publish(imu)
        wait_until(lambda: len(self.drive.estimates.messages) == 30, "every third sample")
        indices = [round((estimate.header.stamp.to_sec() - START) / PERIOD) for estimate in self.drive.estimates.messages]
        self.assertEqual(set(b - a for a, b in zip(indices, indices[1:])), {3})


if __name__ == "__main__":
    rospy.init_node("reconfigure_test")
    rostest.rosrun(PACKAGE, "reconfigure", ReconfigureTest)
