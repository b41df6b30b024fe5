"""How simulate ends when it cannot go on: a strut that runs away or is too stiff, a signal. Nothing is left of the bag."""
import os
import signal
import subprocess
import time

import pytest

DRIVE = ["simulate", "--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100"]
LONG = ["simulate", "--duration", "100000", "-o", "out.bag"]
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


@pytest.mark.parametrize("effect, words", [
    ("quadratic_damping=-50", ["quadratic_damping = -50", "unstable"]),
    ("clock_offset=0.01", None),
    ("coulomb_friction=1,vs=1e-9", ["coulomb_friction = 1, vs = 1e-09", "too stiff"]),
    ("hysteresis=1,x=1e-9", ["hysteresis = 1, x = 1e-09", "too stiff"])])
def test_a_strut_that_cannot_be_simulated_is_refused(program, tmp_path, effect, words):
    arguments = [*DRIVE, "--duration", "30", "--effect", effect, "-o", tmp_path / "drive.bag"]
    if words is None:
        program.succeed(*arguments)
    else:
        program.refuse(2, arguments, words, tmp_path)


def test_unknown_effect_lists_faults_of_the_reading_too(program, tmp_path):
    program.refuse(2, [*DRIVE, "--effect", "fooo=1", "-o", tmp_path / "drive.bag"],
                   ["fooo", "quadratic_damping", "clock_offset", "accelerometer_bias", "scale_error", "mount_tilt",
                    "lever_arm"], tmp_path)


def test_two_rates_are_both_told(program, tmp_path):
    told = program.succeed("simulate", "--duration", "2", "--set", "sprung_rate=1000", "--set", "unsprung_rate=50",
                           "-o", tmp_path / "drive.bag")
    assert "1000 Hz (sprung) and 50 Hz (unsprung)" in told
    assert "at 40 Hz," in program.succeed("simulate", "--duration", "2", "--rate", "40", "-o", tmp_path / "drive.bag")


def wait_for_growth(folder):
    """Until the unfinished bag is being written."""
    deadline = time.monotonic() + 20.0
    while not any(path.stat().st_size > 100_000 for path in folder.iterdir() if ".part" in path.name):
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_leaves_no_part_of_the_bag(program, tmp_path, number):
    (tmp_path / "out.bag").write_bytes(b"here first")
    process = subprocess.Popen([program.path, *LONG], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    wait_for_growth(tmp_path)
    process.send_signal(number)
    assert process.communicate(timeout=20) == (b"", b"")
    assert process.returncode == -number, "whoever waits for it sees what ended it"
    assert [path.name for path in tmp_path.iterdir()] == ["out.bag"]
    assert (tmp_path / "out.bag").read_bytes() == b"here first"


def test_a_signal_that_the_parent_ignores_stays_ignored(program, tmp_path):
    process = subprocess.Popen([program.path, *LONG], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    wait_for_growth(tmp_path)
    process.send_signal(signal.SIGHUP)
    time.sleep(0.3)
    assert process.poll() is None
    process.terminate()
    assert process.wait(timeout=20) == -signal.SIGTERM
    assert not list(tmp_path.iterdir())


def test_a_signal_leaves_no_part_of_the_tables(program, tmp_path):
    program.succeed("simulate", "--duration", "20000", "-o", tmp_path / "drive.bag")
    process = subprocess.Popen([program.path, "identify", "drive.bag", "--csv", "rows.csv", "--json", "result.json"],
                               cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    wait_for_growth(tmp_path)
    process.terminate()
    assert process.communicate(timeout=20) == (b"", b"")
    assert process.returncode == -signal.SIGTERM
    assert os.listdir(tmp_path) == ["drive.bag"]
