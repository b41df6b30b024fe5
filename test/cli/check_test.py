"""`suspension_bag check`: is the data any good, and which IMU is which."""
import json
import random
import re

import pytest
import rosbag
import yaml
from sensor_msgs.msg import Imu
from std_msgs.msg import String

import imu_bag

PLACES = {"/front/sprung/imu": "/c", "/front/unsprung/imu": "/a", "/rear/sprung/imu": "/b", "/rear/unsprung/imu": "/d"}


@pytest.fixture(scope="module")
def drive(program, tmp_path_factory):
    """Half a car."""
    bag = tmp_path_factory.mktemp("check") / "drive.bag"
    program.succeed("simulate", "--vehicle-model", "half_sedan", "--set", "duration=60", "-o", bag)
    return bag


def rename(source, path, topics, turn=lambda topic, v: v):
    """Takes topics of a bag under other names, with accelerations turned."""
    with rosbag.Bag(str(source)) as bag, rosbag.Bag(str(path), "w") as out:
        for topic, imu, time in bag.read_messages(list(topics)):
            v = imu.linear_acceleration
            v.x, v.y, v.z = turn(topic, (v.x, v.y, v.z))
            out.write(topics[topic], imu, time)
    return path


def check(program, bag, folder, *arguments):
    output = program.succeed("check", bag, "--json", folder / "check.json", *arguments)
    return output, json.loads((folder / "check.json").read_text())


def pairs_of(found):
    return {pair["wheel"]: pair["body"] for pair in found["pairs"]}


def axes_of(found):
    return {each["topic"]: each["up_axis"] for each in found["topics"]}


def test_tells_bodies_wheels_and_axes_and_writes_a_vehicle_file_that_identify_takes(program, drive, tmp_path):
    bag = rename(drive, tmp_path / "named.bag", PLACES, lambda topic, v: (-v[2], v[1], v[0]))
    output, found = check(program, bag, tmp_path, "--write", tmp_path / "vehicle.yaml")
    assert pairs_of(found) == {"/a": "/c", "/d": "/b"}
    assert set(axes_of(found).values()) == {"-x"}
    assert {each["verdict"] for each in found["topics"]} == {"OK"}
    assert "/c moves like the body over wheel /a" in output
    written = yaml.safe_load((tmp_path / "vehicle.yaml").read_text())
    assert written == {"struts": {"a": {"sprung_imu": "/c", "unsprung_imu": "/a"},
                                  "d": {"sprung_imu": "/b", "unsprung_imu": "/d"}}}
    told = next(line for line in output.splitlines() if line.startswith("Next: ")).partition(" ")[2]
    head = [line for line in (tmp_path / "vehicle.yaml").read_text().splitlines() if line.startswith("#")]
    assert head == ["# suspension_bag check has found this.", f"# {told}"]
    program.succeed(*told.split()[3:], "--json", tmp_path / "identified.json")
    struts = json.loads((tmp_path / "identified.json").read_text())["struts"]
    for pair in found["pairs"]:
        for name in ("damping_to_mass", "stiffness_to_mass"):
            assert pair[name] == pytest.approx(struts[pair["wheel"][1:]]["estimate"][name], rel=0.15)


def test_struts_are_called_by_the_corners_in_their_topics(program, drive, tmp_path):
    topics = {"/front/sprung/imu": "/b", "/front/unsprung/imu": "/wheels/front_left/imu",
              "/rear/sprung/imu": "/d", "/rear/unsprung/imu": "/rear_left/imu"}
    check(program, rename(drive, tmp_path / "corners.bag", topics), tmp_path, "--write", tmp_path / "vehicle.yaml")
    assert set(yaml.safe_load((tmp_path / "vehicle.yaml").read_text())["struts"]) == {"front_left", "rear_left"}


def test_what_is_too_short_for_gravity_says_so(program, drive, tmp_path):
    result = program("check", drive, "--end", "5")
    assert result.returncode == 4 and "No gravity" not in result.stdout
    assert result.stdout.count("too short to tell which axis is up: record half a minute of driving") == 5


def test_one_body_imu_serves_all_wheels(program, drive, tmp_path):
    bag = rename(drive, tmp_path / "one.bag", {"/imu/data": "/b", "/front/unsprung/imu": "/a", "/rear/unsprung/imu": "/d"})
    output, found = check(program, bag, tmp_path, "--write", tmp_path / "vehicle.yaml")
    assert pairs_of(found) == {"/a": "/b", "/d": "/b"}
    assert not any(pair["own"] or "damping_to_mass" in pair for pair in found["pairs"])
    text = (tmp_path / "vehicle.yaml").read_text()
    assert yaml.safe_load(text)["body_imu"] == "/b" and text.count("fill in: position") == 2


