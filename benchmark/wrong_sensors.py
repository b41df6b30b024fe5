#!/usr/bin/env python3
"""Sensors and vehicle files made wrong: is an estimate valid and wrong, is the cause named, and the mend?

    source devel/setup.bash && benchmark/wrong_sensors.py [--vehicles ugv,sedan,truck,half_sedan] [--cases REGEX]

Every case is a drive of 120 s of a simulated vehicle (own IMU at every strut top, or one IMU on the body) in which one
thing is wrong. Wrong is an estimate that is valid and more than 5 % and 4 standard deviations off.
"""
import argparse
import copy
import itertools
import json
import math
import pathlib
import re
import struct
import subprocess
import tempfile

import numpy as np
import rosbag
import yaml

from suspension_health_monitor.fleet.options import find_program

LEAST, SIGMAS = 0.05, 4.0


class Imu:
    """The bytes of one sensor_msgs/Imu, and where its numbers are in them."""

    def __init__(self, data):
        self.data = bytearray(data)
        frame = struct.unpack_from("<I", data, 12)[0]
        self.gyro = 16 + frame + 32 + 72
        self.acceleration = self.gyro + 24 + 72

    def vector(self, at):
        return np.array(struct.unpack_from("<3d", self.data, at))

    def put(self, at, vector):
        struct.pack_into("<3d", self.data, at, *vector)

    def delay(self, seconds):
        secs, nsecs = struct.unpack_from("<II", self.data, 4)
        total = secs * 10**9 + nsecs + round(seconds * 1e9)
        struct.pack_into("<II", self.data, 4, *divmod(total, 10**9))


def gain(factor):
    return lambda imu, t: imu.put(imu.acceleration, factor * imu.vector(imu.acceleration))


def late(seconds):
    return lambda imu, t: imu.delay(seconds)


def tilt(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])

    def change(imu, t):
        for at in (imu.acceleration, imu.gyro):
            imu.put(at, turn @ imu.vector(at))
    return change


def dead(axes, begin=0.0):
    def change(imu, t):
        if t < begin:
            return
        vector = imu.vector(imu.gyro)
        vector[list(axes)] = 0.0
        imu.put(imu.gyro, vector)
    return change


def cases(struts, body):
    """(name, {role: change, or the role whose data it carries}, change of the file, patterns of the cause and the mend)"""
    first, second, last = struts[0], struts[1], struts[-1]
    top = "body" if body else first + "/top"
    sides = len(struts) > 2
    for factor in (0.8, 0.9, 1.1, 1.25):
        for role in (top, first + "/wheel"):
            yield f"gain {factor} of {role}", {role: gain(factor)}, None, r"gravity|gain|scale", r"scale|gain|%"
    for degrees in (5, 10, 20, 30):
        for role in (top, first + "/wheel"):
            yield f"tilt {degrees} of {role}", {role: tilt(degrees)}, None, r"lean|tilt|degrees", r"axis|turn|frame|which way is up"
    for ms in (3, 10, 30):
        for role in (top, first + "/wheel"):
            yield f"{ms} ms late {role}", {role: late(ms / 1000)}, None, r"late|delay|clock", r"ms"
    for ms in (1, 3, 10, 30):
        all_wheels = {f"{strut}/wheel": late(ms / 1000) for strut in struts}
        yield f"{ms} ms late all wheels", all_wheels, None, r"late|delay|clock", r"ms"
    if body:
        axes = [("dead in x", dead((0,)))] if sides else []  # that nothing else rolls about
        for name, change in axes + [("dead", dead((0, 1, 2))), ("dead in y", dead((1,))),
                                    ("dies at 60 s", dead((0, 1, 2), 60.0))]:
            yield "gyro " + name, {"body": change}, None, r"gyro", r"gyro"

    def moved(axis, factor, names):
        def change(vehicle):
            for name in names:
                vehicle["struts"][name]["position"]["xy".index(axis)] *= factor
        return change
    for axis in ("x", "y") if sides else ("x",):
        if body:
            yield f"{axis} mirrored", {}, moved(axis, -1, struts), rf"positions|{axis}", rf"-{axis}|{axis}"
            yield f"{axis} of {first} by sign", {}, moved(axis, -1, [first]), rf"positions|{axis}", rf"-{axis}|{axis}"
            for factor in (0.85, 1.15):
                yield f"{axis} times {factor}", {}, moved(axis, factor, struts), "position", "position"
                yield f"{axis} of {first} times {factor}", {}, moved(axis, factor, [first]), "position", "position"

    def swapped(place, a, b):
        def change(vehicle):
            x, y = vehicle["struts"][a], vehicle["struts"][b]
            x[place], y[place] = y[place], x[place]
        return change

    for place in ("unsprung_imu",) if body else ("unsprung_imu", "sprung_imu"):
        for a, b in {(first, second), (first, last)}:
            yield f"{place} of {a} and {b} swapped", {}, swapped(place, a, b), "swap", "swap"
        role = "wheel" if place == "unsprung_imu" else "top"
        yield f"{role} of {first} twice", {f"{second}/{role}": f"{first}/{role}"}, None, "same data", "topic|IMU"

    def without(names):
        def change(vehicle):
            for name in names:
                del vehicle["struts"][name]
        return change
    if sides:
        rear = [name for name in struts if name.startswith("rear")]
        right = [name for name in struts if name.endswith("right")]
        for names in (rear, right, [last]):
            yield "without " + ", ".join(names), {}, without(names), "missing in the file", "missing"


