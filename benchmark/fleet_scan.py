#!/usr/bin/env python3
"""What suspension_fleet scan costs: a table for doc/fleet.md. Needs a sourced workspace, and cores that nobody else uses.

    benchmark/fleet_scan.py [--bags 200] [--many 2000] [--work DIR]
"""
import argparse
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

from suspension_health_monitor.fleet.options import find_program

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
DRIVES = 4  # that are simulated; the others are copies, which differ in the padding of their header


def cost(*command, cwd):
    """(wall time, processor time, largest memory of a process [kB]) of a command with its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    measured = subprocess.run(["/usr/bin/time", "-f", "%M", *map(str, command)], cwd=cwd, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if measured.returncode != 0:
        sys.exit(measured.stderr)
    return (wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            int(measured.stderr.splitlines()[-1]), measured.stdout.splitlines()[0])


def copies(bases, folder, count):
    folder.mkdir(parents=True)
    contents = [base.read_bytes() for base in bases]
    for number in range(count):
        content = contents[number % len(contents)]
        padding = content.index(b" " * 8)
        with open(folder / f"{number}.bag", "wb") as file:
            file.write(content[:padding] + b"%08d" % number)
            file.write(content[padding + 8:])


def corrupt(folder, base):
    """Five bags that are none."""
    content = base.read_bytes()
    (folder / "cut.bag").write_bytes(content[:len(content) // 2])
    (folder / "beginning.bag").write_bytes(content[:5000])
    (folder / "empty.bag").touch()
    (folder / "text.bag").write_text("no bag\n")
    (folder / "zeros.bag").write_bytes(content[:4096] + bytes(100000))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bags", type=int, default=200, help="of 120 s at 100 Hz, four struts; five are corrupt")
    parser.add_argument("--many", type=int, default=2000, help="short ones, for the client's memory")
    parser.add_argument("--work", type=pathlib.Path, help="for 10 MB a bag, deleted again")
    options = parser.parse_args()
    program = find_program()
    fleet = [sys.executable, REPOSITORY / "python/suspension_fleet", "scan"]
    if options.work:
        options.work.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.work) as folder:
        folder = pathlib.Path(folder)
        bases = [folder / f"base_{seed}.bag" for seed in range(DRIVES)]
        for seed, base in enumerate(bases):
            subprocess.run([program, "simulate", "--vehicle-model", "sedan", "--seed", str(seed), "--vehicle-file",
                            folder / "vehicle.yaml", "-o", base], check=True, stdout=subprocess.DEVNULL)
        copies(bases, folder / "bags", options.bags - 5)
        corrupt(folder / "bags", bases[0])
        vehicle = ["--vehicle-file", "vehicle.yaml"]
        alone = [cost(program, command, base, "--vehicle", "vehicle.yaml", cwd=folder)[1]
                 for command in ("identify", "health") for base in bases]
        identify, health = sum(alone[:DRIVES]) / DRIVES, sum(alone[DRIVES:]) / DRIVES
        print(f"processor time of identify {identify:.3f} s, of health {health:.3f} s a bag")
        walls = {}
        for workers in (1, 2):
            wall, used, memory, told = cost(*fleet, "bags", "--db", f"sqlite:///{workers}.db", "--workers", workers, *vehicle,
                                            cwd=folder)
            walls[workers] = wall
            print(f"{workers} workers: {wall:.1f} s, {wall / options.bags:.3f} s a bag, processor time {used / options.bags:.3f} s "
                  f"a bag, {used / options.bags - identify:.3f} s over identify; {told}")
        print(f"two workers are {walls[1] / walls[2]:.2f} times as fast as one")
        wall, used, _, told = cost(*fleet, "bags", "--db", "sqlite:///2.db", *vehicle, cwd=folder)
        print(f"again: {wall:.1f} s; {told}; database {os.path.getsize(folder / '2.db') / options.bags / 1000:.1f} kB a bag")
        subprocess.run([program, "simulate", "--duration", "8", "-o", folder / "short.bag"], check=True,
                       stdout=subprocess.DEVNULL)
        for count in (options.many // 10, options.many):
            copies([folder / "short.bag"], folder / f"short_{count}", count)
            wall, used, memory, told = cost(*fleet, f"short_{count}", "--db", f"sqlite:///short_{count}.db", cwd=folder)
            print(f"client's memory {memory / 1000:.1f} MB, {used / count:.3f} s of processor time a bag; {told}")


if __name__ == "__main__":
    main()
