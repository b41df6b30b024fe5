"""IMUs that are turned against the strut, by the static transforms in the bag."""
import json
import math
import re

import genpy
import pytest
import rosbag
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

import imu_bag

PITCH = math.radians(5.0)
SETTINGS = ["--set", "sample_period=0.02", "--set", "integration_horizon=0.6", "--set", "target_frame=strut"]


@pytest.fixture(scope="module")
def level_bag(tmp_path_factory):
    """The paper's drive before readings are lost."""
    drive = tuple(column[:1200] for column in imu_bag.paper_drive())
    return imu_bag.write_bag(tmp_path_factory.mktemp("level") / "level.bag", drive)


def turned(frame, angle):
    """A frame that is turned against that of the strut by an angle [rad] about y."""
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = "strut", frame
    transform.transform.rotation.y, transform.transform.rotation.w = math.sin(angle / 2), math.cos(angle / 2)
    return transform


def write_turned(source, path, sprung_pitch, unsprung_pitch, frames=None, braking=2.0):
    """The messages of a bag as IMUs see them that are turned, of a body that brakes now and then."""
    angles = {imu_bag.SPRUNG: sprung_pitch, imu_bag.UNSPRUNG: unsprung_pitch}
    frames = frames if frames is not None else [turned(topic, angle) for topic, angle in angles.items()]
    with rosbag.Bag(str(source)) as bag, rosbag.Bag(str(path), "w") as out:
        first = genpy.Time(bag.get_start_time())
        if frames:
            out.write("/tf_static", TFMessage(frames), first)
        for topic, imu, time in bag.read_messages([imu_bag.SPRUNG, imu_bag.UNSPRUNG]):
            up, along = imu.linear_acceleration.z, braking * math.sin(0.7 * imu.header.stamp.to_sec())
            sine, cosine = math.sin(angles[topic]), math.cos(angles[topic])
            imu.linear_acceleration.x = cosine * along - sine * up
            imu.linear_acceleration.z = sine * along + cosine * up
            imu.header.frame_id = topic
            out.write(topic, imu, time)
    return path


def identify(program, folder, bag, *settings):
    program.succeed("identify", bag, *settings, "--json", folder / "result.json")
    result = json.loads((folder / "result.json").read_text())
    return [result[estimator][name] for estimator in ("ls", "la") for name in ("damping_to_mass", "stiffness_to_mass")]


def test_turned_imus_give_what_level_ones_give(program, level_bag, tmp_path):
    level = identify(program, tmp_path, level_bag, *SETTINGS[:4])
    bag = write_turned(level_bag, tmp_path / "turned.bag", PITCH, math.pi)  # the wheel's hangs upside down
    assert identify(program, tmp_path, bag, *SETTINGS) == pytest.approx(level, rel=1e-6)
    # Without the transforms, braking leaks in and the wheel's IMU has the wrong sign.
    wrong = program("identify", bag, *SETTINGS[:4])
    assert wrong.returncode == 4 or "NOT VALID" in wrong.stdout


def test_search_and_comparison_use_the_transforms_too(program, level_bag, tmp_path):
    bag = write_turned(level_bag, tmp_path / "turned.bag", PITCH, -PITCH)
    results = []
    for path, settings in ((level_bag, SETTINGS[:4]), (bag, SETTINGS)):
        program.succeed("compare", path, *settings, "--json", tmp_path / "compare.json")
        results.append(json.loads((tmp_path / "compare.json").read_text())["free_run"]["rmse"])
    assert results[1] == pytest.approx(results[0], rel=1e-6)


def test_page_judges_the_data_in_the_axes_of_the_target(program, tmp_path):
    program.succeed("simulate", "--scenario", "iso_road", "--rate", "100", "--duration", "30", "-o", tmp_path / "level.bag")
    bag = write_turned(tmp_path / "level.bag", tmp_path / "turned.bag", 6.0 * PITCH, -6.0 * PITCH)
    leans = []
    for settings in (["--set", "target_frame=strut"], []):
        program("health", bag, *settings, "--report", tmp_path / "page")
        text = (tmp_path / "page" / "report.html").read_text()
        findings = json.loads(re.search(r'id="findings">(.*?)</script>', text, re.DOTALL)[1])
        leans.append([(each["verdict"].startswith("it leans by 30 degrees"), each["lean"])
                      for each in findings["data"]["topics"]])
    for (leans_on_strut, on_strut), (leans_alone, alone) in zip(*leans):
        assert (leans_on_strut, leans_alone) == (False, True)
        assert on_strut == pytest.approx(0.0, abs=0.02) and alone == pytest.approx(6.0 * PITCH, abs=0.02)


def test_missing_transforms_are_named(program, level_bag, tmp_path):
    without = write_turned(level_bag, tmp_path / "without.bag", PITCH, PITCH, frames=[])
    program.refuse(3, ["identify", without, *SETTINGS], ["without.bag", "no topic /tf_static", "target_frame"], tmp_path)
    other = write_turned(level_bag, tmp_path / "other.bag", PITCH, PITCH, frames=[turned("imu_of_another_car", PITCH)])
    program.refuse(4, ["identify", other, *SETTINGS], ["no_transform"], tmp_path)


@pytest.mark.parametrize("command", ["identify", "diagnose", "health", "inspect"])
def test_a_mistyped_target_frame_is_named(program, level_bag, tmp_path, command):
    bag = write_turned(level_bag, tmp_path / "turned.bag", PITCH, -PITCH)
    program.refuse(2, [command, bag, "--set", "target_frame=strutt"],
                   ['target_frame = "strutt", must be a frame of /tf_static; the nearest known name is strut\n'], tmp_path)
    program.succeed("identify", bag, *SETTINGS[:4], "--set", "target_frame=/strut")


def test_a_wrong_axis_is_named(program, level_bag, tmp_path):
    bag = write_turned(level_bag, tmp_path / "turned.bag", PITCH, -PITCH)
    told = program("health", bag, *SETTINGS[:4], "--set", "unsprung_axis=x").stdout
    assert "gravity of /unsprung/imu is on another axis: give unsprung_axis: z" in told
    assert "cannot tell: gravity of the unsprung IMU is on another axis: give unsprung_axis: z" in told[told.index("at the end"):]


@pytest.mark.parametrize("command, words", [
    ("identify", "there is no estimate; gravity of the unsprung IMU is on another axis: give unsprung_axis: z"),
    ("diagnose", "gravity of /unsprung/imu is on another axis: give unsprung_axis: z; the drives "),
    ("compare", "gravity of /unsprung/imu is on another axis: give unsprung_axis: z; the drives ")])
def test_a_wrong_axis_is_the_reason_that_a_command_gives(program, level_bag, command, words):
    told = program(command, level_bag, "--set", "unsprung_axis=-z")
    assert told.returncode == 4 and words in told.stderr


def test_range_of_the_sensor_is_where_readings_are_clipped(program, level_bag, tmp_path):
    with rosbag.Bag(str(level_bag)) as bag:
        readings = sorted(imu.linear_acceleration.z for _, imu, _ in bag.read_messages(imu_bag.SPRUNG))
    settings = [*SETTINGS[:4], "--set", f"sprung_range={readings[-5] / 0.999:.12f}", "--set", "unsprung_range=100"]
    program.succeed("identify", level_bag, *settings, "--json", tmp_path / "result.json")
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["rejected"]["clipped"] in (4, 5)  # the one at the very limit is a matter of rounding
    assert result["rejected"]["missing_partner"] == result["rejected"]["clipped"]
