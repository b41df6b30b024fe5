#!/usr/bin/env python3
"""How often inspect fails a healthy vehicle, and finds the damper that has lost half.

    source devel/setup.bash && benchmark/inspect_table.py [--vehicles 100] [--seed 1] [--only healthy|worn]

Every vehicle is a model of the simulator with a payload of up to 30 % that stands off the middle by up to 5 % of the
track, a tyre of up to twice the stiffness, 8 to 25 m/s on road B to D, 60 to 120 s at 100 to 200 Hz. half_sedan has no
axle with two wheels, so that it is not among the worn ones.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import tempfile

import numpy as np

from suspension_health_monitor.fleet.options import find_program

# By model: mass [kg], inertias about pitch and roll [kg m^2], and by strut y [m] and the tyre [N/m].
CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
MODELS = {
    "sedan": ((1350.0, 2100.0, 480.0), dict(zip(CORNERS, ((0.75, 205e3), (-0.75, 205e3), (0.73, 205e3), (-0.73, 205e3))))),
    "ugv": ((24.0, 1.1, 0.75), dict(zip(CORNERS, ((0.27, 9e3), (-0.27, 9e3), (0.27, 9e3), (-0.27, 9e3))))),
    "truck": ((6500.0, 24000.0, 6000.0),
              dict(zip(CORNERS, ((1.0, 850e3), (-1.0, 850e3), (0.93, 1700e3), (-0.93, 1700e3))))),
    "half_sedan": ((675.0, 800.0, 0.0), {"front": (0.0, 205e3), "rear": (0.0, 205e3)}),
}


def arguments_of(random, model, worn):
    """@return arguments of simulate for a random vehicle and drive."""
    masses, struts = MODELS[model]
    load, tyre, aside = random.uniform(1.0, 1.3), random.uniform(1.0, 2.0), random.uniform(-0.05, 0.05)
    settings = dict(zip(("mass", "pitch_inertia", "roll_inertia"), (load * mass for mass in masses)))
    settings.update(seed=int(random.integers(1, 10**6)), speed=random.uniform(8.0, 25.0), iso_class=random.choice(list("BCD")))
    for name, (y, stiffness) in struts.items():
        settings[f"struts/{name}/tyre_stiffness"] = tyre * stiffness
        if y:
            settings[f"struts/{name}/y"] = y + aside * abs(y)
    if worn:
        settings[f"struts/{worn}/damping_end_fraction"] = 0.5
    arguments = ["--vehicle-model", model, "--duration", f"{random.uniform(60, 120):.0f}", "--rate",
                 str(random.choice([100, 125, 160, 200]))]
    return arguments + [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]


def inspected(program, arguments, folder):
    """@return exit status, and what inspect tells; nothing where it tells nothing."""
    bag, vehicle, found = folder / "drive.bag", folder / "vehicle.yaml", folder / "found.json"
    found.unlink(missing_ok=True)
    subprocess.run([program, "simulate", *arguments, "-o", bag, "--vehicle-file", vehicle], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    status = subprocess.run([program, "inspect", bag, "--vehicle", vehicle, "--json", found], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL).returncode
    return status, json.loads(found.read_text()) if found.exists() else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vehicles", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=("healthy", "worn"))
    options = parser.parse_args()
    program = find_program()
    for kind in ("healthy", "worn"):
        if options.only not in (None, kind):
            continue
        counts, spread = collections.Counter(), []
        with tempfile.TemporaryDirectory() as folder:
            for i in range(options.vehicles):
                random = np.random.default_rng([options.seed, kind == "worn", i])
                model = str(random.choice([name for name in MODELS if kind == "healthy" or len(MODELS[name][1]) == 4]))
                worn = str(random.choice(CORNERS)) if kind == "worn" else None
                arguments = arguments_of(random, model, worn)
                status, told = inspected(program, arguments, pathlib.Path(folder))
                failed = [number for number in told["numbers"] if number["verdict"] == "fails"] if told else []
                accused = {number.get("weaker", number["struts"][0]) for number in failed}
                verdict = {0: "passes", 1: "fails", 4: "cannot tell"}.get(status, f"status {status}")
                if status == 1 and worn:
                    verdict += " at the right corner" if accused == {worn} else " at a wrong corner"
                counts[verdict] += 1
                if verdict not in ("passes", "fails at the right corner"):
                    print(kind, i, model, worn, verdict, *arguments[2:6], *(
                        f"{number['quantity']} {'/'.join(number['struts'])}: {number['sentence']}"
                        for number in (told or {"numbers": []})["numbers"] if number["verdict"] != "passes"), flush=True)
                spread += [number["value"] for number in (told or {"numbers": []})["numbers"]
                           if number["quantity"] == "damping_imbalance" and number["value"] is not None]
        print(f"{kind}: {dict(counts)}; damping imbalance in the median {np.median(spread):.3f}, at most {max(spread):.3f}")


if __name__ == "__main__":
    main()
