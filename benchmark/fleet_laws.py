#!/usr/bin/env python3
"""How right the prognosis is on struts whose laws are not the model's own: a table of doc/fleet_prognosis.md.

    source devel/setup.bash && benchmark/fleet_laws.py STRUTS SEED [LAW...]

Every law is a function of the time in years and of what drives are like: weather, halls, loads, cold oil, parts that run
in, saturate, break and are renewed. Estimates scatter by more than they state, with the tails of Student's t of 3.
"""
import dataclasses
import sys

import numpy as np

from suspension_health_monitor.fleet.history import YEAR, StrutHistory
from suspension_health_monitor.fleet.part_wear import Options
from suspension_health_monitor.fleet.prognosis import prognosis

BEGIN = 1.6e9  # [s since 1970]
DAY = 1 / 365.25  # [years]
THRESHOLD = Options().threshold


@dataclasses.dataclass
class Drives:
    """When and how a vehicle drives."""
    time: np.ndarray  # [years], rising from 0
    temperature: np.ndarray  # [deg C] of the air, with weather
    load: np.ndarray  # mass over that of the empty vehicle
    minutes: np.ndarray  # how long
    rested: np.ndarray  # [years] since the drive before


@dataclasses.dataclass
class Parts:
    """Of the new parts' damping and stiffness at every drive, and when a share of THRESHOLD is lost [years]."""
    damping: np.ndarray
    stiffness: np.ndarray
    part: str = "damping"  # that goes on wearing, if any does
    date: float = np.inf
    temperature_known: bool = False


def persistent(random, time, days):
    """Normal numbers whose correlation falls by e in so many days."""
    value = random.standard_normal(len(time))
    for i, keeps in enumerate(np.exp(-np.diff(time) / (days * DAY)), start=1):
        value[i] = keeps * value[i - 1] + np.sqrt(1 - keeps ** 2) * value[i]
    return value


def drive(random, span):
    """One to four drives on a driving day, and a gap of up to a fifth of the span."""
    days = np.unique(random.integers(0, int(span / DAY), int(np.exp(random.uniform(np.log(12), np.log(120))))))
    gap, length = random.uniform(0.1, 0.8) * span, random.uniform(0, 0.2) * span
    days = days[(days * DAY < gap) | (days * DAY > gap + length)]
    time = np.sort(np.concatenate([(day + random.uniform(0.3, 0.8, random.integers(1, 5))) * DAY for day in days]))
    time -= time[0]
    phase, swing = random.uniform(0, 2 * np.pi), random.uniform(8, 13)
    temperature = 10 + swing * np.cos(2 * np.pi * time + phase) + 4 * persistent(random, time, 4)
    loaded = persistent(random, time, random.choice([0.01, 20.0])) > random.uniform(-0.5, 0.5)  # by drive, or in runs
    load = 1 + loaded * random.uniform(0.1, 0.6) * random.uniform(0.5, 1.5, len(time))
    return Drives(time, temperature, load, np.exp(random.uniform(np.log(3), np.log(60), len(time))),
                  np.diff(time, prepend=-1.0))


# Laws that end, or never begin ---------------------------------------------------------------------------------------

def steady(random, drives):
    ones = np.ones(len(drives.time))
    return Parts(ones, ones)


def load_spring(random, drives):
    """A progressive spring; half of the vehicles come to carry more, or less, than at first: steadily, or from a day on."""
    share = drives.time / drives.time[-1]
    grows = share if random.random() < 0.5 else share > random.uniform(0.2, 0.8)
    trend = random.choice([0.0, 1.0]) * random.uniform(-0.3, 0.5) * grows
    drives.load = drives.load + np.maximum(trend, -0.5 * (drives.load - 1))
    return Parts(np.ones(len(drives.time)), drives.load ** random.uniform(0.2, 0.9))


def season(random, drives):
    return Parts(1 - random.uniform(0.003, 0.009) * (drives.temperature - 10), np.ones(len(drives.time)))


def season_with_temperature(random, drives):
    return dataclasses.replace(season(random, drives), temperature_known=True)


def hall_and_yard(random, drives):
    """Runs of days in a warm hall, or years and then outdoors for good, or the other way round."""
    inside = persistent(random, drives.time, random.choice([0.01, 5.0, 30.0, 200.0])) > 0
    drives.temperature = np.where(inside, 21.0, drives.temperature)
    return dataclasses.replace(season(random, drives), temperature_known=random.random() < 0.3)


def cold_starts(random, drives):
    """Oil is 20 to 30 % stiffer for some minutes, unless the vehicle has just driven; short drives have all of it, and
    there may be more and more of them."""
    drives.minutes = 2 + drives.minutes * np.exp(random.choice([0.0, -1.5, 1.0]) * drives.time / drives.time[-1])
    warm, cools = random.uniform(3, 10), 2 / 24 * DAY
    share = warm / drives.minutes * (1 - np.exp(-drives.minutes / warm)) * (1 - np.exp(-drives.rested / cools))
    return Parts(1 + random.uniform(0.2, 0.3) * share, np.ones(len(drives.time)))


