"""What the tests of running nodes share: waiting for a condition, collecting messages, starting programs."""
import collections
import contextlib
import math
import os
import signal
import subprocess
import tempfile
import threading
import time
import xmlrpc.client

import rosbag
import rosgraph
import roslib.packages
import rospkg
import rospy
import yaml
from std_srvs.srv import SetBool
from suspension_health_monitor.msg import ParameterEstimate

PACKAGE = "suspension_health_monitor"
REPOSITORY = rospkg.RosPack().get_path(PACKAGE)
POLL = 0.01  # [s]
PATIENCE = 300.0  # [s] of wall time until what was waited for counts as missing; no test passes faster or slower by it
UNLIMITED = 1000000  # messages in a queue: more than any drive here has


def wait_until(predicate, what):
    """The first true value of predicate(); fails when PATIENCE is over, naming what was waited for."""
    deadline = time.monotonic() + PATIENCE
    while True:
        value = predicate()
        if value:
            return value
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {PATIENCE} s in vain for: {what}")
        time.sleep(POLL)


def is_served_by_all(topic):
    """Whether the topic has publishers and each of them, asked itself, knows this node as a subscriber: then no message
    that it publishes from now on is missed. That this node knows of the connection would be too early."""
    master = rosgraph.Master(rospy.get_name())
    publishers = dict(master.getSystemState()[0]).get(topic, [])

    def serves(publisher):
        _, _, connections = xmlrpc.client.ServerProxy(master.lookupNode(publisher)).getBusInfo(rospy.get_name())
        return any((to, direction, name) == (rospy.get_name(), "o", topic) for _, to, direction, _, name, *_ in connections)
    try:
        return bool(publishers) and all(map(serves, publishers))
    except (OSError, rosgraph.MasterException):  # one of them has just ended
        return False


class Collector:
    """Every message of a topic since the subscription."""

    def __init__(self, topic, message_type):
        self.topic = topic
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, queue_size=None, tcp_nodelay=True)

    def _take(self, message):
        self.messages.append(message)

    def stop(self):
        self._subscriber.unregister()

    def wait_for_publisher(self):
        wait_until(lambda: is_served_by_all(self.topic), f"a publisher of {self.topic}")

    def wait_for(self, accepts, what):
        """The first message, of those that came and will come, that accepts(message)."""
        return wait_until(lambda: next(filter(accepts, list(self.messages)), None), f"{what} on {self.topic}")

    def by_stamp(self):
        """The messages by their stamp in nanoseconds."""
        return {message.header.stamp.to_nsec(): message for message in list(self.messages)}


class Pace:
    """Lets a simulator drive no faster than collectors of this test take in its messages and what is made of them: to be
    its topic `pace`. Messages are not lost between them then, however busy the machine."""

    def __init__(self, topic, *collectors):
        self._publisher = rospy.Publisher(topic, ParameterEstimate, queue_size=1, tcp_nodelay=True)
        self._collectors = collectors
        self._running = True
        self._held = False
        self._thread = threading.Thread(target=self._publish, daemon=True)
        self._thread.start()

    def _publish(self):
        while self._running:
            if not self._held and all(collector.messages for collector in self._collectors):
                estimate = ParameterEstimate()
                estimate.header.stamp = min(collector.messages[-1].header.stamp for collector in self._collectors)
                self._publisher.publish(estimate)
            time.sleep(POLL)

    @contextlib.contextmanager
    def held(self):
        """Stops the drive for a while, after the few samples that it may be ahead."""
        self._held = True
        yield
        self._held = False

    def stop(self):
        self._running = False
        self._thread.join()
        self._publisher.unregister()


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

    def wait_for_end(self):
        """The exit status."""
        try:
            return self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{self._process.args} still runs after {PATIENCE} s:\n{self.output()}") from None

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
            self._process.wait(PATIENCE)
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
    result = subprocess.run([find_program(PACKAGE, "suspension_bag"), *arguments], text=True, timeout=PATIENCE,
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


def read_bag(path):
    """{topic: messages in the order of time}"""
    messages = collections.defaultdict(list)
    with rosbag.Bag(path) as bag:
        for topic, message, _ in bag.read_messages():
            messages[topic].append(message)
    return messages


def record_drive(folder, topics, file="paper.launch", **arguments):
    """Launches a simulated drive, as fast as it goes, to its end. {topic: messages}, every one of them."""
    path = os.path.join(folder, "drive.bag")
    arguments = {"real_time_factor": 0, **arguments}
    with launch(file, record=path, record_topics=" ".join(topics), shutdown_at_end="true", **arguments) as program:
        status = program.wait_for_end()
        if status != 0 or not os.path.exists(path):
            raise AssertionError(f"{file} ended with {status}:\n{program.output()}")
    return read_bag(path)


@contextlib.contextmanager
def replayed(collectors, **arguments):
    """replay.launch as a Program, which begins to play when all the collectors have been connected."""
    with launch("replay.launch", paused="true", shutdown_at_end="true", **arguments) as program:
        wait_until(lambda: all(is_served_by_all(collector.topic) for collector in collectors) or not program.running(),
                   "the monitor and its topics")
        if not program.running():
            raise AssertionError(program.output())
        pause_replay(False)
        yield program


def pause_replay(paused):
    rospy.wait_for_service("/player/pause_playback", PATIENCE)
    answer = rospy.ServiceProxy("/player/pause_playback", SetBool)(paused)
    if not answer.success:
        raise AssertionError(answer.message)


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


def settings_file(folder, file, **changes):
    """The same as a file of its own in a folder; its path."""
    path = os.path.join(folder, file)
    with open(path, "w", encoding="utf-8") as stream:
        yaml.safe_dump(settings(file, **changes), stream)
    return path


def statuses(arrays, name):
    """The statuses of one task, `NODE: TASK`, in these messages of /diagnostics."""
    return [status for array in list(arrays) for status in array.status if status.name == name]


def values(status):
    """What a status reports, by name."""
    return {value.key: value.value for value in status.values}


def is_finite(estimate):
    return math.isfinite(estimate.damping_to_mass) and math.isfinite(estimate.stiffness_to_mass)
