"""The paper's experiments: what they are, and how they run through the nodelets."""
import contextlib
import dataclasses
import os
import pathlib
import signal
import socket
import subprocess
import time

import yaml

DURATION = 120.0  # [s] of one drive
# How much faster than the wall clock the drives run; where a recording misses rows, that drive runs again, slower.
# rosbag record holds 100 messages per topic until it sees the clock, and it looks every 0.1 s: at 50 Hz anything
# above 20 loses the beginning, and a busy machine needs time to spare.
REAL_TIME_FACTORS = (12.0, 8.0, 4.0)
START_AND_END = 6.0  # [s] wall time around a drive, for the progress bar
GRACE = 60.0  # [s] wall time beyond that, before a drive counts as stuck


@dataclasses.dataclass(frozen=True)
class Claim:
    """The rms errors of one estimator: `at most` or `at least` the bounds on b1 [1/s] and b0 [1/s^2]."""
    at_most: bool
    bounds: tuple

    def holds(self, values):
        return all(value <= bound if self.at_most else value >= bound for value, bound in zip(values, self.bounds))

    def __str__(self):
        return f"{'≤' if self.at_most else '≥'} {self.bounds[0]:g}, {self.bounds[1]:g}"


@dataclasses.dataclass(frozen=True)
class Experiment:
    """One drive of the paper; faults: (start, end) [s] of what disturbs it, one instant for a bump."""
    scenario: str
    title: str
    faults: tuple
    claims: dict


# The paper says "very sensitive" and "almost insensitive"; the bounds put numbers to it.
EXPERIMENTS = (
    Experiment("paper_clean", "no fault", (), {"ls": Claim(True, (0.055, 0.19)), "la": Claim(True, (0.08, 0.12))}),
    Experiment("paper_outliers", "data loss", ((25.0, 26.0), (65.0, 66.0)),
               {"ls": Claim(False, (0.45, 0.70)), "la": Claim(True, (0.09, 0.16))}),
    Experiment("paper_saturation", "end stops", ((85.0, 85.0), (110.0, 110.0)),
               {"ls": Claim(False, (0.30, 6.0)), "la": Claim(True, (0.085, 0.13))}),
)


@dataclasses.dataclass(frozen=True)
class Settings:
    """What the drives and the monitor were set to, as far as the report tells it."""
    period: float  # [s] between samples
    first_row: float  # [s] 2 L T, when the integral filter is full
    warn: float  # share of the damping lost, for WARN and for ERROR
    error: float
    noise: float  # [m/s^2] standard deviation of either sensor


def read_settings(folder):
    """From the YAML files that the launch file loads."""
    monitor, paper, simulator = (yaml.safe_load((folder / f"{name}.yaml").read_text())
                                 for name in ("monitor", "paper", "simulator"))
    health = {**monitor["health"], **paper.get("health", {})}
    period = paper["sample_period"]
    return Settings(period, 2 * paper["horizon_samples"] * period, health["damping_warn"], health["damping_error"],
                    simulator["noise"])


class RunFailed(Exception):
    """A program that the demo started did not do its work."""


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


@dataclasses.dataclass(frozen=True)
class Drive:
    """One drive through the nodelets: what roslaunch is told, how long it usually takes [s], where it is recorded."""
    name: str
    launch_file: str
    arguments: tuple
    usual_time: float
    bag: pathlib.Path


def paper_drive(scenario, bag, seed, factor):
    """One of the paper's experiments, `factor` times faster than the wall clock."""
    arguments = (f"scenario:={scenario}", f"seed:={seed}", f"duration:={DURATION:g}", f"real_time_factor:={factor:g}")
    return Drive(scenario, "paper.launch", arguments, DURATION / factor + START_AND_END, bag)


@contextlib.contextmanager
def launched(drive, folder):
    """roslaunch of one drive with a master of its own; ends it, whatever happens."""
    folder.mkdir(parents=True, exist_ok=True)
    drive.bag.unlink(missing_ok=True)
    environment = {name: value for name, value in os.environ.items() if name != "ROS_LOG_DIR"}
    environment["ROS_HOME"] = str(folder)
    command = ["roslaunch", "-p", str(free_port()), "suspension_health_monitor", drive.launch_file, *drive.arguments,
               "shutdown_at_end:=true", f"record:={drive.bag}"]
    with open(folder / "roslaunch.log", "w") as log:
        process = subprocess.Popen(command, env=environment, stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                                   start_new_session=True)
        try:
            yield process
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                try:
                    process.wait(15)
                except subprocess.TimeoutExpired:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()


def run_drives(drives, folder, progress):
    """All at the same time; each into its bag.

    @throws RunFailed  naming the drive and its log.
    """
    start = time.monotonic()
    usual = max(drive.usual_time for drive in drives)
    with contextlib.ExitStack() as stack:
        runs = {drive: stack.enter_context(launched(drive, folder / drive.name)) for drive in drives}
        while any(run.poll() is None for run in runs.values()):
            elapsed = time.monotonic() - start
            if elapsed > usual + GRACE:
                break
            progress.update(min(elapsed / usual, 0.99))
            time.sleep(0.1)
    for drive, run in runs.items():
        if run.returncode != 0 or not drive.bag.is_file():
            raise RunFailed(f"{drive.name}: roslaunch ended with status {run.returncode} and "
                            f"{'a' if drive.bag.is_file() else 'no'} recording, "
                            f"see {folder / drive.name / 'roslaunch.log'}")
