#!/usr/bin/env python3
"""A drive that is recorded loses nothing: not what the simulator published, not what the monitor made of it."""
import contextlib
import csv
import math
import multiprocessing
import os
import tempfile
import unittest
from decimal import Decimal

import rospy
import rostest
from ros_session import PACKAGE, Collector, launch, read_bag, record_drive, run_tool, settings_file, wait_until
from suspension_health_monitor.msg import SimulationTruth

IMUS = SPRUNG, UNSPRUNG = ("/sprung/imu", "/unsprung/imu")
ESTIMATES = ("/monitor/ls", "/monitor/la", "/monitor/health")
COMPARISON, TRUTH = "/monitor/comparison", "/simulator/truth"
DURATION = 60  # [s] of a drive
DELAY = 12  # samples that the comparison is late, so the last ones have none
BUSY_LOOPS = 4
LONGEST = 600  # [s] of processor time, should the test be killed beside its busy loops


def work_for_nothing():
    while sum(os.times()[:2]) < LONGEST:
        pass


def stamps(messages):
    return [message.header.stamp.to_nsec() for message in messages]


@contextlib.contextmanager
def busy_machine():
    others = [multiprocessing.Process(target=work_for_nothing, daemon=True) for _ in range(BUSY_LOOPS)]
    for process in others:
        process.start()
    try:
        yield
    finally:
        for process in others:
            process.kill()
            process.join()


class RecordingTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def test_every_message_is_in_the_bag_whatever_the_pace(self):
        expected = [1, *range(20_000_000, DURATION * 10**9 + 1, 20_000_000)]  # [ns]; ROS knows no stamp 0
        for factor in (0, 500, 40):
            with busy_machine():
                drive = record_drive(self.folder.name, (*IMUS, *ESTIMATES, COMPARISON, TRUTH), scenario="paper_clean",
                                     real_time_factor=factor, duration=DURATION)
            for topic in (*IMUS, *ESTIMATES, TRUTH):
                self.assertEqual(stamps(drive[topic]), expected, f"{topic} at {factor}")
            self.assertEqual(stamps(drive[COMPARISON]), expected[:-DELAY], f"{COMPARISON} at {factor}")

    def test_estimates_are_those_of_the_recorded_readings(self):
        simulator, table = (os.path.join(self.folder.name, name) for name in ("simulator.yaml", "rows.csv"))
        with open(simulator, "w", encoding="utf-8") as stream:
            stream.write("{rate: 200.0, unsprung_rate: 333.0, sampling_jitter: 0.001, dropout: 0.02}")
        config = settings_file(self.folder.name, "monitor.yaml", sample_period=0.005, integration_horizon=0.3)
        drive = record_drive(self.folder.name, (*IMUS, "/monitor/la"), "simulation.launch", scenario="iso_road",
                             config=config, simulator_config=simulator, duration=60)
        run_tool("identify", os.path.join(self.folder.name, "drive.bag"), "--config", config, "--csv", table)
        live = {message.header.stamp.to_nsec(): message for message in drive["/monitor/la"]}
        with open(table, encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertGreater(len(rows), 10000)
        self.assertFalse(math.isnan(float(rows[-1]["la_damping_to_mass"])))
        for row in rows:
            estimate = live[int(Decimal(row["time"]) * 10**9)]
            for name in ("damping_to_mass", "stiffness_to_mass"):
                written, told = float(row[f"la_{name}"]), getattr(estimate, name)
                if math.isnan(written):  # before the first row
                    self.assertTrue(math.isnan(told))
                else:
                    self.assertAlmostEqual(told, written, delta=1e-9 * abs(written))

    def test_what_was_driven_until_an_interruption_is_kept(self):
        path = os.path.join(self.folder.name, "drive.bag")
        truth = Collector(TRUTH, SimulationTruth)
        with launch("simulation.launch", real_time_factor=10, duration=3600, record=path) as program:
            truth.wait_for(lambda message: message.header.stamp.to_sec() > 10.0, "some of the drive")
            program.stop()
        truth.stop()
        recorded = stamps(read_bag(path)[TRUTH])
        self.assertEqual(recorded, [1, *range(20_000_000, recorded[-1] + 1, 20_000_000)])
        self.assertGreater(recorded[-1], 10 * 10**9)
        self.assertEqual(os.listdir(self.folder.name), ["drive.bag"])

    def test_a_topic_that_cannot_be_recorded_is_named(self):
        path = os.path.join(self.folder.name, "drive.bag")
        with launch("simulation.launch", record=path, record_topics="/rosout") as program:
            wait_until(lambda: "record_topics: /rosout has the type" in program.output(), "an error that names the topic")
            wait_until(lambda: not os.listdir(self.folder.name), "no file left")

    def test_a_file_that_cannot_be_written_is_named(self):
        path = os.path.join(self.folder.name, "none", "drive.bag")
        with launch("simulation.launch", record=path) as program:
            wait_until(lambda: f"{path}: cannot be written" in program.output(), "an error that names the file")


if __name__ == "__main__":
    rospy.init_node("recording_test")
    rostest.rosrun(PACKAGE, "recording", RecordingTest)
