"""A signal ends a command: it prints one sentence and removes its unfinished files."""
import os
import signal
import subprocess

import pytest

import conftest

LONG = ["simulate", "--duration", "100000", "-o", "out.bag"]
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
OFTEN = 0.002  # [s]: what is waited for is soon over


@pytest.fixture(scope="module")
def long_bag(program, tmp_path_factory):
    path = tmp_path_factory.mktemp("signals") / "drive.bag"
    program.succeed("simulate", "--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--duration", "3000",
                    "-o", path)
    return path


def start(program, folder, arguments, **handling):
    """handling: of signals, by name; those not named as at a terminal, even where this test runs in the background."""
    def set_up():
        for number in SIGNALS:
            signal.signal(number, handling.get(number.name, signal.SIG_DFL))
    return subprocess.Popen([program.path, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            preexec_fn=set_up)


def told(command):
    return f"suspension_bag {command}: interrupted, files that were not finished are removed\n".encode()


def wait_for_growth(folder, size=100_000):
    """Until the unfinished bag has that many bytes."""
    conftest.wait_until(lambda: any(path.stat().st_size > size for path in folder.iterdir() if ".part" in path.name),
                        every=OFTEN)


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_leaves_no_part_of_the_bag(program, tmp_path, number):
    (tmp_path / "out.bag").write_bytes(b"here first")
    process = start(program, tmp_path, LONG)
    wait_for_growth(tmp_path)
    process.send_signal(number)
    assert process.communicate(timeout=conftest.HANGS) == (b"", told("simulate"))
    assert process.returncode == -number, "whoever waits for it sees what ended it"
    assert [path.name for path in tmp_path.iterdir()] == ["out.bag"]
    assert (tmp_path / "out.bag").read_bytes() == b"here first"


def test_a_second_signal_ends_it_at_once_and_leaves_no_part(program, tmp_path):
    process = start(program, tmp_path, LONG)
    wait_for_growth(tmp_path)
    for number in [signal.SIGSTOP, signal.SIGINT, signal.SIGTERM, signal.SIGCONT]:  # it sees both before it can work
        process.send_signal(number)
    assert process.communicate(timeout=conftest.HANGS) == (b"", b"")
    assert process.returncode in [-signal.SIGINT, -signal.SIGTERM]
    assert not list(tmp_path.iterdir())


def test_a_signal_that_the_parent_ignores_stays_ignored(program, tmp_path):
    process = start(program, tmp_path, LONG, SIGHUP=signal.SIG_IGN)
    wait_for_growth(tmp_path)
    process.send_signal(signal.SIGHUP)
    wait_for_growth(tmp_path, 2 * sum(path.stat().st_size for path in tmp_path.iterdir()))
    assert process.poll() is None
    process.terminate()
    assert process.wait(timeout=conftest.HANGS) == -signal.SIGTERM
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("command, files, after", [  # [s] of processor time: while it reads the bag, while it computes
    ("identify", ["--csv", "rows.csv", "--json", "result.json"], 0.0),
    ("check", ["--json", "result.json", "--write", "strut.yaml"], 0.0),
    ("compare", ["--json", "result.json"], 0.0), ("compare", ["--json", "result.json"], 0.5),
    ("diagnose", ["--json", "result.json", "-o", "model.yaml"], 0.5)])
def test_a_signal_leaves_no_part_of_the_results(program, long_bag, tmp_path, command, files, after):
    process = start(program, tmp_path, [command, long_bag, *files])
    conftest.wait_until(lambda: os.listdir(tmp_path), every=OFTEN)
    begun = conftest.processor_time(process.pid)
    conftest.wait_until(lambda: conftest.processor_time(process.pid) >= begun + after, every=OFTEN)
    process.terminate()
    assert process.communicate(timeout=conftest.HANGS) == (b"", told(command))
    assert process.returncode == -signal.SIGTERM
    assert os.listdir(tmp_path) == []
