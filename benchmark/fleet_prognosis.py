#!/usr/bin/env python3
"""How right the prognosis is on fleets whose truth is known: the figures of doc/fleet_prognosis.md.

    source devel/setup.bash && benchmark/fleet_prognosis.py STRUTS SEED [ROW...]
"""
import dataclasses
import sys

import numpy as np

from suspension_health_monitor.fleet import change_points
from suspension_health_monitor.fleet.history import MONTH, YEAR, StrutHistory
from suspension_health_monitor.fleet.part_wear import Options
from suspension_health_monitor.fleet.prognosis import prognosis
from suspension_health_monitor.fleet.view import view

BEGIN = 1.6e9  # [s since 1970]
LOOKS = 10  # at a history, as it grows
KINDS = ("healthy", "wearing", "repaired", "spring")


@dataclasses.dataclass
class Truth:
    """A strut that nobody has seen: what wears, how, and what hides it."""
    kind: str
    drives: int
    span: float  # [years]
    rate: float  # [1/year] of the part that wears
    first_new: int  # the first drive with a part that was new then
    worn_before: float  # share that was worn before the repair
    season: float  # amplitude
    scatter: float  # of damping between drives
    payload: float  # mean load over the empty mass, of the half of drives that are loaded
    law: float = 1.0  # wear goes with time to that power
    weather: float = 0.0  # scatter of damping that lasts for days

    def loss(self, elapsed):
        return np.minimum(self.rate * self.span * (elapsed / self.span) ** self.law, 0.9)

    def life(self, threshold):
        """[years] until the threshold."""
        return self.span * (threshold / (self.rate * self.span)) ** (1 / self.law) if self.rate else np.inf


