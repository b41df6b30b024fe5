"""Damaged bags and every command: cut off, bytes changed, left by a recorder that was killed. A command says what is
wrong with which file or does its work; it never crashes, hangs or asks for all memory. wrong_input_test.py has `identify`
at more places."""
import random
import resource
import struct
import subprocess

import pytest
import rosbag

import conftest
import imu_bag

MOST_MEMORY = 1 << 30  # [bytes] of addresses; the program itself takes less than half
TIME_LIMIT = conftest.HANGS
COMMANDS = ("identify", "compare", "diagnose")
COMPRESSIONS = ("none", "bz2", "lz4")
CUTS, CHANGES = 10, 25  # by command and compression
SEED = 9


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    """A small bag by compression: 6 s in several chunks."""
    folder = tmp_path_factory.mktemp("broken")
    drive = tuple(column[:300] for column in imu_bag.paper_drive())
    return {compression: imu_bag.write_bag(folder / f"{compression}.bag", drive, compression=compression,
                                           chunk_size=20000).read_bytes() for compression in COMPRESSIONS}


def limit_memory():
    if not conftest.SANITIZED:  # AddressSanitizer reserves terabytes of addresses
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


class Runs:
    """Runs commands on bytes as a bag, and checks what must hold whatever they are."""

    def __init__(self, program, path):
        self.program = program.path
        self.path = path
        self.statuses = []

    def __call__(self, content, command="identify"):
        """@return what the command says."""
        self.path.write_bytes(content)
        result = subprocess.run([self.program, command, str(self.path)], preexec_fn=limit_memory, timeout=TIME_LIMIT,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
        assert result.returncode in (0, 3, 4), f"status {result.returncode}: {result.stderr}"
        if result.returncode == 3:
            assert str(self.path) in result.stderr, result.stderr
        assert "bad_alloc" not in result.stderr
        self.statuses.append(result.returncode)
        return result.stderr


@pytest.fixture
def runs(program, tmp_path):
    return Runs(program, tmp_path / "drive.bag")


@pytest.mark.parametrize("compression", COMPRESSIONS)
@pytest.mark.parametrize("command", COMMANDS)
def test_cut_off_anywhere(runs, bags, command, compression):
    content = bags[compression]
    chance = random.Random(SEED)
    places = [0, 13, 17, 4096, len(content) - 1, *(chance.randrange(len(content)) for _ in range(CUTS))]
    for place in places:
        runs(content[:place], command)
        assert runs.statuses[-1] == 3, f"the first {place} bytes"


@pytest.mark.parametrize("compression", COMPRESSIONS)
@pytest.mark.parametrize("command", COMMANDS)
def test_bytes_changed_anywhere(runs, bags, command, compression):
    content = bags[compression]
    chance = random.Random(SEED)
    for _ in range(CHANGES):
        changed = bytearray(content)
        for _ in range(chance.choice((1, 4, 20))):
            changed[chance.randrange(4200 if chance.random() < 0.9 else 0, len(content))] = chance.randrange(256)
        runs(bytes(changed), command)


def test_garbage(runs):
    chance = random.Random(SEED)
    for size in (0, 1, 100, 100000):
        assert "is not a bag" in runs(chance.randbytes(size))
    for _ in range(20):
        runs(b"#ROSBAG V2.0\n" + chance.randbytes(10000))
    assert set(runs.statuses) == {3}


@pytest.mark.parametrize("field, value", [("index_pos", 0), ("index_pos", 1 << 62), ("index_pos", 20),
                                          ("chunk_count", 1 << 31), ("conn_count", 0)])
def test_wrong_numbers_in_the_bag_header(runs, bags, field, value):
    name = field.encode() + b"="
    size = 8 if field == "index_pos" else 4
    start = bags["none"].index(name) + len(name)
    runs(bags["none"][:start] + struct.pack("<Q", value)[:size] + bags["none"][start + size:])
    assert runs.statuses == [3]


def test_lengths_that_are_too_large(runs, bags):
    """Every 32 bit number that could be a length, one after the other, in the headers of the file."""
    content = bags["none"]
    for at in [*range(13, 80), *range(4109, 4300, 3)]:
        runs(content[:at] + b"\xff\xff\xff\x3f" + content[at + 4:])


def test_wrong_checksum_of_the_message_type(runs, bags):
    content = bags["none"]
    checksum = b"md5sum=6a62c6daae103f4ff57a132d6f95cec2"
    assert content.count(checksum) > 1
    assert "sensor_msgs/Imu" in runs(content.replace(checksum, b"md5sum=" + b"0" * 32))
    assert runs.statuses == [3]


def test_recorder_that_was_killed(runs, tmp_path):
    """As `rosbag record` leaves it: NAME.bag.active, without an index."""
    active = tmp_path / "recording.bag.active"
    bag = rosbag.Bag(str(active), "w", chunk_threshold=20000)
    for k, values in enumerate(zip(*imu_bag.paper_drive())):
        for topic, acceleration in zip((imu_bag.SPRUNG, imu_bag.UNSPRUNG), values[1:]):
            bag.write(topic, imu_bag.imu(10**9 + k * 20_000_000, acceleration), imu_bag.to_time(10**9 + k * 20_000_000))
    bag._file.flush()
    content = active.read_bytes()
    bag.close()
    for command in COMMANDS:
        assert "rosbag reindex" in runs(content, command)
    assert runs.statuses == [3, 3, 3]
