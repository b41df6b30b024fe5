"""Bags of a simulated fleet, and the truth about it."""
import concurrent.futures
import dataclasses
import datetime
import glob
import json
import os
import pathlib
import subprocess
import tempfile

from .bag_work import describe
from .errors import FleetError, naming
from .fleet_model import ROBOT, fleet, strut_numbers, vehicle_of_drive
from .whole_file import write_whole

TEMPERATURE_TOPIC = "/temperature"
VEHICLE_FILE = "vehicle.yaml"
TRUTH_FILE = "truth.json"


def read_model(program, path):
    """A vehicle that `suspension_bag simulate --vehicle-model` takes, its numbers as texts. None: a robot of our own.

    :raises FleetError: in the simulator's words; it looks at the file first.
    """
    if path is None:
        return ROBOT
    import yaml
    with tempfile.TemporaryDirectory(prefix="suspension_fleet.") as folder:
        _simulate(program, "--vehicle-model", path, "--duration", "0", "-o", os.path.join(folder, "drive.bag"))
    with naming(path), open(path, encoding="utf-8") as file:
        return yaml.load(file, yaml.BaseLoader)  # others take 1e3 for a text, and a strut called on for a truth value


def _simulate(program, *arguments):
    """:raises FleetError: in the simulator's words."""
    with naming(program):
        done = subprocess.run([program, "simulate", *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, encoding="utf-8", errors="replace")
    if done.returncode != 0:
        words = done.stderr.strip().replace("suspension_bag simulate: ", "", 1)
        raise FleetError(words or f"suspension_bag simulate {describe(done.returncode)}")


class Simulation:
    """Writes DIR/VEHICLE/DAY.bag, DIR/vehicle.yaml for scan, and DIR/truth.json."""

    def __init__(self, program, folder, model, laws, vehicles, duration, rate):
        self._program, self._folder, self._model = program, folder, model
        self._duration, self._rate = duration, rate
        self.truth = fleet(model, laws, vehicles)
        self._laws = laws

    def drives(self):
        """[(path of the bag, DriveTruth)] by day, so that a simulation that is ended has something of every vehicle."""
        result = [(os.path.join(self._folder, name, _day(drive.start) + ".bag"), drive)
                  for name, vehicle in self.truth.items() for drive in vehicle.drives]
        return sorted(result, key=lambda each: each[1].start)

    def write_truth(self):
        """:raises FleetError: there are bags that it is not about."""
        vehicles = {}
        for name, vehicle in self.truth.items():
            of_vehicle = dataclasses.asdict(vehicle)
            for row, drive in zip(of_vehicle["drives"], vehicle.drives):
                row["path"] = os.path.join(name, _day(drive.start) + ".bag")
                for strut, numbers in strut_numbers(vehicle_of_drive(self._model, drive)).items():
                    row["struts"][strut].update(zip(("damping_to_mass", "stiffness_to_mass"), numbers))
            vehicles[name] = of_vehicle
        text = json.dumps({"laws": dataclasses.asdict(self._laws), "model": self._model, "duration": self._duration,
                           "rate": self._rate, "vehicles": vehicles}, indent=1) + "\n"
        path = pathlib.Path(self._folder, TRUTH_FILE)
        if path.exists() and path.read_bytes() == text.encode():
            return
        if glob.glob(os.path.join(glob.escape(self._folder), "*", "*.bag")):
            raise FleetError(f"{self._folder} has bags of another fleet, must have none or those of the same options: "
                             f"{TRUTH_FILE} in there tells which")
        write_whole(path, text)

    def write_bags(self, workers, progress=lambda: None):
        """Bags that are there already stay. :raises FleetError: in the simulator's words; or they are of another fleet."""
        os.makedirs(self._folder, exist_ok=True)
        self.write_truth()
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            waiting = [pool.submit(self._write_bag, path, drive) for path, drive in self.drives()]
            try:
                for done in concurrent.futures.as_completed(waiting):
                    done.result()
                    progress()
            finally:
                for each in waiting:
                    each.cancel()

    def _write_bag(self, path, drive):
        if os.path.exists(path):
            return
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".part.", dir=self._folder) as folder:
            bag = os.path.join(folder, "drive.bag")
            if drive.bad in ("empty", "no_bag"):
                with open(bag, "w") as file:
                    file.write("" if drive.bad == "empty" else f"{drive.seed}: no bag\n")
            else:
                self._write_drive(bag, drive, folder)
            os.replace(bag, path)

    def _write_drive(self, bag, drive, folder):
        model, vehicle_file = os.path.join(folder, "model.yaml"), os.path.join(folder, VEHICLE_FILE)
        vehicle = vehicle_of_drive(self._model, drive)
        if drive.bad == "parked":
            vehicle = dict(vehicle, speed=0.01, iso_class="A")
        with open(model, "w") as file:
            json.dump(vehicle, file)  # which is YAML, too
        _simulate(self._program, "--vehicle-model", model, "--vehicle-file", vehicle_file, "--duration",
                  str(self._duration), "--rate", str(self._rate), "--seed", str(drive.seed), "--set",
                  f"start_time={drive.start:.3f}", "-o", bag)
        with open(vehicle_file) as file:
            write_whole(os.path.join(self._folder, VEHICLE_FILE), file.read().partition("\n")[2])  # without its origin
        _add_temperature(bag, drive, self._duration)
        if drive.bad == "cut_off":
            os.truncate(bag, os.path.getsize(bag) // 2)


def _day(time):
    return datetime.datetime.fromtimestamp(time, datetime.timezone.utc).strftime("%Y-%m-%d")


def _add_temperature(bag, drive, duration):
    """A thermometer beside the dampers, read every ten seconds."""
    import genpy
    import rosbag
    from sensor_msgs.msg import Temperature
    with rosbag.Bag(bag, "a") as file:
        for second in range(0, max(1, int(duration)), 10):
            message = Temperature(temperature=drive.temperature)
            message.header.stamp = genpy.Time.from_sec(drive.start + second)
            file.write(TEMPERATURE_TOPIC, message, message.header.stamp)