def run_in(random, drives):
    settles = np.exp(-drives.time / (random.uniform(0.03, 0.35) * drives.time[-1]))
    return Parts(1 + random.uniform(0.05, 0.2) * settles, np.ones(len(drives.time)))


def saturates(random, drives):
    """At once, or ever slower."""
    end, share = random.uniform(0.1, 0.25), drives.time / drives.time[-1]
    until = random.uniform(0.2, 0.7)
    worn = np.minimum(share / until, 1) if random.random() < 0.5 else 1 - np.exp(-share / (until / 2))
    return Parts(1 - end * worn, np.ones(len(drives.time)))


def breaks(random, drives):
    """At once, and never again."""
    broken = drives.time > random.uniform(0.3, 0.9) * drives.time[-1]
    return Parts(1 - random.uniform(0.1, 0.25) * broken, np.ones(len(drives.time)))


# Laws that go on -----------------------------------------------------------------------------------------------------

def goes_on(random, drives, power=1.0, part="damping"):
    """10 to 35 % are lost by the last drive."""
    lost, last = random.uniform(0.1, 0.35), drives.time[-1]
    worn, ones = 1 - lost * (drives.time / last) ** power, np.ones(len(drives.time))
    date = last * (THRESHOLD / lost) ** (1 / power)
    return Parts(worn, ones, date=date) if part == "damping" else Parts(ones, worn, "stiffness", date)


def linear(random, drives):
    return goes_on(random, drives)


def linear_in_seasons(random, drives):
    worn = goes_on(random, drives)
    worn.damping = worn.damping * season(random, drives).damping
    return worn


def linear_with_temperature(random, drives):
    return dataclasses.replace(linear_in_seasons(random, drives), temperature_known=True)


def accelerating(random, drives):
    return goes_on(random, drives, random.uniform(1.3, 2.2))


def spring(random, drives):
    return goes_on(random, drives, part="stiffness")


def renewed(random, drives):
    """A worn damper is replaced, and the new one wears as fast."""
    rate, new = random.uniform(0.15, 0.5) / drives.time[-1], random.uniform(0.2, 0.7) * drives.time[-1]
    rate = min(rate, 0.5 / new)
    since = np.where(drives.time < new, drives.time, drives.time - new)
    return Parts(1 - rate * since, np.ones(len(drives.time)), date=new + THRESHOLD / rate)


ENDS = (steady, load_spring, season, season_with_temperature, hall_and_yard, cold_starts, run_in, saturates, breaks)
GOES_ON = (linear, linear_in_seasons, linear_with_temperature, accelerating, spring, renewed)


def make(random, law):
    """(history, Parts) of one strut."""
    drives = drive(random, random.uniform(0.3, 3.0))
    parts = law(random, drives)
    count = len(drives.time)
    stated = [median * np.exp(0.4 * random.standard_normal(count)) for median in (0.02, 0.01)]
    level = np.exp(np.log([4.0, 60.0]) + 0.3 * random.standard_normal(2))
    more = random.uniform(1.0, 2.5)
    b1, b0 = (new * part / drives.load * np.exp(more / np.sqrt(3) * stddev * random.standard_t(3, count))
              for new, part, stddev in zip(level, (parts.damping, parts.stiffness), stated))
    known = {"temperature": drives.temperature} if parts.temperature_known and HAS_TEMPERATURE else {}
    return StrutHistory("vehicle", "strut", BEGIN + YEAR * drives.time, b1, stated[0] * b1, b0, stated[1] * b0,
                        count * [""], **known), parts


HAS_TEMPERATURE = "temperature" in {field.name for field in dataclasses.fields(StrutHistory)}


def judge(random, law, options=Options()):
    """(whether there is a date, whether its interval holds the true one)."""
    history, parts = make(random, law)
    result = prognosis(history, options)
    if result.dated is None:
        return False, False
    early, _, late = result.wear[result.dated].date
    return True, result.dated == parts.part and early <= BEGIN + YEAR * parts.date <= late


def percent(part, whole):
    return f"{100 * part / whole:.1f}" if whole else "-"


def main(struts, seed, names):
    print("| law | struts | with a date | date inside its interval [%] |\n|---|---|---|---|")
    dated, inside = {}, {}
    for law in ENDS + GOES_ON:
        if names and law.__name__ not in names:
            continue
        random = np.random.default_rng([seed, *law.__name__.encode()])
        dated[law], inside[law] = map(sum, zip(*(judge(random, law) for _ in range(struts))))
        print(f"| {law.__name__} | {struts} | {dated[law]} | {percent(inside[law], dated[law])} |", flush=True)
    ended = [law for law in dated if law in ENDS]
    went_on = [law for law in dated if law in GOES_ON]
    print(f"healthy struts with a date: {percent(sum(dated[law] for law in ended), struts * len(ended))} %; "
          f"struts that go on wearing with a date: {percent(sum(dated[law] for law in went_on), struts * len(went_on))} %; "
          f"dates inside: {percent(sum(inside.values()), sum(dated.values()))} % of {sum(dated.values())}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
