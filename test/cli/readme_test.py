"""Every command of the README, as it stands there, from top to bottom in a bare folder, and what it says will happen.

scripts/demo is run by demo_page_test.py, but for installing and building; scripts/test is what runs all tests.
"""
import contextlib
import csv
import re

import numpy as np
import pytest
import rosbag

import imu_bag
from conftest import wait_until
from terminal import Terminal, commands_of, launch_and_look, require_no_error

README = (imu_bag.REPOSITORY / "README.md").read_text()
RUN_ELSEWHERE = ("scripts/", "source ")
EFFECT = "quadratic_damping"
# What the README's vehicle has that none of the shipped ones has: three struts, the rear one with an IMU of its own.
STRUT = "damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000"
TRICYCLE = f"""mass: 100
pitch_inertia: 20
roll_inertia: 10
speed: 3
iso_class: C
body_imu: {{x: 0, y: 0, z: 0}}
struts:
  front_left: {{x: 0.4, y: 0.3, z: 0.1, {STRUT}}}
  front_right: {{x: 0.4, y: -0.3, z: 0.1, {STRUT}}}
  rear: {{x: -0.4, y: 0, z: 0.1, {STRUT}}}
"""
# The reader's robots, which drive on until they are stopped, and whose clock runs 10 times faster.
DRIVING = "rosparam set use_sim_time true && exec rosrun suspension_health_monitor simulator_node _duration:=100000 " \
    "_real_time_factor:=10 _publish_clock:=true _rate:=100"
ROBOT = f"{DRIVING} _scenario:=iso_road _vehicle:=ugv '_hidden:={EFFECT}=1.6' sprung/imu:=/body/imu " \
    "unsprung/imu:=/front_left/imu"
VEHICLE = f"{DRIVING} _vehicle_model:=tricycle.yaml _sprung_imus:=rear rear/sprung/imu:=/rear/imu " + \
    " ".join(f"{strut}/unsprung/imu:=/wheel/{strut}/imu" for strut in ("front_left", "front_right", "rear"))


@pytest.fixture(scope="module")
def blocks():
    """Its blocks of commands, in order."""
    return [block for block in ([line for line in lines if not line.startswith(RUN_ELSEWHERE)]
                                for lines in commands_of(README)) if block]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Bare at the start; every command finds there what those before have left."""
    return tmp_path_factory.mktemp("bare")


@pytest.fixture
def terminal(folder, port):
    return Terminal(folder, port)


@contextlib.contextmanager
def driving(terminal, robot):
    """A robot with its master."""
    with terminal.start(f"exec roscore -p {terminal.port}", "roscore.txt"):
        terminal.wait_for_master()
        with terminal.start(robot, "robot.txt"):
            yield


def record(terminal, command):
    """Records until nothing is missing for half a second. These robots' clock is faster than real time, so a recorder that
    waits for a busy machine loses messages."""
    path = terminal.folder / re.search(r"-O (\S+)", command)[1]

    def is_whole():
        terminal.run(command)
        stamps = {}
        with rosbag.Bag(str(path)) as bag:
            for topic, message, _ in bag.read_messages():
                stamps.setdefault(topic, []).append(message.header.stamp.to_sec())
        return stamps and all(np.diff(sorted(times)).max() < 0.5 for times in stamps.values())

    wait_until(is_whole, command)


def run_offline(terminal, commands):
    """commands: of a block; the first records the drive for the others."""
    record(terminal, commands[0])
    for command in commands[1:]:
        terminal.run(command)


def test_every_block_has_its_test(blocks):
    programs = [block[-1].split()[0] for block in blocks]
    assert programs == ["rqt_plot", "roslaunch", "roslaunch", "rostopic", "rosservice"]


def test_the_picture_live(terminal, blocks):
    paper, plot = blocks[0]
    launch_and_look(terminal, paper, plot.split()[1:])


def test_own_robot(terminal, blocks):
    *offline, monitor = blocks[1]
    with driving(terminal, ROBOT):
        run_offline(terminal, offline)
        launch_and_look(terminal, monitor, ["/monitor/estimate/valid"])


def test_own_vehicle(terminal, blocks):
    *offline, monitor = blocks[2]
    text = re.search(r"```yaml\n(# my_vehicle.yaml\n.*?)```", README, re.DOTALL)[1]
    (terminal.folder / "my_vehicle.yaml").write_text(text)
    (terminal.folder / "tricycle.yaml").write_text(TRICYCLE)
    with driving(terminal, VEHICLE):
        run_offline(terminal, offline)
        launch_and_look(terminal, monitor, ["/rear/estimate/valid"])
    assert (terminal.folder / "found" / "report.html").exists()


def test_five_commands(terminal, blocks):
    simulate, compare, diagnose, replay, watch = blocks[3]
    assert f"--effect {EFFECT}=" in simulate
    terminal.run(simulate)
    terminal.run(compare)
    assert f"Missing from the model: {EFFECT}." in terminal.run(diagnose)
    assert f"  {EFFECT}:\n" in (terminal.folder / "simulated.yaml").read_text()
    with terminal.start(replay, "replay.txt") as replaying:
        terminal.wait_for_master()
        with terminal.start(watch, "comparison.csv"):
            terminal.wait_for_words("replay.txt", "worst level", replaying)
    told = (terminal.folder / "replay.txt").read_text()
    require_no_error(told)
    assert re.search(r"/monitor: driven for 1[12]\d\.\d s until the clock stopped, worst level OK \(OK .* s", told)
    assert re.search(r"/monitor: estimate: damping/mass \S+ \+- \S+ 1/s, stiffness/mass \S+ \+- \S+ 1/s\^2", told)
    rows = list(csv.DictReader(line for line in (terminal.folder / "comparison.csv").read_text().splitlines()
                               if re.match(r"%time|\d", line)))
    assert len(rows) > 1000
    last = {name: float(rows[-1][f"field.{name}"]) for name in ("rmse", "base_rmse", "fit_percent", "base_fit_percent")}
    assert last["rmse"] < 0.7 * last["base_rmse"]
    assert last["fit_percent"] > last["base_fit_percent"]


def test_on_the_robot(terminal, blocks):
    """The service calls run beside a running monitor. A call that answers "drive on" is repeated."""
    with driving(terminal, ROBOT), terminal.start(blocks[1][-1], "on_the_robot.txt"):
        terminal.run("timeout 120 rostopic echo -n 1 /monitor/estimate")
        for command in blocks[4]:
            wait_until(lambda said=command: "success: True" in terminal.run(said), command, every=0.5)
    assert f"  {EFFECT}:\n" in (terminal.folder / "model.yaml").read_text()
    assert "damping_to_mass: " in (terminal.folder / "healthy.yaml").read_text()
