"""Bags that are no bags, damaged, of the wrong content, or too poor: status 3 or 4, or the right result."""
import json
import os
import random

import numpy as np
import pytest
import rosbag
from std_msgs.msg import String

import conftest
import imu_bag

SETTINGS = ["--config", conftest.PAPER_SETTINGS]


def unclosed(path, drive):
    """What is on the disk when a recorder dies."""
    with rosbag.Bag(str(path) + ".recording", "w", chunk_threshold=10000) as bag:
        for k, time in enumerate(drive[0]):
            for topic, acceleration in zip((imu_bag.SPRUNG, imu_bag.UNSPRUNG), drive[1:]):
                message = imu_bag.imu(round(time * 1e9) + 10**9, acceleration[k])
                bag.write(topic, message, message.header.stamp)
        bag.flush()
        path.write_bytes((path.parent / (path.name + ".recording")).read_bytes())


NOT_A_BAG = {
    "missing": (None, ["cannot be read", "No such file"]),
    "empty": (b"", ["is not a bag"]),
    "text": (b"time,acceleration\n0,1\n", ["is not a bag", "2.0"]),
    "old format": (b"#ROSBAG V1.2\n" + bytes(100), ["is not a bag of format 2.0", "rosbag fix"]),
    "nothing behind the first line": (b"#ROSBAG V2.0\n", ["is cut off", "rosbag reindex"]),
    "zeros": (b"#ROSBAG V2.0\n" + bytes(10000), ["damaged"]),
    "huge length": (b"#ROSBAG V2.0\n" + b"\xff" * 10000, ["is cut off"]),
}


@pytest.mark.parametrize("content, words", NOT_A_BAG.values(), ids=NOT_A_BAG.keys())
def test_not_a_bag(program, tmp_path, content, words):
    path = tmp_path / "drive.bag"
    if content is not None:
        path.write_bytes(content)
    program.refuse(3, ["identify", path, "--json", tmp_path / "result.json"], [path, *words], tmp_path)


def test_a_folder_is_no_bag(program, tmp_path):
    program.refuse(3, ["identify", tmp_path], [tmp_path, "directory"], tmp_path)


def test_a_pipe_is_no_bag_and_not_waited_for(program, tmp_path):
    os.mkfifo(tmp_path / "drive.bag")
    program.refuse(3, ["identify", tmp_path / "drive.bag"], [tmp_path / "drive.bag"], tmp_path)


def test_second_bag_missing(program, paper_bag, tmp_path):
    arguments = ["identify", paper_bag, tmp_path / "b.bag", *SETTINGS, "--csv", tmp_path / "rows.csv"]
    program.refuse(3, arguments, [tmp_path / "b.bag"], tmp_path)


def test_recorder_died(program, short_drive, tmp_path):
    unclosed(tmp_path / "drive.bag", short_drive)
    program.refuse(3, ["identify", tmp_path / "drive.bag"], ["drive.bag", "not closed", "rosbag reindex"], tmp_path)


def test_missing_topic_names_those_that_are_there(program, paper_bag, tmp_path):
    for option in ("--sprung-topic", "--unsprung-topic"):
        program.refuse(3, ["identify", paper_bag, option, "/imu"],
                       [paper_bag, "no topic /imu", option, imu_bag.SPRUNG, imu_bag.UNSPRUNG], tmp_path)


def test_topic_of_another_type(program, tmp_path):
    with rosbag.Bag(str(tmp_path / "drive.bag"), "w") as bag:
        bag.write(imu_bag.SPRUNG, String("hello"))
        bag.write(imu_bag.UNSPRUNG, imu_bag.imu(1, 0.0))
    program.refuse(3, ["identify", tmp_path / "drive.bag"],
                   ["drive.bag", imu_bag.SPRUNG, "std_msgs/String", "sensor_msgs/Imu"], tmp_path)


def test_no_message(program, tmp_path):
    rosbag.Bag(str(tmp_path / "drive.bag"), "w").close()
    program.refuse(4, ["identify", tmp_path / "drive.bag"], ["drive.bag", "no messages"], tmp_path)


@pytest.mark.parametrize("settings", [SETTINGS, []], ids=["configured", "measured"])
def test_too_short(program, tmp_path, settings):
    for length in (1, 2, 5, 15):
        bag = imu_bag.write_bag(tmp_path / "drive.bag", [column[:length] for column in imu_bag.paper_drive()])
        program.refuse(4, ["identify", bag, *settings, "--csv", tmp_path / "rows.csv"], [], tmp_path)


def test_rows_without_a_valid_estimate_are_shown_but_are_too_little(program, tmp_path):
    bag = imu_bag.write_bag(tmp_path / "61.bag", [column[:61] for column in imu_bag.paper_drive()])
    result = program("identify", bag, *SETTINGS, "--csv", tmp_path / "rows.csv")
    assert result.returncode == 4
    assert "there is no estimate: too short" in result.stderr
    assert "NOT VALID" in result.stdout
    assert len((tmp_path / "rows.csv").read_text().splitlines()) == 2  # the header and the one row that 2 L + 1 give


def test_one_sample_less_gives_no_row(program, tmp_path):
    bag = imu_bag.write_bag(tmp_path / "60.bag", [column[:60] for column in imu_bag.paper_drive()])
    program.refuse(4, ["identify", bag, *SETTINGS], ["61 samples", "60"], tmp_path)