def test_a_strut_gets_its_settings_even_without_gravity(program, tmp_path):
    program.succeed("simulate", "--scenario", "iso_road", "--rate", "100", "--duration", "60", "-o", tmp_path / "drive.bag")
    topics = {imu_bag.SPRUNG: "/b", imu_bag.UNSPRUNG: "/a"}

    def turn(topic, v):
        level = v[2] - 9.81
        return (level, 0.0, 0.0) if topic == imu_bag.SPRUNG else (0.0, -level, 0.0)

    bag = rename(tmp_path / "drive.bag", tmp_path / "turned.bag", topics, turn)
    output, found = check(program, bag, tmp_path, "--write", tmp_path / "strut.yaml")
    assert pairs_of(found) == {"/a": "/b"} and axes_of(found) == {"/a": "-y", "/b": "x"}
    assert yaml.safe_load((tmp_path / "strut.yaml").read_text()) == {"sprung_axis": "x", "unsprung_axis": "-y"}
    assert "No gravity in /a, /b" in output
    program.succeed("identify", bag, "--config", tmp_path / "strut.yaml", "--sprung-topic", "/b", "--unsprung-topic", "/a")
    asked = check(program, bag, tmp_path, "--sprung-topic", "/b", "--unsprung-topic", "/a")[1]
    assert asked["pairs"] == found["pairs"]


def test_without_a_pair_the_table_is_printed_all_the_same(program, drive, tmp_path):
    bag = rename(drive, tmp_path / "bodies.bag", {"/front/sprung/imu": "/a", "/rear/sprung/imu": "/b"})
    result = program("check", bag, "--json", tmp_path / "check.json")
    assert result.returncode == 4 and "no IMU moves like a body" in result.stderr
    assert result.stdout.count("OK") == 2 and json.loads((tmp_path / "check.json").read_text())["pairs"] == []


def test_one_imu_alone_is_told_that_another_is_needed(program, drive, tmp_path):
    result = program("check", rename(drive, tmp_path / "one.bag", {"/front/sprung/imu": "/a"}))
    assert result.returncode == 4 and "one IMU is not enough" in result.stderr
    assert result.stdout.count("OK") == 1


def test_what_is_wrong_with_a_topic_is_said(program, tmp_path):
    rng = random.Random(1)
    with rosbag.Bag(str(tmp_path / "wrong.bag"), "w") as bag:
        for k in range(3000):
            for topic in ("/few", "/lost", "/stuck"):
                if (topic == "/few" and k > 20) or (topic == "/lost" and rng.random() < 0.2):
                    continue
                imu = Imu()
                imu.header.stamp = imu_bag.to_time(10**9 + k * 10**7)
                imu.linear_acceleration.z = 9.81 + (0.0 if topic == "/stuck" else 0.1 * (k * 7919 % 101) / 101)
                bag.write(topic, imu, imu.header.stamp)
    result = program("check", tmp_path / "wrong.bag")
    line = {text.split()[0]: text for text in result.stdout.splitlines() if text.startswith("/")}
    assert result.returncode == 4
    assert "too few messages" in line["/few"]
    missing = int(re.search(r"(\d+) % of the readings are missing", line["/lost"])[1])
    assert missing == pytest.approx(20, abs=4)  # five standard deviations of 3000 draws
    assert "stuck" in line["/stuck"]


def test_bags_without_imus_and_options_that_do_not_fit_are_refused(program, drive, tmp_path):
    with rosbag.Bag(str(tmp_path / "other.bag"), "w") as bag:
        bag.write("/other", String("x"), imu_bag.to_time(10**9))
    program.refuse(3, ["check", tmp_path / "other.bag"], ["no topic of sensor_msgs/Imu"], tmp_path)
    program.refuse(3, ["check", drive, "--sprung-topic", "/no", "--unsprung-topic", "/imu/data"], ["no topic /no"], tmp_path)
    program.refuse(2, ["check", drive, "--sprung-topic", "/imu/data"], ["must come with the other"], tmp_path)


def test_a_part_that_ends_before_it_begins_is_refused(program, drive, tmp_path):
    program.refuse(2, ["check", drive, "--start", "5", "--end", "1"], ["--start 5 --end 1 [s], must be 0 <= start < end"], tmp_path)
