"""One bag of a fleet: what it is known by, which vehicle it is of, and what is made of it, whatever happens."""
import json
import os
import subprocess
import sys

import genpy
import pytest
import rosbag

import conftest
import fleet
from suspension_health_monitor.fleet import bag_work
from suspension_health_monitor.fleet.bag_key import BLOCK, bag_key
from suspension_health_monitor.fleet.drive import CRASHED
from suspension_health_monitor.fleet.errors import FleetError, UsageError
from suspension_health_monitor.fleet.find_bags import FOLDER_OF_THE_BAG, find_bags, vehicle_pattern

START = 1_700_000_000


@pytest.fixture(scope="module")
def bag(program, tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "drive.bag"
    program.succeed("simulate", "--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--duration", "40",
                    "--set", f"start_time={START}", "-o", path)
    return path


def work(program, **more):
    return bag_work.Work(program.path, **more)


def test_a_bag_is_known_by_its_content(bag, tmp_path):
    content = bytearray(bag.read_bytes())
    key = bag_key(bag)
    other = tmp_path / "other_name.bag"
    other.write_bytes(content)
    assert bag_key(other) == key and len(key) == 64
    index = int.from_bytes(content[content.index(b"index_pos=") + 10:][:8], "little")
    assert index < len(content)
    keys = {key}
    for place in (BLOCK - 1, index, len(content) - 1):
        changed = bytearray(content)
        changed[place] ^= 1
        other.write_bytes(changed)
        keys.add(bag_key(other))
    other.write_bytes(content[:-1])
    keys.add(bag_key(other))
    assert len(keys) == 5


def test_all_of_a_long_index_counts(tmp_path):
    head = b"#ROSBAG V2.0\nindex_pos=" + BLOCK.to_bytes(8, "little")
    content = bytearray(head.ljust(5 * BLOCK, b"\0"))
    (tmp_path / "a.bag").write_bytes(content)
    content[BLOCK + 1] = 1
    (tmp_path / "b.bag").write_bytes(content)
    assert bag_key(tmp_path / "a.bag") != bag_key(tmp_path / "b.bag")


def test_what_has_no_content_has_no_key(tmp_path):
    (tmp_path / "empty.bag").touch()
    os.mkfifo(tmp_path / "pipe.bag")
    for name, words in (("empty.bag", "is empty"), ("pipe.bag", "is a pipe"), ("none.bag", "No such file"),
                        (".", "directory")):
        with pytest.raises(OSError, match=words):
            bag_key(tmp_path / name)


def test_bags_are_found_below_folders(tmp_path):
    for name in ("a/1.bag", "a/deep/2.bag", "b/3.bag", "b/notes.txt", "b/4.bag.active", ".part.x/5.bag", "b/.6.bag"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "loop").symlink_to(tmp_path)

    def found(*paths):
        return sorted(os.path.relpath(path, tmp_path) for path in find_bags([str(tmp_path / path) for path in paths]))
    assert found("") == ["a/1.bag", "a/deep/2.bag", "b/3.bag"]
    assert found("b/notes.txt", "a/deep") == ["a/deep/2.bag", "b/notes.txt"]
    assert found("*/[13].bag") == ["a/1.bag", "b/3.bag"]
    assert found(".part.x") == [".part.x/5.bag"], "who names it means it"
    (tmp_path / "a/round").symlink_to(tmp_path)  # so that paths without end, two to the depth of them, lead to a bag
    for pattern in ("**", "**/", "**/*", "**/*.bag", "[ab]/**/*.bag", "**/[ab]/**", "**/**/*.bag"):
        assert found(pattern) == ["a/1.bag", "a/deep/2.bag", "b/3.bag"] + ["b/4.bag.active", "b/notes.txt"] * (
            pattern == "**/*"), pattern
    assert found("**/deep") == found("**/a/**/*.bag")[1:] == ["a/deep/2.bag"] and found("**/*.txt") == ["b/notes.txt"]
    with pytest.raises(FleetError, match="no_such"):
        find_bags([str(tmp_path / "**/no_such")])
    with pytest.raises(FleetError, match="nowhere"):
        find_bags([str(tmp_path / "nowhere*")])


def test_the_path_tells_the_vehicle():
    assert vehicle_pattern(FOLDER_OF_THE_BAG)("/data/robot_7/monday.bag") == "robot_7"
    assert vehicle_pattern(r"r(\d+)_(?P<vehicle>\w+)")("/data/r1_fox/monday.bag") == "fox"
    assert vehicle_pattern(r"r(\d+)_")("/data/fox/monday.bag") is None
    assert vehicle_pattern(r"(\d*)_")("/data/fox_/monday.bag") is None
    for text in ("robot", "("):
        with pytest.raises(UsageError, match="--vehicle-pattern"):
            vehicle_pattern(text)


def test_a_bag_becomes_rows(program, bag, tmp_path):
    program.succeed("identify", bag, "--json", tmp_path / "identify.json")
    program.succeed("health", bag, "--json", tmp_path / "health.json")
    estimate = json.loads((tmp_path / "identify.json").read_text())["estimate"]
    health = json.loads((tmp_path / "health.json").read_text())
    drive = bag_work.read_bag(str(bag), "key", work(program))
    assert (drive.status, drive.reason, drive.start, drive.diagnosed) == ("ok", None, START, False)
    assert drive.duration == pytest.approx(40, abs=0.02)
    (row,) = drive.struts
    assert row["strut"] == "strut" and row["estimator"] == "estimate" and row["valid"]
    assert all(row[name] == estimate[name] for name in ("damping_to_mass", "damping_to_mass_stddev",
                                                        "stiffness_to_mass", "stiffness_to_mass_stddev"))
    assert row["offset"] == health["la"]["offset"]
    assert [(event["time"], event["message"]) for event in drive.events] == [
        (event["time"], event["message"]) for event in health["events"]]
    assert drive.events[-1]["time"] > START


def test_a_search_becomes_findings(program, bag, tmp_path):
    drive = bag_work.read_bag(str(bag), "key", work(program, diagnose=True, pages=str(tmp_path)))
    assert drive.diagnosed
    (finding,) = drive.findings
    assert (finding["strut"], finding["verdict"], finding["effects"]) == ("strut", "nothing_missing", "")
    assert finding["page"] == str(tmp_path / "key/report.html") and os.path.exists(finding["page"])


def test_poor_and_broken_bags_are_rows_with_a_reason(program, bag, tmp_path):
    short, cut = tmp_path / "short.bag", tmp_path / "cut.bag"
    program.succeed("simulate", "--duration", "1", "-o", short)
    cut.write_bytes(bag.read_bytes()[:-1000])
    poor = bag_work.read_bag(str(short), "key", work(program))
    assert (poor.status, poor.struts) == ("poor", []) or not any(row["valid"] for row in poor.struts)
    assert poor.status == "poor" and poor.reason
    broken = bag_work.read_bag(str(cut), "key", work(program))
    assert (broken.status, broken.start) == ("unreadable", None) and "cut off" in broken.reason
    assert str(cut) not in broken.reason
    other = bag_work.read_bag(str(bag), "key", work(program, options=("--sprung-topic", "/none")))
    assert other.status == "unreadable" and "/none" in other.reason


def test_struts_that_are_not_known_say_why(program, tmp_path):
    vehicle = tmp_path / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", "sedan", "--duration", "2", "--vehicle-file", vehicle, "-o",
                    tmp_path / "short.bag")
    drive = bag_work.read_bag(str(tmp_path / "short.bag"), "key", work(program, options=("--vehicle", str(vehicle))))
    assert (drive.status, drive.struts) == ("poor", []) and "too short" in drive.reason


