"""What a simulated fleet is like: how its struts wear and are repaired, its payload, its seasons, its bad bags.

Everything follows from the seed, before any bag is written: so a simulation that was ended goes on where it was.
"""
import dataclasses
import math
from typing import Any, Dict, List, Optional

import numpy as np

from .errors import UsageError
from .history import MONTH, YEAR
from .ranged import Ranged, option

DAY = 86400.0  # [s]
LEAST = 0.05   # share of damping or stiffness below which nothing wears
BAD = ("cut_off", "empty", "no_bag", "parked")

# A robot of our own: struts of 1.9 and 2.2 Hz with damping ratios of 0.31 and 0.35, wheel hop 12 Hz, on a bad road.
ROBOT = {
    "mass": 60.0, "pitch_inertia": 5.0, "roll_inertia": 3.2, "iso_class": "D", "speed": 3.0,
    "struts": {
        "front_left": {"x": 0.42, "y": 0.35, "z": 0.1},
        "front_right": {"x": 0.42, "y": -0.35, "z": 0.1},
        "rear_left": {"x": -0.36, "y": 0.35, "z": 0.1},
        "rear_right": {"x": -0.36, "y": -0.35, "z": 0.1}},
    "body_imu": {"x": -0.05, "y": 0.02, "z": 0.15}}
_FRONT = {"damping": 78.0, "stiffness": 1500.0, "wheel_mass": 2.6, "tyre_stiffness": 16000.0, "tyre_damping": 10.0}
_REAR = dict(_FRONT, damping=95.0, stiffness=1900.0)
for _name, _strut in ROBOT["struts"].items():
    _strut.update(_FRONT if _name.startswith("front") else _REAR)


@dataclasses.dataclass(frozen=True)
class Laws(Ranged):
    """What a fleet is made by.

    :raises UsageError: a value that is not allowed.
    """
    start: float = option(0.0, 0.0, 4e9, "[s] since 1970, of the first day")
    seed: int = option(1, 0, 2**31 - 1, "same options and seed, same fleet")
    days: int = option(8, 1, 100000, "how many days there are")
    every: int = option(1, 1, 100000, "[days] from a drive of a vehicle to its next")
    wearing: float = option(0.3, 0, 1, "share of struts whose damper wears")
    sagging: float = option(0.1, 0, 1, "share of struts whose spring sags")
    least_wear: float = option(0.005, 1e-6, 10, "[1/month] of damping or stiffness that such a strut loses at least")
    most_wear: float = option(0.05, 1e-6, 10, "[1/month] at most; between them evenly by the logarithm")
    repair_at: float = option(0.4, 0.001, 1, "loss at which a strut gets a new damper and spring")
    payload: float = option(0.1, 0, 1, "standard deviation of the logarithm of the body's mass over drives")
    season: float = option(10.0, 0, 50, "[K] that summer is warmer, and winter colder, than 15 deg C")
    damping_per_kelvin: float = option(-0.003, -0.01, 0.01, "[1/K] of the damping")
    tolerance: float = option(0.05, 0, 1, "standard deviation of the logarithm of new dampers and springs")
    bad: float = option(0.02, 0, 1, "share of bags that are cut off, empty, no bag at all, or of a vehicle that stands")

    def __post_init__(self):
        super().__post_init__()
        if self.least_wear > self.most_wear:
            raise UsageError(f"--least-wear {self.least_wear:g}, must be at most --most-wear {self.most_wear:g}")


@dataclasses.dataclass
class DriveTruth:
    """One drive of a vehicle."""
    start: float
    payload: float                 # mass of the body over that of the model
    temperature: float             # [deg C]
    bad: Optional[str]             # of BAD
    seed: int
    struts: Dict[str, Dict[str, float]]  # damping and stiffness as shares of the model's