def test_start_behind_the_end(program, paper_bag, tmp_path):
    program.refuse(4, ["identify", paper_bag, *SETTINGS, "--start", "1000"], ["0"], tmp_path)


@pytest.mark.parametrize("settings", [SETTINGS, []], ids=["configured", "measured"])
def test_all_nan(program, tmp_path, settings):
    times, _, unsprung = imu_bag.paper_drive()
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times, np.full_like(times, np.nan), unsprung))
    arguments = ["identify", bag, *settings, "--json", tmp_path / "result.json"]
    program.refuse(4, arguments, ["not_finite: 2001"] if settings else [], tmp_path)


def test_parked_car(program, tmp_path):
    times = imu_bag.paper_drive()[0]
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times, np.zeros_like(times), np.zeros_like(times)))
    result = program("identify", bag)
    assert result.returncode == 4 and "too little motion" in result.stderr


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_samples_that_are_not_finite_are_counted_and_left_out(program, tmp_path, value):
    times, sprung, unsprung = imu_bag.paper_drive()
    sprung[[300, 301, 900]] = value
    unsprung[1200] = value
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times, sprung, unsprung))
    program.succeed("identify", bag, *SETTINGS, "--json", tmp_path / "result.json")
    result = json.loads((tmp_path / "result.json").read_text())
    assert (result["samples"], result["gaps"]) == (2001 - 4, 3)
    assert result["rejected"].pop("not_finite") == 4
    assert result["rejected"].pop("missing_partner") == 4
    assert not any(result["rejected"].values())
    assert result["rows"] == 1997 - 4 * 60
    assert result["la"]["stiffness_to_mass"] == pytest.approx(13.8, rel=0.05)


def test_measured_period_that_no_setting_may_have(program, tmp_path):
    times, *accelerations = imu_bag.paper_drive()
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times * 1000, *accelerations))
    program.refuse(3, ["identify", bag, "--set", "integration_horizon=600"],
                   ["measured from the stamps", "sample_period = 20", "in [1e-05, 10]"], tmp_path)


COMPRESSIONS = ("none", "bz2", "lz4")
ORDERS = ("in pairs", "one topic after the other")
# Without compression both orders, of which the second has chunks that overlap in time; with one, each once.
LAYOUTS = [("none", ORDERS[0]), ("none", ORDERS[1]), ("bz2", ORDERS[0]), ("lz4", ORDERS[1])]


def identify_damaged(program, path, content):
    path.write_bytes(content)
    result = program("identify", path, *SETTINGS)
    assert result.returncode in (0, 3, 4)
    assert result.returncode != 3 or (str(path) in result.stderr and result.stdout == "")
    return result


@pytest.mark.parametrize("compression, order", LAYOUTS)
def test_cut_off_anywhere(program, tmp_path, short_drive, compression, order):
    bag = imu_bag.write_bag(tmp_path / "whole.bag", short_drive, compression=compression, chunk_size=20000, order=order)
    whole = bag.read_bytes()
    lengths = [*range(0, len(whole), 997), *range(len(whole) - 60, len(whole))]
    for length in lengths:
        result = identify_damaged(program, tmp_path / "cut.bag", whole[:length])
        assert result.returncode == 3, f"cut at {length} of {len(whole)} bytes"
    assert identify_damaged(program, tmp_path / "cut.bag", whole).returncode == 0


@pytest.mark.parametrize("compression, order", LAYOUTS)
def test_flipped_bytes(program, tmp_path, short_drive, compression, order):
    """Compressed chunks have checksums: there the result is the right one or none. Others have only their structure."""
    bag = imu_bag.write_bag(tmp_path / "whole.bag", short_drive, compression=compression, chunk_size=20000, order=order)
    whole = bag.read_bytes()
    right = program.succeed("identify", bag, *SETTINGS)
    dice = random.Random(1)
    for _ in range(100):
        position = dice.randrange(len(whole)) if dice.random() < 0.5 else structure_byte(dice, whole)
        flipped = bytearray(whole)
        flipped[position] ^= dice.randrange(1, 256)
        result = identify_damaged(program, tmp_path / "flipped.bag", flipped)
        if result.returncode == 0 and compression != "none":
            assert result.stdout == right, f"byte {position} is {flipped[position]}"


def structure_byte(dice, content):
    """A byte in or near a field of some record's header, where damage reaches furthest."""
    names = (b"op=", b"conn=", b"time=", b"index_pos=", b"conn_count=", b"chunk_count=", b"size=", b"compression=",
             b"chunk_pos=", b"start_time=", b"end_time=", b"count=", b"topic=", b"md5sum=")
    while True:
        start = content.find(dice.choice(names), dice.randrange(len(content)))
        if start >= 0:
            return min(start + dice.randrange(-12, 24), len(content) - 1)


@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_a_damaged_length_claims_no_memory(program, tmp_path, short_drive, compression):
    bag = imu_bag.write_bag(tmp_path / "whole.bag", short_drive, compression=compression, chunk_size=20000)
    whole = bag.read_bytes()
    field = whole.index(b"size=", whole.index(b"compression="))  # of the first chunk's decompressed bytes
    length = whole.index(b"compression=") - 4 + whole[whole.index(b"compression=") - 4] + 4
    damaged = tmp_path / "damaged.bag"
    for position in (field + 5 + 3, field + 5 + 2, length + 3):
        content = bytearray(whole)
        content[position] = 0x3f
        damaged.write_bytes(content)
        assert program.peak_kilobytes("identify", damaged) < 60_000
