"""kill -9 at any moment: every file is as it was or whole, and the next run clears away what was left."""
import fcntl
import os
import random
import signal
import subprocess
import time

import pytest

import conftest

KILLS = 20
OLD = b"what was there before"
SEED = 4


@pytest.fixture(scope="module")
def long_bag(program, tmp_path_factory):
    path = tmp_path_factory.mktemp("kill") / "drive.bag"
    program.succeed("simulate", "--scenario", "paper_clean", "--duration", "300", "-o", path)
    return path


def commands(bag):
    """Arguments by name, and the names of the files that they write."""
    return {
        "simulate": (["simulate", "--scenario", "paper_clean", "--duration", "300", "-o", "out.bag"], ["out.bag"]),
        "identify": (["identify", bag, "--csv", "rows.csv", "--json", "result.json"], ["rows.csv", "result.json"]),
        "health": (["health", bag, "--csv", "rows.csv", "--json", "result.json"], ["rows.csv", "result.json"]),
        "compare": (["compare", bag, "--end", "60", "--json", "result.json"], ["result.json"]),
    }


def start(program, arguments, folder):
    return subprocess.Popen([program.path, *map(str, arguments)], cwd=folder, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


@pytest.mark.parametrize("name", ["simulate", "identify", "health", "compare"])
def test_killed_at_any_moment(program, long_bag, tmp_path, name):
    arguments, files = commands(long_bag)[name]
    whole = {}
    for round_number in range(2):  # the first reads the program from the disk
        process = start(program, arguments, tmp_path)
        _, process.returncode, used = os.wait4(process.pid, 0)
        assert process.returncode == 0
        duration = used.ru_utime + used.ru_stime
        whole[round_number] = {file: (tmp_path / file).read_bytes() for file in files}
    assert whole[0] == whole[1], "a run can be repeated: otherwise this test could not tell"
    chance = random.Random(SEED)
    unfinished = kills = 0
    for _ in range(4 * KILLS):  # a run may take less than the one that was measured
        if kills == KILLS:
            break
        for file in files:
            (tmp_path / file).write_bytes(OLD)
        process = start(program, arguments, tmp_path)
        moment = chance.uniform(0.0, 1.1 * duration)
        while process.poll() is None and conftest.processor_time(process.pid) < moment:
            time.sleep(0.0005)
        process.kill()
        kills += process.wait() == -signal.SIGKILL
        for file in files:
            assert (tmp_path / file).read_bytes() in (OLD, whole[0][file])
        parts = [path for path in tmp_path.iterdir() if path.name not in files]
        assert len(parts) <= len(files), "what an earlier process left is removed"
        unfinished += bool(parts)
    assert kills == KILLS
    assert unfinished > 0, "some were killed while writing"
    assert start(program, arguments, tmp_path).wait(conftest.HANGS) == 0
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == whole[0]


def test_unfinished_files_of_running_processes_and_others_stay(program, long_bag, tmp_path):
    for name in ("rows.csv.part", "rows.csv.partly", "other.csv.part7", "rows.csv.part7x"):
        (tmp_path / name).write_bytes(OLD)
    with open(tmp_path / "rows.csv.part1", "wb") as running:
        fcntl.flock(running, fcntl.LOCK_EX)
        (tmp_path / "rows.csv.part2").write_bytes(OLD)
        program("identify", long_bag, "--csv", tmp_path / "rows.csv")
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "other.csv.part7", "rows.csv", "rows.csv.part", "rows.csv.part1", "rows.csv.part7x", "rows.csv.partly"]
