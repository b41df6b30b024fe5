"""One drive with an effect that the model lacks: through the nodelets, recorded, and searched for what is missing."""
import dataclasses
import html
import json
import subprocess

import yaml

from .accuracy import find_program
from .experiments import Drive, RunFailed
from .page import Section
from .table import Column, Table

DURATION = 60.0  # [s]
NAME = "hidden_effect"
EFFECT = "coulomb_friction"
SIZES = {"coefficient": 0.35, "vs": 0.02}  # [m/s^2], [m/s]
# What the simulator is told beside the launch file's arguments. The effect is in its parameters and in ~truth only.
SETTINGS = {"vehicle": "rover", "rate": 100.0, "noise": 0.024, "effects": {EFFECT: SIZES}}
PAGE_FOLDER = "effect_report"  # beside the demo's page


@dataclasses.dataclass(frozen=True)
class Search:
    """What `suspension_bag diagnose` found, as --json has it, and the first line of what it printed."""
    result: dict
    sentence: str


def drive(bag, seed, folder):
    """The drive, its readings of both IMUs to be recorded into `bag`."""
    folder.mkdir(parents=True, exist_ok=True)
    settings = folder / "simulator.yaml"
    settings.write_text(yaml.safe_dump(SETTINGS))
    arguments = ("scenario:=iso_road", f"simulator_config:={settings}", f"seed:={seed}", f"duration:={DURATION:g}",
                 "record_topics:=/sprung/imu /unsprung/imu")
    return Drive(NAME, "simulation.launch", arguments, bag)


def search(bag, output, folder):
    """Searches the drive; the page lands in output / PAGE_FOLDER. @throws RunFailed"""
    result = folder / "diagnose.json"
    command = [find_program(), "diagnose", bag, "--json", result, "--report", output / PAGE_FOLDER]
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        raise RunFailed(f"{' '.join(map(str, command))}: status {done.returncode}: {done.stderr.strip()}")
    verdict = done.stdout.split("\n\n")[1].splitlines()[0]  # behind what the bag holds
    return Search(json.loads(result.read_text()), verdict)


def ladder(found):
    """Error step by step, on parts of the drive that no fit has seen."""
    result = found.result
    steps = [("model as it is", result["base"]["held_out_rmse"])]
    if "extended" in result:
        steps.append((f"with {' and '.join(result['selected'])}", result["extended"]["held_out_rmse"]))
    steps.append(("noise floor, about", result["noise_floor"]))
    return Table("The error, step by step", [Column("model", css="text"), Column("held-out rmse", "m/s²")],
                 [(name, f"{rmse:.4f}") for name, rmse in steps])


def sizes_found(found):
    extended = found.result.get("extended")
    if extended is None or EFFECT not in extended["coefficients"]:
        return ""
    return (f" Its size: hidden {SIZES['coefficient']:g} m/s², found {extended['coefficients'][EFFECT]:.3f} "
            f"± {extended['stddevs'][EFFECT]:.3f} m/s².")


def pointer(found):
    """One sentence with the way to the page of the search."""
    return (f'In a drive with a hidden effect: {html.escape(found.sentence)} <a href="{PAGE_FOLDER}/report.html">The whole '
            "search as a page</a>.")


def section(found):
    """The search in a few words, and the way to its own page."""
    return Section("Which effect is missing?", (
        f"A rover drives {DURATION:g} s over a rough track. Its strut has dry friction, of which the model knows "
        "nothing. From the recorded readings of the two IMUs alone <code>suspension_bag diagnose</code> adds every effect "
        "that it knows to the model and judges by parts of the drive that it has not fitted.",
        f"<b>{html.escape(found.sentence)}</b>{sizes_found(found)}",
        f'<a href="{PAGE_FOLDER}/report.html">The whole search as a page to look at</a>: measured against predicted, '
        "what is missing over the motion of the strut, all candidates, and how to add the effect."),
        tables=(ladder(found),))
