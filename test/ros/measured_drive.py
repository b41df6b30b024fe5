"""A recorded drive, published as two IMUs: 40 s of the paper's road at 50 Hz, b1 = 3 1/s, b0 = 13.8 1/s^2."""
import csv
import os

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from ros_session import REPOSITORY, UNLIMITED, Collector, is_finite, wait_until
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger
from suspension_health_monitor.msg import ParameterEstimate

FILE = os.path.join(REPOSITORY, "test", "core", "data", "input_paper.csv")
PERIOD = 0.02  # [s]
GRAVITY = 9.81  # [m/s^2]
DAMPING_TO_MASS, STIFFNESS_TO_MASS = 3.0, 13.8
LARGEST_ERROR = (0.16, 0.28)  # of LA over 20 drives without a fault
FILLING = 60  # samples before the first regression row: two horizons of 30
BLOCKS = 200  # samples of the first three blocks of 2 s, which overlap by half
VALID_AFTER = BLOCKS + 2  # samples after which the estimates are marked valid
EVERY = 100  # samples between two estimates by blocks of 4 s, which the bounce of 0.6 Hz asks for once it is known
JUDGED_AFTER = BLOCKS + 6 * EVERY + 50  # samples after which a level is confirmed: three such blocks, and the next estimates
BATCH = 100  # samples on their way at once; fewer than any queue holds


def read_drive():
    """[(sprung, unsprung acceleration)] by sample, before the losses of readings begin at 25 s."""
    with open(FILE, encoding="utf-8", newline="") as stream:
        return [(float(line["sprung_acceleration"]), float(line["unsprung_acceleration"]))
                for line in csv.DictReader(stream)][:1200]


def make_imu(stamp, acceleration):
    imu = Imu()
    imu.header.stamp = rospy.Time.from_sec(round(stamp, 6))
    imu.linear_acceleration.z = acceleration + GRAVITY
    return imu


class MeasuredDrive:
    """Publishes the drive, in the two topics that the monitor reads, and collects what the monitor says."""

    SPRUNG, UNSPRUNG = 0, 1

    def __init__(self, monitor="monitor", sprung="/sprung/imu", unsprung="/unsprung/imu"):
        self.readings = read_drive()
        self.period = PERIOD
        self.estimates = Collector(f"/{monitor}/la", ParameterEstimate)
        self.diagnostics = Collector("/diagnostics", DiagnosticArray)
        self.input_task = f"{monitor}: Input"
        self.publishers = [rospy.Publisher(topic, Imu, queue_size=UNLIMITED, tcp_nodelay=True)
                           for topic in (sprung, unsprung)]
        self.topics = (sprung, unsprung)
        self.reset = rospy.ServiceProxy(f"/{monitor}/reset", Trigger)
        for publisher in self.publishers:
            wait_until(publisher.get_num_connections, f"a subscriber of {publisher.name}")
        self.estimates.wait_for_publisher()
        self.diagnostics.wait_for_publisher()

    def stop(self):
        self.estimates.stop()
        self.diagnostics.stop()
        for publisher in self.publishers:
            publisher.unregister()

    def pair(self, index, start):
        return [make_imu(start + index * self.period, acceleration) for acceleration in self.readings[index]]

    def feed(self, first, last, start, change=lambda index, pair: None):
        """Publishes samples first .. last - 1, stamped from `start` [s] on, and waits until the monitor has them.

        change(index, pair): alters the pair of messages of a sample, or sets one to None: lost. Not of a batch's last.
        """
        for begin in range(first, last, BATCH):
            end = min(begin + BATCH, last)
            for index in range(begin, end):
                pair = self.pair(index, start)
                change(index, pair)
                for publisher, imu in zip(self.publishers, pair):
                    if imu is not None:
                        publisher.publish(imu)
            wanted = make_imu(start + (end - 1) * self.period, 0.0).header.stamp
            wait_until(lambda: self.estimates.messages and self.estimates.messages[-1].header.stamp == wanted,
                       f"the estimate of sample {end - 1}")

    def input_status(self, accepts, what="a status of the input", after=0):
        """The first status of the input, of the messages from number `after` on, that accepts(status)."""
        def find():
            for array in self.diagnostics.messages[after:]:
                for status in array.status:
                    if status.name == self.input_task and accepts(status):
                        return status
            return None
        return wait_until(find, what)

    def assert_estimate_is_good(self, test):
        last = self.estimates.messages[-1]
        test.assertTrue(last.valid)
        test.assertAlmostEqual(last.damping_to_mass, DAMPING_TO_MASS, delta=LARGEST_ERROR[0])
        test.assertAlmostEqual(last.stiffness_to_mass, STIFFNESS_TO_MASS, delta=LARGEST_ERROR[1])
        first = next(i for i, estimate in enumerate(self.estimates.messages) if is_finite(estimate))
        test.assertTrue(all(map(is_finite, self.estimates.messages[first:])), "no NaN once there are estimates")
