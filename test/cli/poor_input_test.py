"""Readings that show no strut: the message names what is wrong with them."""
import copy
import json

import pytest
import rosbag

SPRUNG, UNSPRUNG = "/sprung/imu", "/unsprung/imu"


@pytest.fixture(scope="module")
def messages(program, tmp_path_factory):
    """[(topic, Imu, time)] of a healthy drive."""
    bag = tmp_path_factory.mktemp("healthy") / "drive.bag"
    program.succeed("simulate", "--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--duration", "40",
                    "--set", "start_time=1000", "-o", bag)
    return [entry for entry in rosbag.Bag(str(bag)).read_messages([SPRUNG, UNSPRUNG])]


def scale(factor, *topics):
    def change(topic, message, _):
        if topic in topics:
            message.linear_acceleration.z *= factor
    return change


def constant(value, *topics):
    def change(topic, message, _):
        if topic in topics:
            message.linear_acceleration.z = value
    return change


def in_tiny_unit(topic, message, _):  # squares vanish
    message.linear_acceleration.z *= 1e-160


def not_measured(topic, message, _):
    if topic == SPRUNG:
        message.linear_acceleration_covariance = [-1] + [0] * 8


def spikes(topic, message, index):
    if topic == SPRUNG and index % 700 == 0:
        message.linear_acceleration.z = 200


def clip(topic, message, _):
    if topic == SPRUNG:
        message.linear_acceleration.z = max(9.41, min(10.21, message.linear_acceleration.z))


def nothing(topic, message, _):
    pass


def write(path, messages, change, swap=False):
    with rosbag.Bag(str(path), "w") as bag:
        for index, (topic, message, time) in enumerate(messages):
            message = copy.deepcopy(message)
            change(topic, message, index)
            if swap:
                topic = {SPRUNG: UNSPRUNG, UNSPRUNG: SPRUNG}[topic]
            bag.write(topic, message, time)
    return path


POOR = {
    "no number": (constant(float("nan"), SPRUNG), [], "usable samples in all: 0", "not_finite: 4001"),
    "not measured": (not_measured, [], "usable samples in all: 0", "not_measured: 4001"),
    "body stuck": (constant(9.81, SPRUNG), [], "no regression row", "stuck: "),
    "body dead": (constant(0.0, SPRUNG), [], "no regression row", "stuck: "),
    "wheel stuck": (constant(9.81, UNSPRUNG), [], "no regression row", "stuck: "),
    "range too small": (nothing, ["sprung_range=5"], "clipped: "),
    "body upside down": (scale(-1, SPRUNG), [], "no estimate; gravity of the sprung IMU", "give sprung_axis: -z"),
    "wheel upside down": (scale(-1, UNSPRUNG), [], "no estimate; gravity of the unsprung IMU", "give unsprung_axis: -z"),
    "body upside down, horizon given": (scale(-1, SPRUNG), ["integration_horizon=0.6"], "give sprung_axis: -z"),
    "wheel in g": (scale(1 / 9.81, UNSPRUNG), ["integration_horizon=0.6"], "the unsprung IMU", "in g"),
    "hardly any reading": (in_tiny_unit, [], "the sprung readings differ by ", "m/s^2 only"),
    "hardly any reading, horizon given": (in_tiny_unit, ["integration_horizon=0.26"], "m/s^2 only"),
    "spikes": (spikes, ["integration_horizon=0.6"], "190 m/s^2 off the mean", "sprung_range"),
}


@pytest.mark.parametrize("change, settings, words", [(change, settings, words) for change, settings, *words
                                                     in POOR.values()], ids=POOR.keys())
def test_message_names_what_is_wrong(program, messages, tmp_path, change, settings, words):
    bag = write(tmp_path / "drive.bag", messages, change)
    result = program("identify", bag, *[word for setting in settings for word in ("--set", setting)])
    assert result.returncode == 4
    for word in words:
        assert word in result.stderr
    assert "nan" not in result.stdout + result.stderr


def test_a_period_that_is_too_long_is_told_and_costs_half_of_the_readings_only(program, messages, tmp_path):
    """LS and LA see every second one; the blocks take each by its stamp."""
    bag = write(tmp_path / "drive.bag", messages, nothing)
    result = program("identify", bag, "--set", "sample_period=0.02", "--json", tmp_path / "result.json")
    assert result.returncode == 0 and "too_soon: " in result.stdout
    estimate = json.loads((tmp_path / "result.json").read_text())["estimate"]
    assert estimate["damping_to_mass"] == pytest.approx(4.0, abs=4.0 * estimate["damping_to_mass_stddev"])
    assert estimate["stiffness_to_mass"] == pytest.approx(40.0, abs=4.0 * estimate["stiffness_to_mass_stddev"])


@pytest.mark.parametrize("settings", [[], ["--set", "integration_horizon=0.6"]], ids=["proposed", "given"])
def test_swapped_sensors_are_suspected(program, messages, tmp_path, settings):
    result = program("identify", write(tmp_path / "drive.bag", messages, nothing, swap=True), *settings)
    assert result.returncode == 4
    assert "swapped" in result.stderr


def test_heavy_clipping_is_told_and_ends_not_valid(program, messages, tmp_path):
    result = program("identify", write(tmp_path / "drive.bag", messages, clip), "--set", "integration_horizon=0.26")
    found = int(result.stdout.split("rejected clipped: ")[1].split()[0].rstrip(";"))
    body = [message.linear_acceleration.z for topic, message, _ in messages if topic == SPRUNG]
    at_limit = sum(abs(reading - 9.81) >= 0.4 for reading in body)
    assert 0.9 * at_limit < found <= at_limit
    assert result.stdout.count("NOT VALID") == 3


def test_healthy_readings_are_not_suspected(program, messages, tmp_path):
    program.succeed("identify", write(tmp_path / "drive.bag", messages, nothing))
