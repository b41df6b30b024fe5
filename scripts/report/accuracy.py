"""How far the estimates are from the truth, for one run and over many noise seeds."""
import concurrent.futures
import dataclasses
import os
import pathlib
import subprocess

import numpy

from .experiments import DURATION, RunFailed

SETTLED = 10.0  # [s] errors count after this time
ESTIMATORS = {"ls": "LS", "la": "LA"}
PARAMETERS = {"damping_to_mass": "b1", "stiffness_to_mass": "b0"}


@dataclasses.dataclass(frozen=True)
class Accuracy:
    """Errors of (b1 [1/s], b0 [1/s^2])."""
    rms: tuple
    largest: tuple


def accuracy(time, estimates, truths):
    """estimates, truths: one column per parameter over `time` [s]; counts what is settled."""
    counted = (time > SETTLED) & (time <= DURATION + 1e-6)
    errors = [(estimate - truth)[counted] for estimate, truth in zip(estimates, truths)]
    return Accuracy(tuple(float(numpy.sqrt(numpy.mean(error**2))) for error in errors),
                    tuple(float(numpy.max(numpy.abs(error))) for error in errors))


def recording_accuracy(recording):
    """{estimator: Accuracy} of what the nodelets published."""
    result = {}
    for estimator in ESTIMATORS:
        rows = getattr(recording, estimator)
        result[estimator] = accuracy(rows.time, [rows[parameter] for parameter in PARAMETERS],
                                     [recording.true_value(parameter, rows.time) for parameter in PARAMETERS])
    return result


def ramp_lag(recording, estimator):
    """How far the estimate of b1 runs behind while the damping falls [s]."""
    rows = getattr(recording, estimator)
    truth = recording.true_value("damping_to_mass", rows.time)
    rate = numpy.gradient(truth, rows.time)
    falling = rate < 0.5 * rate.min()
    return float(numpy.mean((rows.damping_to_mass - truth)[falling]) / -numpy.mean(rate[falling]))


def find_program(name="suspension_bag"):
    """A program of the workspace that is set up."""
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        program = pathlib.Path(prefix) / "lib/suspension_health_monitor" / name
        if program.is_file():
            return program
    raise RunFailed(f"{name} is not built in any workspace on CMAKE_PREFIX_PATH: source its setup.bash")


def run(command):
    finished = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True, stdin=subprocess.DEVNULL)
    if finished.returncode != 0:
        raise RunFailed(f"{' '.join(map(str, command))} ended with status {finished.returncode}: "
                        f"{finished.stderr.strip()[-500:]}")


def seed_accuracy(program, config, folder, scenario, seed, recording):
    """{estimator: Accuracy} of one noise seed by the command line; the truth, the same for each, from the recording."""
    bag, table = folder / f"{scenario}_{seed}.bag", folder / f"{scenario}_{seed}.csv"
    try:
        run([program, "simulate", "--scenario", scenario, "--seed", seed, "--duration", f"{DURATION:g}", "-o", bag])
        run([program, "identify", bag, "--config", config, "--csv", table])
        rows = numpy.genfromtxt(table, delimiter=",", names=True)
    finally:
        bag.unlink(missing_ok=True)
        table.unlink(missing_ok=True)
    truths = [recording.true_value(parameter, rows["time"]) for parameter in PARAMETERS]
    return {estimator: accuracy(rows["time"], [rows[f"{estimator}_{parameter}"] for parameter in PARAMETERS], truths)
            for estimator in ESTIMATORS}


def median(accuracies):
    """The median of each figure by itself."""
    return Accuracy(*(tuple(numpy.median([getattr(each, name) for each in accuracies], axis=0).tolist())
                      for name in ("rms", "largest")))


def seed_medians(program, config, folder, recordings, seeds, progress):
    """{scenario: {estimator: Accuracy}}: medians over the noise seeds, as many at a time as there are processors."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {scenario: [] for scenario in recordings}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        tasks = {pool.submit(seed_accuracy, program, config, folder, scenario, seed, recording): scenario
                 for scenario, recording in recordings.items() for seed in seeds}
        try:
            for done, task in enumerate(concurrent.futures.as_completed(tasks), 1):
                found[tasks[task]].append(task.result())
                progress.update(done / len(tasks))
        except BaseException:
            for task in tasks:
                task.cancel()
            raise
    return {scenario: {estimator: median([each[estimator] for each in accuracies]) for estimator in ESTIMATORS}
            for scenario, accuracies in found.items()}
