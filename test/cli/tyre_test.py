"""With a third IMU on the road, identify finds wheel and tyre."""
import json

import pytest

DRIVE = ("--scenario", "iso_road", "--rate", "1000", "--duration", "15", "--set", "road_imu=true")
# The golden car: beta/m, K/m, K0/m and m/M.
TRUTH = {"damping_to_wheel_mass": 40.0, "stiffness_to_wheel_mass": 422.0, "tyre_to_wheel_mass": 4353.3,
         "mass_ratio": 0.15}
# Noise 0.024 m/s^2 against several m/s^2 of motion biases by far less; see tyre_tracker_test.cpp. b1, with the longer
# horizon, is good to 2 %.
TOLERANCE = {name: 0.02 if name == "mass_ratio" else 0.01 for name in TRUTH}


@pytest.fixture(scope="module")
def bag(program, tmp_path_factory):
    path = tmp_path_factory.mktemp("tyre") / "drive.bag"
    program.succeed("simulate", *DRIVE, "-o", path)
    return path


def test_tyre_is_identified_by_ls_and_la(program, bag, tmp_path):
    result = tmp_path / "result.json"
    printed = program.succeed("identify", bag, "--road-topic", "/road/imu", "--set", "forgetting_factor=1.0", "--json",
                              result)
    tyre = json.loads(result.read_text())["tyre"]
    for estimator in ("ls", "la"):
        assert tyre[estimator]["valid"]
        for name, truth in TRUTH.items():
            assert tyre[estimator][name] == pytest.approx(truth, rel=TOLERANCE[name]), (estimator, name)
    assert "tyre/wheel mass" in printed


def test_without_the_topic_there_is_no_tyre(program, bag, tmp_path):
    result = tmp_path / "result.json"
    assert "tyre" not in program.succeed("identify", bag, "--json", result)
    assert "tyre" not in json.loads(result.read_text())


def test_missing_topic_is_named(program, bag, tmp_path):
    program.refuse(3, ["identify", bag, "--road-topic", "/asphalt/imu"], ["/asphalt/imu", "--road-topic"], tmp_path)


def test_rigid_wheel_has_no_tyre_to_measure(program, tmp_path):
    program.refuse(2, ["simulate", "--set", "road_imu=true", "-o", tmp_path / "drive.bag"], ["road_imu", "rigid"],
                   tmp_path)