@dataclasses.dataclass
class StrutTruth:
    """Losses [1/month] and when it was repaired [s since 1970]."""
    damping_loss: float
    stiffness_loss: float
    repairs: List[float] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class VehicleTruth:
    struts: Dict[str, StrutTruth]
    drives: List[DriveTruth]


def fleet(model, laws, vehicles):
    """{name: VehicleTruth}."""
    digits = len(str(vehicles))
    return {f"robot_{number:0{digits}}": _vehicle(model, laws, np.random.default_rng([laws.seed, number]))
            for number in range(1, vehicles + 1)}


def _vehicle(model, laws, random):
    struts = {name: StrutTruth(_loss(laws, laws.wearing, random), _loss(laws, laws.sagging, random))
              for name in model["struts"]}
    new = {name: _new_strut(laws, random) for name in struts}
    since = {name: laws.start for name in struts}
    drives = []
    for day in range(0, laws.days, laws.every):
        time = laws.start + day * DAY + random.uniform(8, 18) * 3600.0
        for name, strut in struts.items():
            if max(strut.damping_loss, strut.stiffness_loss) * (time - since[name]) / MONTH >= laws.repair_at:
                since[name] = laws.start + day * DAY
                strut.repairs.append(since[name])
                new[name] = _new_strut(laws, random)
        drives.append(_drive(laws, time, struts, new, since, random))
    return VehicleTruth(struts, drives)


def _loss(laws, share, random):
    wear = math.exp(random.uniform(math.log(laws.least_wear), math.log(laws.most_wear)))
    return wear if random.random() < share else 0.0


def _new_strut(laws, random):
    damping, stiffness = np.exp(laws.tolerance * random.standard_normal(2))
    return {"damping": float(damping), "stiffness": float(stiffness)}


def _drive(laws, time, struts, new, since, random):
    # Coldest in the middle of January, as the temperature of the air in the northern hemisphere.
    temperature = 15.0 - laws.season * math.cos(2 * math.pi * (time - 15 * DAY) / YEAR)
    temperature += random.normal(0.0, 0.2 * laws.season)
    warm = 1.0 + laws.damping_per_kelvin * (temperature - 15.0)

    def left(name, loss):
        return max(LEAST, 1.0 - loss * (time - since[name]) / MONTH)

    shares = {name: {"damping": warm * new[name]["damping"] * left(name, strut.damping_loss),
                     "stiffness": new[name]["stiffness"] * left(name, strut.stiffness_loss)}
              for name, strut in struts.items()}
    payload = math.exp(laws.payload * random.standard_normal())
    bad = BAD[random.integers(len(BAD))] if random.random() < laws.bad else None
    return DriveTruth(time, payload, temperature, bad, int(random.integers(1 << 31)), shares)


def vehicle_of_drive(model, drive):
    """The model of `suspension_bag simulate` as the vehicle is on that drive: payload makes all of the body heavier."""
    result: Dict[str, Any] = dict(model)
    for name in ("mass", "pitch_inertia", "roll_inertia"):
        if name in model:
            result[name] = float(model[name]) * drive.payload
    result["struts"] = {name: {**strut, **{number: float(strut[number]) * share
                                           for number, share in drive.struts[name].items()}}
                        for name, strut in model["struts"].items()}
    return result


def strut_numbers(vehicle):
    """{strut: (b1 [1/s], b0 [1/s^2])} of a vehicle's model: damping and stiffness times what a force at its top does to
    that top, 1/M + x^2/Iyy + y^2/Ixx."""
    def share(coordinate, inertia):
        return coordinate ** 2 / inertia if coordinate else 0.0
    result = {}
    for name, strut in vehicle["struts"].items():
        softness = (1.0 / vehicle["mass"] + share(float(strut["x"]), vehicle.get("pitch_inertia", 0.0))
                    + share(float(strut["y"]), vehicle.get("roll_inertia", 0.0)))
        result[name] = (strut["damping"] * softness, strut["stiffness"] * softness)
    return result
