#!/usr/bin/env python3
"""What Python adds to the cost of a search and of a stream, in processor time: the figures of doc/python.md.

    source devel/setup.bash && benchmark/python_cost.py
"""
import os
import pathlib
import subprocess
import tempfile

import numpy as np
import suspension_health_monitor as shm

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
RUNS = 3  # the least of them: what else runs on the machine only adds
SAMPLES = 1000000


def seconds(work):
    """Of a processor, children included."""
    def spent():
        return sum(os.times()[:4])
    times = []
    for _ in range(RUNS):
        before = spent()
        work()
        times.append(spent() - before)
    return min(times)


def searches(folder):
    bag = folder / "drive.bag"
    road = {"scenario": "iso_road", "vehicle": "ugv", "rate": 100, "effect": "quadratic_damping=1.6"}
    shm.simulate(bag, **road)
    drive = shm.simulate(**road)
    program = [REPOSITORY / "devel/lib/suspension_health_monitor/suspension_bag", "diagnose", bag, "--threads", "1"]
    yield "`suspension_bag diagnose`", seconds(lambda: subprocess.run(program, stdout=subprocess.DEVNULL, check=True))
    yield "`shm.diagnose` of the bag", seconds(lambda: shm.diagnose(bag, threads=1))
    yield "`shm.diagnose` of arrays", seconds(lambda: shm.diagnose(drive, threads=1))


def stream(stamps, body, wheel, length):
    monitor = shm.StrutMonitor(sample_period=0.001)
    for k in range(0, len(stamps), length):
        monitor.push(stamps[k:k + length], body[k:k + length], wheel[k:k + length])
    assert monitor.input.samples == len(stamps)


def streams():
    def yardstick():
        text = subprocess.run([REPOSITORY / "devel/lib/suspension_health_monitor/push_readings", str(SAMPLES)], stdout=subprocess.PIPE, check=True,
                              encoding="utf-8").stdout
        return float(text.split()[0])
    yield "C++", max(yardstick() for _ in range(RUNS))
    drive = shm.simulate(scenario="iso_road", vehicle="ugv", rate=100)
    body, wheel = (np.resize(each, SAMPLES) for each in (drive.body, drive.wheel))
    stamps = np.arange(1, SAMPLES + 1) * 1000000
    for length in (SAMPLES, 1000, 100, 10):
        name = "one array" if length == SAMPLES else f"arrays of {length}"
        yield name, SAMPLES / seconds(lambda length=length: stream(stamps, body, wheel, length))


with tempfile.TemporaryDirectory() as scratch:
    print("| search of 120 s at 100 Hz, one thread | s |\n|---|---|")
    for what, time in searches(pathlib.Path(scratch)):
        print(f"| {what} | {time:.2f} |")
print("\n| `StrutMonitor.push` | samples/s |\n|---|---|")
for what, rate in streams():
    print(f"| {what} | {rate:.2g} |")
