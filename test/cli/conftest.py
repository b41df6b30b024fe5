"""What the tests of the program suspension_bag share. SUSPENSION_BAG names the program."""
import os
import pathlib
import shutil
import subprocess
import sys
import time

import pytest

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy, as suspension_fleet

import imu_bag  # noqa: E402

sys.path.insert(0, str(imu_bag.REPOSITORY / "scripts"))

from report.ports import held_port  # noqa: E402

PAPER_SETTINGS = imu_bag.REPOSITORY / "config/paper.yaml"

SANITIZED = "SANITIZE" in os.environ  # by scripts/test --sanitize
HANGS = 600  # [s] of wall time that nothing takes, even where the machine is busy with other work

# A small process between: the peak of a child begins with that of its parent.
MEASURE_PEAK = """import os, sys
child = os.spawnv(os.P_NOWAIT, sys.argv[1], sys.argv[1:])
print(os.wait4(child, 0)[2].ru_maxrss)
"""


def wait_until(predicate, what="", every=0.02):
    """every: [s] between two looks."""
    deadline = time.monotonic() + HANGS
    while not predicate():
        assert time.monotonic() < deadline, f"not in {HANGS} s: {what}"
        time.sleep(every)


@pytest.fixture
def port():
    """Of a server that the test starts."""
    with held_port() as number:
        yield number


class Program:
    """The program under test."""

    def __init__(self, path):
        self.path = path

    def __call__(self, *arguments, **keywords):
        """Runs it; a crash or a hang is a failure whatever the test is about."""
        result = subprocess.run([self.path, *map(str, arguments)], stdout=keywords.pop("stdout", subprocess.PIPE),
                                stderr=subprocess.PIPE, encoding="utf-8", errors="replace", timeout=HANGS, **keywords)
        expected = (0, 1, 2, 3, 4) if arguments[:1] == ("inspect",) else (0, 2, 3, 4)
        assert result.returncode in expected, f"status {result.returncode}: {result.stderr}"
        return result

    def succeed(self, *arguments):
        """@return standard output; messages are no part of a quiet success."""
        result = self(*arguments)
        assert (result.returncode, result.stderr) == (0, "")
        return result.stdout

    def refuse(self, status, arguments, words, folder):
        """Checks exit status and message, and that no file below folder appeared or changed."""
        before = snapshot(folder)
        result = self(*arguments)
        assert (result.returncode, result.stdout) == (status, ""), result.stderr
        assert result.stderr.startswith(f"suspension_bag {arguments[0]}: ")
        assert result.stderr.count("\n") == 1, "one line says it"
        for word in words:
            assert str(word) in result.stderr
        assert snapshot(folder) == before

    def peak_kilobytes(self, *arguments):
        """@return the most memory that a run, whatever its outcome, had resident."""
        if SANITIZED:
            pytest.skip("AddressSanitizer takes memory of its own")
        output = subprocess.run([sys.executable, "-S", "-c", MEASURE_PEAK, self.path, *map(str, arguments)], check=True,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8", timeout=HANGS).stdout
        return int(output.split()[-1])


def processor_time(process_id):
    """What a process that runs has computed so far [s]; unlike wall time it does not depend on what else runs."""
    return time.clock_gettime(~process_id << 3 | 2)  # clock_getcpuclockid(3), which Python lacks


def snapshot(folder):
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@pytest.fixture(scope="session")
def program():
    path = os.environ.get("SUSPENSION_BAG") or shutil.which("suspension_bag")
    if path is None or not pathlib.Path(path).exists():
        pytest.fail("SUSPENSION_BAG, must be the path of the built program suspension_bag")
    return Program(path)


@pytest.fixture(scope="session")
def paper_bag(tmp_path_factory):
    """The paper's reference input, 40 s at 50 Hz. Not to be written to."""
    return imu_bag.write_bag(tmp_path_factory.mktemp("paper") / "paper.bag", imu_bag.paper_drive())


@pytest.fixture(scope="session")
def short_drive():
    """6 s of it: enough for rows at a horizon of 0.6 s."""
    return tuple(column[:300] for column in imu_bag.paper_drive())
