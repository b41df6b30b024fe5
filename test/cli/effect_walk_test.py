"""The five commands of the README, from a bag with a hidden effect to the falling error, as they stand there."""
import contextlib
import csv
import os
import re
import signal
import socket
import subprocess
import time

import imu_bag

README = imu_bag.REPOSITORY / "README.md"
EFFECT = "quadratic_damping"
TIMEOUT = 600.0  # [s] of wall time, after which it counts as stuck


def commands():
    block = re.search(r"<!-- walk -->\n```sh\n(.*?)```\n<!-- end -->", README.read_text(), re.DOTALL).group(1)
    return block.splitlines()


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


class Terminal:
    """Where a person types the commands: a folder, and a ROS master of its own."""

    def __init__(self, folder):
        self.folder = folder
        self.port = free_port()
        self.environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{self.port}", ROS_HOSTNAME="localhost",
                                ROS_HOME=str(folder / "ros_home"))

    def run(self, command):
        result = subprocess.run(command, shell=True, cwd=self.folder, env=self.environment, timeout=TIMEOUT,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        assert result.returncode == 0, result.stderr
        return result.stdout

    @contextlib.contextmanager
    def start(self, command, output):
        """Runs it in another terminal until the end of the context."""
        with open(self.folder / output, "w", encoding="utf-8") as stream:
            process = subprocess.Popen(command, shell=True, cwd=self.folder, env=self.environment, stdout=stream,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        try:
            yield process
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)
            try:
                process.wait(TIMEOUT)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()

    def wait_for_master(self):
        deadline = time.monotonic() + TIMEOUT
        while True:
            with contextlib.suppress(OSError), socket.create_connection(("localhost", self.port)):
                return
            assert time.monotonic() < deadline, "no ROS master"
            time.sleep(0.05)


def test_five_commands_of_the_readme(tmp_path):
    simulate, compare, diagnose, replay, watch = commands()
    terminal = Terminal(tmp_path)
    assert f"--effect {EFFECT}=" in simulate
    terminal.run(simulate)
    terminal.run(compare)
    assert f"Missing from the model: {EFFECT}." in terminal.run(diagnose)
    assert f"  {EFFECT}:\n" in (tmp_path / "model.yaml").read_text()
    with terminal.start(replay, "replay.txt") as replaying:
        terminal.wait_for_master()
        with terminal.start(watch, "comparison.csv"):
            status = replaying.wait(TIMEOUT)
    assert status == 0, (tmp_path / "replay.txt").read_text()
    rows = list(csv.DictReader(line for line in (tmp_path / "comparison.csv").read_text().splitlines()
                               if re.match(r"%time|\d", line)))
    assert len(rows) > 1000
    last = {name: float(rows[-1][f"field.{name}"]) for name in ("rmse", "base_rmse", "fit_percent", "base_fit_percent")}
    assert last["rmse"] < 0.7 * last["base_rmse"]
    assert last["fit_percent"] > last["base_fit_percent"]