def draw_truth(random, kind=None, **changed):
    kind = kind or random.choice(KINDS, p=[0.4, 0.35, 0.2, 0.05])
    drives = int(np.exp(random.uniform(np.log(10), np.log(201))))
    rate = 0.0 if kind == "healthy" else np.exp(random.uniform(np.log(0.005), np.log(0.05))) * YEAR / MONTH
    span = random.uniform(0.25, 3.0)
    first_new, worn_before = 0, 0.0
    if kind == "repaired":
        first_new, worn_before = int(random.integers(drives // 2, drives - 2)), random.uniform(0.15, 0.35)
        span = min(span, 0.25 / rate)
    elif rate:
        span = min(span, 0.5 / rate)
    return dataclasses.replace(Truth(kind, drives, span, rate, first_new, worn_before, random.rayleigh(0.03),
                                     random.uniform(0.005, 0.03), random.choice([0.0, 0.2, 0.4])), **changed)


def weather(random, time, stddev, days=5.0):
    """Scatter whose correlation falls by e in so many days."""
    value = np.empty(len(time))
    value[0] = random.standard_normal()
    for i, keeps in enumerate(np.exp(-np.diff(time) * 365.25 / days), start=1):
        value[i] = keeps * value[i - 1] + np.sqrt(1 - keeps ** 2) * random.standard_normal()
    return stddev * value


def make(random, truth):
    """What is measured of it."""
    time = np.sort(random.uniform(0, truth.span, truth.drives))
    time -= time[0]
    elapsed = time - time[truth.first_new]
    before = truth.worn_before + truth.rate * elapsed  # the old part had lost worn_before when the new one came
    part = np.log1p(-np.where(elapsed >= 0, truth.loss(np.abs(elapsed)), before))
    load = random.uniform(0, 2 * truth.payload, truth.drives) * (random.random(truth.drives) < 0.5)
    level = np.log([4.0, 60.0]) + 0.3 * random.standard_normal(2)
    damping = (level[0] - np.log1p(load) + truth.season * np.cos(2 * np.pi * time + random.uniform(0, 2 * np.pi))
               + truth.scatter * random.standard_normal(truth.drives) + weather(random, time, truth.weather))
    stiffness = level[1] - np.log1p(load)
    if truth.kind == "spring":
        stiffness += part
    else:
        damping += part
    stddevs = [median * np.exp(0.4 * random.standard_normal(truth.drives)) for median in (0.02, 0.01)]
    wrong = random.random(truth.drives) < 0.02
    damping += stddevs[0] * random.standard_normal(truth.drives) + wrong * 0.3 * random.standard_normal(truth.drives)
    stiffness += stddevs[1] * random.standard_normal(truth.drives)
    b1, b0 = np.exp(damping), np.exp(stiffness)
    return StrutHistory("vehicle", "strut", BEGIN + YEAR * time, b1, stddevs[0] * b1, b0, stddevs[1] * b0,
                        truth.drives * [""])


def cut(history, drives):
    """The first so many drives of it."""
    return dataclasses.replace(history, path=history.path[:drives], **{
        name: getattr(history, name)[:drives] for name in (
            "time", "damping_to_mass", "damping_to_mass_stddev", "stiffness_to_mass", "stiffness_to_mass_stddev")})


def told_changes(history, truth, options):
    """Sets of times, as they are told at each of LOOKS, evenly over the drives; but not while a repair is so new that it
    cannot be told where it belongs."""
    for drives in (len(history.time) * look // LOOKS for look in range(1, LOOKS + 1)):
        if truth.kind == "repaired" and 0 < drives - truth.first_new < change_points.LEAST_DRIVES:
            continue
        seen = view(cut(history, drives), "damping", options.season)
        starts, _ = change_points.find(seen, options.false_changes)
        yield {seen.time[start] for start in starts[1:]}


@dataclasses.dataclass
class Tally:
    """Counts over struts of one kind."""
    struts: int = 0
    dates: int = 0  # told at all
    right: int = 0  # of those, intervals that hold the truth; a healthy strut's and the wrong part's hold none
    told: int = 0  # earliest dates: of all but those that have probably changed
    bounds: int = 0  # that the truth is not before
    years: float = 0.0
    false_changes: int = 0  # more than 3 drives from a repair, told at any of LOOKS
    repairs: int = 0
    found: int = 0  # of them repairs, within 3 drives

    def add(self, history, truth, options):
        result = prognosis(history, options)
        self.struts += 1
        self.years += truth.span
        near = set(history.time[max(0, truth.first_new - 3):truth.first_new + 4]) if truth.kind == "repaired" else set()
        self.false_changes += max(len(told - near) for told in told_changes(history, truth, options))
        part = "stiffness" if truth.kind == "spring" else "damping"
        true_date = history.time[truth.first_new] + YEAR * truth.life(options.threshold)
        if result.likely_change is None:
            self.told += 1
            self.bounds += result.wear[part].date[0] <= true_date
        if result.dated:
            early, _, late = result.wear[result.dated].date
            self.dates += 1
            self.right += result.dated == part and early <= true_date <= late
        if truth.kind == "repaired":
            soon = prognosis(cut(history, truth.first_new + 3), options)
            self.repairs += 1
            self.found += any(change.time in near for change in soon.changes)


def percent(part, whole):
    return f"{100 * part / whole:.1f}" if whole else "-"


ROWS = {
    "any": (None, {}), **{kind: (kind, {}) for kind in KINDS},
    "repaired-at-8-of-20": ("repaired", {"drives": 20, "first_new": 8}),
    "repaired-at-40-of-60": ("repaired", {"drives": 60, "first_new": 40}),
    "power-1.5": ("wearing", {"law": 1.5}), "power-0.7": ("wearing", {"law": 0.7}),
    "weather-healthy": ("healthy", {"weather": 0.02}), "weather-wearing": ("wearing", {"weather": 0.02}),
    "season-healthy": ("healthy", {"season": 0.08}), "season-wearing": ("wearing", {"season": 0.08}),
}
HEAD = """| struts | number | with a date | interval right [%] | earliest date right [%] | strut-years | \
false changes | repair found within 3 drives [%] |
|---|---|---|---|---|---|---|---|"""


def row(name, struts, seed, options=Options()):
    kind, changed = ROWS[name]
    random, tally = np.random.default_rng([seed, *name.encode()]), Tally()
    for _ in range(struts):
        truth = draw_truth(random, kind, **changed)
        tally.add(make(random, truth), truth, options)
    return (f"| {name} | {tally.struts} | {tally.dates} | {percent(tally.right, tally.dates)} | "
            f"{percent(tally.bounds, tally.told)} | {tally.years:.0f} | {tally.false_changes} | "
            f"{percent(tally.found, tally.repairs)} |")


if __name__ == "__main__":
    number, seed = int(sys.argv[1]), int(sys.argv[2])
    print(HEAD)
    for each in sys.argv[3:] or ROWS:
        print(row(each, number, seed), flush=True)
