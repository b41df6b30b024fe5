"""What the tests of running nodes share: waiting for a condition, collecting messages, starting programs."""
import math
import os
import signal
import subprocess
import tempfile
import time

import roslib.packages
import rospkg
import rospy
import yaml

PACKAGE = "suspension_health_monitor"
REPOSITORY = rospkg.RosPack().get_path(PACKAGE)
POLL = 0.01  # [s]


def wait_until(predicate, timeout, what):
    """The first true value of predicate(); fails after timeout [s] of wall time, naming what was waited for."""
    deadline = time.monotonic() + timeout
    while True:
        value = predicate()
        if value:
            return value
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {timeout} s in vain for: {what}")
        time.sleep(POLL)


class Collector:
    """Every message of a topic since the subscription, with the wall time of its arrival."""

    def __init__(self, topic, message_type):
        self.topic = topic
        self.messages = []
        self.arrivals = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, queue_size=None, tcp_nodelay=True)

    def _take(self, message):
        self.arrivals.append(time.monotonic())
        self.messages.append(message)

    def stop(self):
        self._subscriber.unregister()

    def wait_for_publisher(self, timeout=10.0):
        wait_until(self._subscriber.get_num_connections, timeout, f"a publisher of {self.topic}")

    def wait_for(self, accepts, timeout, what):
        """The first message, of those that came and will come, that accepts(message)."""
        return wait_until(lambda: next(filter(accepts, list(self.messages)), None), timeout, f"{what} on {self.topic}")

    def by_stamp(self):
        """The messages by their stamp in nanoseconds."""
        return {message.header.stamp.to_nsec(): message for message in list(self.messages)}


class Program:
    """A running program; as a context it is stopped at the end."""

    def __init__(self, *command):
        self._output = tempfile.TemporaryFile(mode="w+")
        environment = dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1", PYTHONUNBUFFERED="1")
        self._process = subprocess.Popen(
            command, stdout=self._output, stderr=subprocess.STDOUT, text=True, env=environment)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def running(self):
        return self._process.poll() is None

    def wait_for_end(self, timeout):
        """The exit status."""
        try:
            return self._process.wait(timeout)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{self._process.args} still runs after {timeout} s:\n{self.output()}") from None

    def process_id(self):
        return self._process.pid

    def kill(self):
        """kill -9."""
        self._process.kill()
        self._process.wait()

    def stop(self):
        if self.running():
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(10.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def output(self):
        """What it has printed so far."""
        self._output.seek(0)
        return self._output.read()


def find_program(package, name):
    return roslib.packages.find_node(package, name)[0]


def run_tool(*arguments):
    """Runs suspension_bag to its end."""
    result = subprocess.run([find_program(PACKAGE, "suspension_bag"), *arguments], text=True, timeout=60.0,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != 0:
        raise AssertionError(f"suspension_bag {arguments} ended with {result.returncode}:\n{result.stdout}")


def start_node(program, name, parameters, **remappings):
    """Runs a node of this package under a name, with private parameters."""
    set_private_parameters(name, parameters)
    return Program(find_program(PACKAGE, program), f"__name:={name}", *remapping_arguments(remappings))


def load_nodelet(class_name, name, parameters, manager="manager", **remappings):
    """Loads a nodelet of this package into a manager, as a launch file does. Stopping the program unloads it; one that
    was refused ends by itself."""
    set_private_parameters(name, parameters)
    return Program(find_program("nodelet", "nodelet"), "load", f"{PACKAGE}/{class_name}", manager, f"__name:={name}",
                   *remapping_arguments(remappings))


def launch(file, **arguments):
    return Program("roslaunch", PACKAGE, file, *remapping_arguments(arguments))


def remapping_arguments(values):
    return [f"{name}:={value}" for name, value in values.items()]


def set_private_parameters(name, parameters):
    if rospy.has_param("/" + name):
        rospy.delete_param("/" + name)
    if parameters:
        rospy.set_param("/" + name, parameters)


def settings(file, **changes):
    """A file of config/, as parameters, with changes."""
    with open(os.path.join(REPOSITORY, "config", file), encoding="utf-8") as stream:
        return {**yaml.safe_load(stream), **changes}


def statuses(diagnostics, name):
    """The statuses, in order of arrival, of one task: `NODE: TASK`."""
    return [status for array in list(diagnostics.messages) for status in array.status if status.name == name]


def values(status):
    """What a status reports, by name."""
    return {value.key: value.value for value in status.values}


def is_finite(estimate):
    return math.isfinite(estimate.damping_to_mass) and math.isfinite(estimate.stiffness_to_mass)