def test_what_is_no_matter_of_the_bag_ends_the_scan(program, bag, tmp_path):
    for options, words in ((("--set", "no_option=1"), "no_option"), (("--config", str(tmp_path / "none.yaml")), "none.yaml")):
        with pytest.raises(UsageError, match=words):
            bag_work.read_bag(str(bag), "key", work(program, options=options, files=(options[1],)))


def test_crashes_and_hangs_are_rows_with_a_reason(program, bag, tmp_path, monkeypatch):
    monkeypatch.setenv("REAL", program.path)
    killed = fleet.write_program(tmp_path / "killed", '[ "$1" = health ] && kill -9 $$')
    drive = bag_work.read_bag(str(bag), "key", bag_work.Work(str(killed)))
    assert drive.status == CRASHED and "health was ended by SIGKILL, as for want of memory" in drive.reason
    assert drive.struts[0]["valid"], "what has been told before is kept"
    hangs = fleet.write_program(tmp_path / "hangs", '[ "$1" = identify ] && exec sleep 1000')
    drive = bag_work.read_bag(str(bag), "key", bag_work.Work(str(hangs), time_limit=0.2))
    assert drive.status == CRASHED and "--time-limit" in drive.reason
    failing = fleet.write_program(tmp_path / "failing", "exit 77")
    assert "ended with status 77" in bag_work.read_bag(str(bag), "key", bag_work.Work(str(failing))).reason


def test_processes_end_with_their_worker(program, bag, tmp_path, monkeypatch):
    monkeypatch.setenv("REAL", program.path)
    slow = fleet.write_program(tmp_path / "slow", f"echo $$ > {tmp_path}/pid; exec sleep 1000")
    worker = subprocess.Popen([sys.executable, "-c", "import sys; from suspension_health_monitor.fleet import bag_work;"
                               "bag_work.read_bag(sys.argv[1], 'key', bag_work.Work(sys.argv[2]))", str(bag), str(slow)])
    try:
        conftest.wait_until(lambda: (tmp_path / "pid").exists() and (tmp_path / "pid").read_text().strip())
    finally:
        worker.kill()
        worker.wait()
    child = int((tmp_path / "pid").read_text())
    conftest.wait_until(lambda: not os.path.exists(f"/proc/{child}") or fleet.is_zombie(child))


def test_temperatures(program, bag, tmp_path):
    from sensor_msgs.msg import Temperature
    warm = tmp_path / "warm.bag"
    warm.write_bytes(bag.read_bytes())
    with rosbag.Bag(str(warm), "a") as file:
        for second, value in enumerate((20.0, float("nan"), 23.0)):
            file.write("/damper/strut/temperature", Temperature(temperature=value), genpy.Time(START + second + 1))
    (row,) = bag_work.read_bag(str(warm), "key", work(program, temperature_topic="/damper/{strut}/temperature")).struts
    assert row["temperature"] == 21.5
    (row,) = bag_work.read_bag(str(warm), "key", work(program, temperature_topic="/none")).struts
    assert row["temperature"] is None
