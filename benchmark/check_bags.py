#!/usr/bin/env python3
"""Does `suspension_bag check` tell which IMU is which, however they are mounted and called?

    source devel/setup.bash && benchmark/check_bags.py [--bags 50] [--seed 1] [--from BAG...]

Every bag is a drive of 60 s of a simulated vehicle, of which some struts, each with its own IMU on the body or all with
one, are left. Every IMU is turned to one of 24 right angles, every topic gets a letter in random order. Half of the bags
have no gravity. Distractors: an IMU in the cabin of the same body, a phone that lies loose. A bag is right if all pairs
are, and no other is found, and all axes are; without gravity the sign of a pair's axes is free, as long as both agree.
--from takes the IMUs of these bags, whose topics end with sprung, unsprung and body/imu, instead.
"""
import argparse
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import rosbag
from sensor_msgs.msg import Imu

from suspension_health_monitor.fleet.options import find_program

MODELS = ["sedan", "ugv", "truck", "half_sedan"]
NAMES = ["x", "y", "z"]
LEVEL = np.array([0.0, 0.0, 9.81])  # gravity in the bags as they are [m/s^2]


def right_angles():
    """@return the 24 rotations that take axes to axes."""
    found = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            turn = np.zeros((3, 3))
            turn[range(3), order] = signs
            if np.linalg.det(turn) > 0.0:
                found.append(turn)
    return found


def up_axis(turn):
    """@return what the vehicle's z is called in the axes of an IMU that reads turn @ r."""
    axis = int(np.argmax(np.abs(turn[:, 2])))
    return ("-" if turn[axis, 2] < 0.0 else "") + NAMES[axis]


def read(path):
    """@return [(topic, message, time)] of the Imu topics."""
    with rosbag.Bag(str(path)) as bag:
        return [(topic, message, time) for topic, message, time in bag.read_messages()
                if message._type == "sensor_msgs/Imu"]


def simulated(program, folder, rng):
    model = rng.choice(MODELS)
    bag = folder / "drive.bag"
    subprocess.run([program, "simulate", "--vehicle-model", model, "--set", "duration=60", "--set",
                    f"seed={rng.integers(1 << 20)}", "-o", bag], check=True, stdout=subprocess.DEVNULL)
    return model, read(bag)


def roles_of(topics):
    """@return {strut: (top, wheel)}, the cabin's topic."""
    struts = {}
    for topic in topics:
        if "unsprung" in topic:
            top = topic.replace("unsprung", "sprung")
            struts[topic] = (top if top in topics else None, topic)
    return struts, next(topic for topic in topics if "sprung" not in topic)


def choose(struts, cabin, rng):
    """@return the topics that are kept, and the right pairs {wheel: body}. A body IMU has to serve all struts."""
    wheels = sorted(struts)
    if rng.random() < 0.5:
        kept = wheels if rng.random() < 0.7 else list(rng.choice(wheels, rng.integers(1, len(wheels) + 1), replace=False))
        pairs = {wheel: struts[wheel][0] for wheel in kept}
        topics = [topic for pair in pairs.items() for topic in pair]
        if rng.random() < 0.5:
            topics.append(cabin)
        return topics, pairs
    return wheels + [cabin], {wheel: cabin for wheel in wheels}


def phone(messages, cabin, rng):
    """@return an IMU that slides about in the cabin: it feels some of the body, turns slowly and knocks."""
    found = []
    for topic, message, time in messages:
        if topic != cabin:
            continue
        acceleration = message.linear_acceleration
        angle = 0.3 * np.sin(0.5 * time.to_sec()) + 0.2 * np.sin(1.7 * time.to_sec())
        knock = rng.normal(0.0, 4.0) if rng.random() < 0.05 else rng.normal(0.0, 0.2)
        found.append((message.header.stamp, np.array([np.sin(angle) * acceleration.z, 0.3 * rng.normal(),
                                                      np.cos(angle) * acceleration.z + knock]), time))
    return found


class Output:
    """A topic of an IMU that is turned."""

    def __init__(self, bag, name, turn, added):
        self.bag, self.name, self.turn, self.added = bag, name, turn, added

    def write(self, stamp, acceleration, time, source=None):
        message = Imu()
        message.header.stamp, message.header.frame_id = stamp, "imu"
        put(message.linear_acceleration, self.turn @ (acceleration + self.added))
        if source is not None:
            message.angular_velocity_covariance = source.angular_velocity_covariance
            put(message.angular_velocity, self.turn @ vector_of(source.angular_velocity))
        self.bag.write(self.name, message, time)