def truth_of(bag):
    found = {}
    for topic, message, _ in bag.read_messages(topics=[t for t in bag.get_type_and_topic_info()[1]
                                                       if re.fullmatch("/simulator/.+/truth", t)]):
        found.setdefault(topic.split("/")[2], message)
    return found


def wrong_estimates(told, truth):
    """(valid, valid and wrong) over all struts."""
    valid, wrong = 0, []
    for name, strut in told.get("struts", {}).items():
        estimate = strut["estimate"]
        if not estimate["valid"]:
            continue
        valid += 1
        for key, label in (("damping_to_mass", "b1"), ("stiffness_to_mass", "b0")):
            value, stddev, true = estimate[key], estimate[key + "_stddev"], getattr(truth[name], key)
            if abs(value - true) > max(LEAST * true, SIGMAS * stddev):
                wrong.append(f"{name} {label} {100 * (value / true - 1.0):+.0f} % ({abs(value - true) / stddev:.0f} sd)")
    return valid, wrong


class Case:
    """A simulated vehicle, its drive and its file."""

    def __init__(self, program, folder, name, body):
        self.program, self.folder, self.name = program, folder, f"{name} by {'body' if body else 'own'} IMU"
        self.bag, file = folder / "drive.bag", folder / "vehicle.yaml"
        subprocess.run([program, "simulate", "--vehicle-model", name, *(["--set", "sprung_imus=none"] if body else []),
                        "--vehicle-file", file, "-o", self.bag], check=True, stdout=subprocess.DEVNULL)
        self.vehicle = yaml.safe_load(file.read_text())
        if not body:
            del self.vehicle["body_imu"]
        with rosbag.Bag(str(self.bag)) as bag:
            self.truth = truth_of(bag)
            self.messages = [message for message in bag.read_messages(raw=True) if "/simulator" not in message[0]]
        self.struts = list(self.vehicle["struts"])
        self.begin = self.messages[0][2]

    def topic(self, role):
        if role == "body":
            return "/imu/data"
        strut, place = role.split("/")
        return self.vehicle["struts"][strut]["sprung_imu" if place == "top" else "unsprung_imu"]

    def made_wrong(self, changes):
        if not changes:
            return self.bag
        by_topic = {self.topic(role): change for role, change in changes.items()}
        twins = {topic: (data for other, (_, data, *_), _ in self.messages if other == self.topic(change))
                 for topic, change in by_topic.items() if isinstance(change, str)}
        path = self.folder / "wrong.bag"
        with rosbag.Bag(str(path), "w") as bag:
            for topic, (kind, data, md5, *rest), stamp in self.messages:
                change = by_topic.get(topic)
                if isinstance(change, str):
                    data = next(twins[topic])
                elif change:
                    imu = Imu(data)
                    change(imu, (stamp - self.begin).to_sec())
                    data = bytes(imu.data)
                bag.write(topic, (kind, data, md5, *rest), stamp, raw=True)
        return path

    def told(self, changes, change_file):
        vehicle = copy.deepcopy(self.vehicle)
        if change_file:
            change_file(vehicle)
        file = self.folder / "wrong.yaml"
        file.write_text(yaml.safe_dump(vehicle))
        run = subprocess.run([self.program, "identify", self.made_wrong(changes), "--vehicle", file, "--json",
                              self.folder / "told.json"], capture_output=True, text=True)
        output = run.stdout + run.stderr
        written = self.folder / "told.json"
        told = json.loads(written.read_text()) if written.exists() else {}
        written.unlink(missing_ok=True)
        return told, output


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vehicles", default="ugv,sedan,truck,half_sedan")
    parser.add_argument("--cases", default="", help="those whose name this finds")
    parser.add_argument("--imus", default="own,body")
    parser.add_argument("--print", action="store_true", help="what identify says, too")
    options = parser.parse_args()
    program = find_program()
    count = wrong = named = mended = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, imus in itertools.product(options.vehicles.split(","), options.imus.split(",")):
            case = Case(program, pathlib.Path(folder), name, imus == "body")
            for label, changes, change_file, cause, mend in cases(case.struts, imus == "body"):
                if not re.search(options.cases, label):
                    continue
                told, output = case.told(changes, change_file)
                valid, off = wrong_estimates(told, case.truth)
                said = "\n".join(line for line in output.splitlines()
                                 if re.search("warning: |suspension_bag identify: |leans by", line) and
                                 re.search(cause, line, re.I))
                says_mend = bool(said) and bool(re.search(mend, said, re.I))
                count, wrong, named, mended = count + 1, wrong + bool(off), named + bool(said), mended + says_mend
                print(f"{case.name:24} {label:36} {valid} valid  {'named' if said else '-':5}  "
                      f"{'mend' if says_mend else '-':4}  {'; '.join(off)}", flush=True)
                if options.print:
                    print(output)
    print(f"{count} cases: {wrong} valid and wrong, cause named in {named}, mend in {mended}")


if __name__ == "__main__":
    main()
