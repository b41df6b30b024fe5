"""Vehicles in Python: VehicleMonitor says of arrays what `suspension_bag health --vehicle` says of their bag, and the functions
say of bags what the commands say with --vehicle."""
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
            # The order of an instant's readings decides at which of them a block is linearised.
            assert getattr(report.estimate, number) == pytest.approx(expected[name]["estimate"][number], rel=1e-3), name


@pytest.fixture(scope="module")
def half_car(program, tmp_path_factory):
    """A bag and the file of its vehicle; the front has an effect that the model lacks."""
    return drive(program, tmp_path_factory.mktemp("half"), "half_sedan", "--effect", "front/quadratic_damping=2")


def said(program, folder, command, half_car, *options):
    program(command, half_car[0], "--vehicle", half_car[1], *options, "--json", folder / "said.json")
    return json.loads((folder / "said.json").read_text())["struts"]


def test_every_strut_of_a_bag_is_the_command_lines(program, tmp_path, half_car):
    bag, vehicle = half_car
    expected = {command: said(program, tmp_path, command, half_car)
                for command in ("identify", "compare", "diagnose", "health")}
    found = {command: getattr(shm, command)(bag, vehicle=vehicle) for command in expected}
    for command, struts in expected.items():
        assert list(found[command]) == sorted(struts) == ["front", "rear"], command
    for name in ("front", "rear"):
        identified, compared, searched, watched = (found[command][name] for command in expected)
        its = {command: struts[name] for command, struts in expected.items()}
        for estimator in ("estimate", "ls", "la"):
            for number in ("damping_to_mass", "stiffness_to_mass", "damping_to_mass_stddev"):
                assert getattr(getattr(identified, estimator), number) == pytest.approx(
                    its["identify"][estimator][number], rel=1e-12)
        assert identified.course.damping_to_mass[-1] == pytest.approx(identified.now.damping_to_mass, rel=0.02)
        assert compared.free_run.rmse == pytest.approx(its["compare"]["free_run"]["rmse"], rel=1e-12)
        assert (searched.verdict, searched.selected) == (its["diagnose"]["verdict"], its["diagnose"]["selected"])
        assert searched.base.held_out_rmse == pytest.approx(its["diagnose"]["base"]["held_out_rmse"], rel=1e-12)
        assert [event.message for event in watched.events] == [event["message"] for event in its["health"]["events"]]
        assert watched.estimate.stiffness_to_mass == pytest.approx(its["health"]["estimate"]["stiffness_to_mass"], rel=1e-12)
        assert len(watched.course.time) > 100
    assert found["diagnose"]["front"].selected == ["quadratic_damping"] and found["diagnose"]["rear"].selected == []


def test_options_of_a_strut_stand_in_its_file(program, tmp_path, half_car):
    bag, vehicle = half_car
    settings = tmp_path / "struts.yaml"
    settings.write_text("memory: 4\nstruts: {rear: {integration_horizon: 0.8, nominal: {damping_to_mass: 9}}}\n")
    found = shm.identify(bag, vehicle=vehicle, strut="rear", config=settings)
    assert list(found) == ["rear"]
    assert found["rear"].horizon_samples * found["rear"].sample_period == pytest.approx(0.8)
    for options in ({"config": settings}, {"baseline": settings}):
        watched = shm.health(bag, vehicle=vehicle, **options)
        assert watched["rear"].reference == "nominal values: damping/mass 9 1/s"
        assert "below nominal" in watched["rear"].end.message
        assert "learned" in watched["front"].reference or "nothing" in watched["front"].reference


@pytest.mark.parametrize("call, words", [
    (lambda bag, vehicle: shm.identify([0.0], [0.0], [0.0], vehicle=vehicle), "vehicle is an option of bags"),
    (lambda bag, vehicle: shm.identify(bag, strut="rear"), "--strut rear without --vehicle"),
    (lambda bag, vehicle: shm.compare(bag, vehicle=vehicle, strut="middle"), "--strut middle, must be one of front, rear"),
    (lambda bag, vehicle: shm.health(bag, vehicle=vehicle, sprung_topic="/a"), "--sprung-topic beside --vehicle"),
    (lambda bag, vehicle: shm.identify(bag, vehicle=vehicle, model="m.yaml"), "model and effects_file beside vehicle"),
    (lambda bag, vehicle: shm.health(bag, vehicle=vehicle, baseline=shm.Baseline(damping_to_mass=3.0)), "must be the path"),
    (lambda bag, vehicle: shm.diagnose(bag, vehicle="none.yaml"), "none.yaml: cannot be read")])
def test_what_is_of_no_vehicle_is_refused(half_car, call, words):
    with pytest.raises(ValueError, match=words):
        call(*half_car)