def vector_of(field):
    return np.array([field.x, field.y, field.z])


def put(field, vector):
    field.x, field.y, field.z = vector


def write(path, messages, topics, cabin, rng):
    """@return {topic: (name, turn)}; the phone is topic None."""
    turns, names = right_angles(), [f"/{letter}" for letter in "abcdefghijk"]
    rng.shuffle(names)
    mounted = {topic: (names.pop(), turns[rng.integers(24)]) for topic in topics}
    gravity = np.array([0.0, 0.0, 0.0 if rng.random() < 0.5 else 9.81])
    loose = phone(messages, cabin, rng) if rng.random() < 0.3 else []
    with rosbag.Bag(str(path), "w") as bag:
        outputs = {topic: Output(bag, *how, gravity - LEVEL) for topic, how in mounted.items()}
        for topic, message, time in messages:
            if topic in outputs:
                outputs[topic].write(message.header.stamp, vector_of(message.linear_acceleration), time, message)
        on_phone = Output(bag, names.pop(), turns[rng.integers(24)], gravity - LEVEL)
        for stamp, reading, time in loose:
            on_phone.write(stamp, reading, time)
    return mounted, gravity[2] != 0.0, bool(loose)


def faults(program, path, mounted, pairs, has_gravity):
    """@return what is wrong in what check says."""
    out = path.with_suffix(".json")
    out.unlink(missing_ok=True)
    result = subprocess.run([program, "check", path, "--json", out], capture_output=True, text=True)
    if not out.exists():
        return [f"status {result.returncode}: {result.stderr}"]
    found = json.loads(out.read_text())
    topic_of = {name: topic for topic, (name, _) in mounted.items()}
    told = {topic_of.get(pair["wheel"]): topic_of.get(pair["body"]) for pair in found["pairs"]}
    wrong = [f"{wheel}: {told.get(wheel)} instead of {body}" for wheel, body in pairs.items() if told.get(wheel) != body]
    wrong += [f"{wheel} is no wheel" for wheel in told if wheel not in pairs]
    axes = {topic_of[each["topic"]]: each.get("up_axis") for each in found["topics"] if each["topic"] in topic_of}
    true = {topic: up_axis(turn) for topic, (_, turn) in mounted.items()}
    for wheel, body in pairs.items():
        flipped = {axes[topic][-1] == true[topic][-1] and axes[topic] != true[topic] for topic in (wheel, body)}
        plain = all(axes[topic][-1] == true[topic][-1] for topic in (wheel, body))
        if not plain or len(flipped) > 1 or (has_gravity and True in flipped):
            wrong.append(f"axes {axes[wheel]}, {axes[body]} of {wheel} and its body, must be {true[wheel]}, {true[body]}")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bags", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--from", dest="sources", nargs="*", default=[], type=pathlib.Path)
    options = parser.parse_args()
    program, right = find_program(), 0
    recorded = [(path.stem, read(path)) for path in options.sources]
    with tempfile.TemporaryDirectory() as name:
        for number in range(options.bags):
            rng = np.random.default_rng([options.seed, number])
            if recorded:
                model, messages = recorded[number % len(recorded)]
            else:
                model, messages = simulated(program, pathlib.Path(name), rng)
            struts, cabin = roles_of({topic for topic, _, _ in messages})
            topics, pairs = choose(struts, cabin, rng)
            bag = pathlib.Path(name) / "check.bag"
            mounted, has_gravity, has_phone = write(bag, messages, topics, cabin, rng)
            wrong = faults(program, bag, mounted, pairs, has_gravity)
            right += not wrong
            print(f"{number:3d} {model:12s} {len(topics)} IMUs, {len(pairs)} wheels, "
                  f"{'one body IMU' if set(pairs.values()) == {cabin} else 'own IMUs'}"
                  f"{'' if has_gravity else ', no gravity'}{', phone' if has_phone else ''}: "
                  f"{'; '.join(wrong) or 'right'}", flush=True)
    print(f"{right} of {options.bags} right")
    return 0 if right == options.bags else 1


if __name__ == "__main__":
    sys.exit(main())
