"""Faults of the body's IMU: simulate hides them, diagnose names them, with the axes that they need or without."""
import json

import pytest
import rosbag

DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03"]
SWAY = [*DRIVE, "--duration", "60", "--set", "body_acceleration=1", "--set", "body_rate=0.1"]


TILTED = "mount_tilt=0.06,c_y=-0.04"


def diagnose(program, tmp_path, simulate, *arguments):
    """@param simulate  nothing: the bag that is there."""
    bag, result = tmp_path / "drive.bag", tmp_path / "result.json"
    if simulate:
        program.succeed("simulate", *simulate, "-o", bag)
    return program.succeed("diagnose", bag, "--json", result, *arguments), json.loads(result.read_text())


@pytest.mark.parametrize("effect, coefficients", [
    ("clock_offset=0.006", {"clock_offset": 0.006}),
    (TILTED, {"mount_tilt/c_x": 0.06, "mount_tilt/c_y": -0.04}),
    ("lever_arm=-0.15,r_y=0.3", {"lever_arm/r_x": -0.15, "lever_arm/r_y": 0.3})])
def test_hidden_fault_is_named_with_its_size(program, tmp_path, effect, coefficients):
    model = tmp_path / "model.yaml"
    _, result = diagnose(program, tmp_path, [*SWAY, "--effect", effect], "-o", model)
    assert (result["verdict"], result["selected"]) == ("effect_found", [effect.split("=")[0]])
    assert result["extended"]["coefficients"] == pytest.approx(coefficients, rel=0.07)
    assert result["not_tried"] == {}
    _, again = diagnose(program, tmp_path, [], "--model", model)
    assert (again["verdict"], again["selected"]) == ("nothing_missing", [])


def test_upside_down_and_sideways_mounting_find_the_same_tilt(program, tmp_path):
    """The same drive as an IMU sees it whose x axis points down along the strut."""
    program.succeed("simulate", *SWAY, "--effect", TILTED, "-o", tmp_path / "level.bag")
    with rosbag.Bag(tmp_path / "turned.bag", "w") as turned:
        for topic, message, time in rosbag.Bag(tmp_path / "level.bag"):
            if topic == "/sprung/imu":
                for vector in (message.linear_acceleration, message.angular_velocity):
                    vector.x, vector.y, vector.z = -vector.z, vector.x, -vector.y
            turned.write(topic, message, time)
    result = tmp_path / "result.json"
    program.succeed("diagnose", tmp_path / "turned.bag", "--set", "sprung_axis=-x", "--json", result)
    found = json.loads(result.read_text())["extended"]["coefficients"]
    assert found == pytest.approx({"mount_tilt/c_x": 0.06, "mount_tilt/c_y": -0.04}, rel=0.07)


def test_what_the_imu_does_not_measure_is_not_tried(program, tmp_path):
    table, result = diagnose(program, tmp_path, DRIVE)
    assert set(result["not_tried"]) == {"mount_tilt", "lever_arm"}
    assert "not tried: mount_tilt, the body's IMU shows no changing acceleration" in table
    assert "not tried: lever_arm, the body's IMU shows no changing angular velocity" in table
    assert not any("lever_arm" in row["effects"] for row in result["ranking"])

    model = tmp_path / "model.yaml"
    model.write_text("damping_to_mass: 4\nstiffness_to_mass: 40\nreadings: {lever_arm: {r_x: 0.1, r_y: 0}}\n")
    program.refuse(3, ["diagnose", tmp_path / "drive.bag", "--model", model], ["lever_arm", "angular velocity"], tmp_path)


def test_messages_have_other_axes_only_when_asked(program, tmp_path):
    def body(*more):
        program.succeed("simulate", *DRIVE, "--duration", "5", *more, "-o", tmp_path / "short.bag")
        return [message for _, message, _ in rosbag.Bag(tmp_path / "short.bag").read_messages("/sprung/imu")]

    plain, swaying = body(), body("--set", "body_acceleration=1", "--set", "body_rate=0.1")
    for message, moved in zip(plain, swaying):
        assert message.linear_acceleration.z == moved.linear_acceleration.z
        assert message.linear_acceleration.x == message.linear_acceleration.y == message.angular_velocity.x == 0
        assert (message.angular_velocity_covariance[0], moved.angular_velocity_covariance[0]) == (-1, 0)
        assert 0 not in (moved.linear_acceleration.x, moved.linear_acceleration.y, moved.angular_velocity.x)


@pytest.mark.parametrize("effect, words", [
    ("mount_tilt=0.1", ["body_acceleration", "above 0"]), ("lever_arm=0.1", ["body_rate", "above 0"]),
    ("mount_tilt=0.1,c_z=1", ["readings/mount_tilt/c_z", "unknown", "c_x, c_y"]),
    ("clock_offset=late", ["readings/clock_offset", "late"])])
def test_faults_that_cannot_be_are_refused(program, tmp_path, effect, words):
    program.refuse(2, ["simulate", *DRIVE, "--effect", effect, "-o", tmp_path / "drive.bag"], words, tmp_path)
