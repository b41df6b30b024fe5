"""The paper's experiments: what they are, and how they run through the nodelets."""
import contextlib
import dataclasses
import os
import pathlib
import signal
import subprocess
import time

import yaml

from .ports import held_port

DURATION = 120.0  # [s] of one drive
LAST_WORDS = 2000  # characters of a log that say why a program ended
STUCK = 1200.0  # [s] wall time that no drive takes, even where the machine is busy with other work


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


PAPER_HORIZON = 0.6  # [s] of `preset: paper`


def read_settings(folder):
    """From the YAML files that the launch file loads."""
    monitor, paper, simulator = (yaml.safe_load((folder / f"{name}.yaml").read_text())
                                 for name in ("monitor", "paper", "simulator"))
    health = {**monitor["health"], **paper.get("health", {})}
    period = paper["sample_period"]
    return Settings(period, 2 * PAPER_HORIZON, health["damping_warn"], health["damping_error"],
                    simulator["noise"])


class RunFailed(Exception):
    """A program that the demo started did not do its work."""


@dataclasses.dataclass(frozen=True)
class Drive:
    """One drive through the nodelets: what roslaunch is told, where it is recorded."""
    name: str
    launch_file: str
    arguments: tuple
    bag: pathlib.Path


def paper_drive(scenario, bag, seed):
    """One of the paper's experiments."""
    return Drive(scenario, "paper.launch", (f"scenario:={scenario}", f"seed:={seed}", f"duration:={DURATION:g}"), bag)


@contextlib.contextmanager
def launched(drive, folder):
    """roslaunch of one drive, as fast as it goes, with a master of its own; ends it, whatever happens."""
    folder.mkdir(parents=True, exist_ok=True)
    drive.bag.unlink(missing_ok=True)
    environment = {name: value for name, value in os.environ.items() if name != "ROS_LOG_DIR"}
    environment["ROS_HOME"] = str(folder)
    with held_port() as port, open(folder / "roslaunch.log", "w") as log:
        command = ["roslaunch", "-p", str(port), "suspension_health_monitor", drive.launch_file, *drive.arguments,
                   "real_time_factor:=0", "shutdown_at_end:=true", f"record:={drive.bag}"]
        process = subprocess.Popen(command, env=environment, stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                                   start_new_session=True)
        try:
            yield process
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                try:
                    process.wait(60)
                except subprocess.TimeoutExpired:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()


def run_drives(drives, folder, progress):
    """All at the same time; each into its bag.

    @throws RunFailed  naming the drive and its log.
    """
    deadline = time.monotonic() + STUCK
    with contextlib.ExitStack() as stack:
        runs = {drive: stack.enter_context(launched(drive, folder / drive.name)) for drive in drives}
        while any(run.poll() is None for run in runs.values()) and time.monotonic() < deadline:
            progress.update(sum(drive.bag.is_file() for drive in drives) / len(drives))
            time.sleep(0.1)
    for drive, run in runs.items():
        if run.returncode != 0 or not drive.bag.is_file():
            log = folder / drive.name / "roslaunch.log"
            raise RunFailed(f"{drive.name}: roslaunch ended with status {run.returncode} and "
                            f"{'a' if drive.bag.is_file() else 'no'} recording; {log} ends with\n"
                            f"{log.read_text(errors='replace')[-LAST_WORDS:]}")
