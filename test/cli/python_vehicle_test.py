"""VehicleMonitor of the Python module says of arrays what `suspension_bag health --vehicle` says of their bag."""
import json

import numpy as np
import pytest
import rosbag
import yaml

from python_module import shm


def drive(program, folder, model, *settings):
    bag, path = folder / "drive.bag", folder / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", model, "--duration", "60", "--rate", "100", "-o", bag,
                    "--vehicle-file", path, *settings)
    return bag, path


def readings(bag, topics):
    """Stamps [ns] and by topic a_x, a_y, a_z, w_x, w_y, w_z."""
    columns = {topic: [] for topic in topics}
    stamps = []
    with rosbag.Bag(str(bag)) as file:
        for topic, message, _ in file.read_messages(list(topics)):
            a, w = message.linear_acceleration, message.angular_velocity
            columns[topic].append((a.x, a.y, a.z, w.x, w.y, w.z))
            if topic == topics[0]:
                stamps.append(message.header.stamp.to_nsec())
    return np.array(stamps), {topic: np.array(rows) for topic, rows in columns.items()}


@pytest.mark.parametrize("model, settings", [("half_sedan", ()), ("sedan", ("--set", "sprung_imus=none"))],
                         ids=["an IMU at every top", "one on the body"])
def test_a_vehicle_is_the_command_lines(program, tmp_path, model, settings):
    bag, path = drive(program, tmp_path, model, *settings)
    program("health", bag, "--vehicle", path, "--set", "sample_period=0.01", "--json", tmp_path / "health.json")
    expected = json.loads((tmp_path / "health.json").read_text())["struts"]
    vehicle = yaml.safe_load(path.read_text())
    names = sorted(vehicle["struts"])
    struts = [vehicle["struts"][name] for name in names]
    own = [strut["sprung_imu"] for strut in struts if "sprung_imu" in strut]
    wheels = [strut["unsprung_imu"] for strut in struts]
    stamps, by_topic = readings(bag, [*wheels, *own, *([] if own else [vehicle["body_imu"]])])
    body = np.column_stack([by_topic[topic][:, 2] for topic in own]) if own else by_topic[vehicle["body_imu"]]
    wheel = np.column_stack([by_topic[topic][:, 2] for topic in wheels])

    monitor = shm.VehicleMonitor(names if own else {name: strut["position"] for name, strut in zip(names, struts)},
                                 sample_period=0.01)
    assert not monitor.is_coupled
    for piece in np.array_split(np.arange(len(stamps)), 5):
        monitor.push(stamps[piece], body[piece], wheel[piece])
    assert monitor.is_coupled and list(monitor.reports) == names
    for name, report in monitor.reports.items():
        for number in ("damping_to_mass", "stiffness_to_mass"):
            assert getattr(report.la, number) == pytest.approx(expected[name]["la"][number], rel=1e-9), name
