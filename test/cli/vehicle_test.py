"""--vehicle: every strut of a whole vehicle from its bag, as identify, compare, diagnose and health tell it."""
import json
import re

import pytest
import yaml


@pytest.fixture(scope="module")
def vehicle(program, tmp_path_factory):
    """@return bag, vehicle file, and own b1, b0 of both struts of a half car, as simulate prints them."""
    folder = tmp_path_factory.mktemp("vehicle")
    bag, path = folder / "drive.bag", folder / "vehicle.yaml"
    told = program.succeed("simulate", "--vehicle-model", "half_sedan", "--duration", "60", "--rate", "100", "-o", bag,
                           "--vehicle-file", path)
    truth = {line.split()[0]: tuple(map(float, line.split()[1:3])) for line in told.splitlines()[2:]}
    return bag, path, truth


def result(program, command, vehicle, folder, *options):
    path = folder / "result.json"
    program.succeed(command, vehicle[0], "--vehicle", vehicle[1], "--json", path, *options)
    return json.loads(path.read_text())


def test_identify_tells_every_strut_its_own(program, vehicle, tmp_path):
    found = result(program, "identify", vehicle, tmp_path)
    assert set(found["struts"]) == {"front", "rear"}
    for name, (damping, stiffness) in vehicle[2].items():
        la = found["struts"][name]["la"]
        assert la["valid"]
        assert la["damping_to_mass"] == pytest.approx(damping, rel=0.03)
        assert la["stiffness_to_mass"] == pytest.approx(stiffness, rel=0.03)
    assert set(found["coupling"]) == {"front", "rear"} and set(found["coupling"]["front"]) == {"rear"}
    assert 0.0 < found["model_error"] < 0.01


SEDAN = {"mass": 1350.0, "pitch_inertia": 2100.0, "roll_inertia": 480.0}
SEDAN_IMU = (0.2, -0.1)  # [m] from the centre of gravity, which positions are told from


@pytest.mark.parametrize("imus", ["all", "none"])
def test_identify_tells_how_the_mass_is_spread(program, tmp_path, imus):
    bag, path = tmp_path / "drive.bag", tmp_path / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", "sedan", "--duration", "60", "--rate", "100", "--set",
                    f"sprung_imus={imus}", "-o", bag, "--vehicle-file", path)
    body = result(program, "identify", (bag, path), tmp_path)["body"]
    for name, true in (("mass_to_pitch_inertia", SEDAN["mass"] / SEDAN["pitch_inertia"]),
                       ("mass_to_roll_inertia", SEDAN["mass"] / SEDAN["roll_inertia"])):
        assert body[name] == pytest.approx(true, rel=0.01)
        assert 0.0 < body[f"{name}_stddev"] < 0.01 * true
        assert abs(body[name] - true) < 4.0 * body[f"{name}_stddev"]
    assert body["centre_of_gravity"] == pytest.approx([-SEDAN_IMU[0], -SEDAN_IMU[1]], abs=0.02)


def test_struts_that_the_file_lacks_are_the_reason_why_there_is_no_estimate(program, tmp_path):
    """Not that a drive of a minute is too short."""
    bag, path = tmp_path / "drive.bag", tmp_path / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", "ugv", "--duration", "60", "-o", bag, "--vehicle-file", path)
    layout = yaml.safe_load(path.read_text())
    layout["struts"] = {name: strut for name, strut in layout["struts"].items() if name.startswith("front")}
    path.write_text(yaml.safe_dump(layout))
    told = program("identify", bag, "--vehicle", path)
    assert told.returncode == 4 and "too short" not in told.stderr
    assert "the drives do not fit the vehicle file: " in told.stderr and "a strut that is missing in the file" in told.stderr


def test_two_struts_do_not_tell_how_the_mass_is_spread(program, vehicle, tmp_path):
    text = program.succeed("identify", vehicle[0], "--vehicle", vehicle[1])
    assert "cannot tell M/Iyy and M/Ixx: it takes three struts that do not stand on one line\n" in text
    assert set(result(program, "identify", vehicle, tmp_path)["body"]) == {"reason"}


def test_one_strut_alone_can_be_asked_for(program, vehicle, tmp_path):
    assert set(result(program, "compare", vehicle, tmp_path, "--strut", "rear")["struts"]) == {"rear"}


def test_nothing_is_missing_where_nothing_is_hidden(program, vehicle, tmp_path):
    found = result(program, "diagnose", vehicle, tmp_path)
    assert found["verdict"] == "nothing_missing"
    assert found["selected"] == {"front": [], "rear": []}
    for strut in found["struts"].values():
        assert strut["verdict"] == "nothing_missing"


def test_health_watches_every_strut(program, vehicle, tmp_path):
    found = result(program, "health", vehicle, tmp_path)
    for strut in found["struts"].values():
        assert strut["warn_events"] == strut["error_events"] == 0
        assert sum(strut["seconds"].values()) == pytest.approx(60, abs=1)


# A half car with a tow bar: 1/M + x_i x / Iyy of it at front and rear.
TOWING = """
mass: 600
pitch_inertia: 900
speed: 15
struts:
  front: {x: 1.1, y: 0, damping: 1500, stiffness: 18000, wheel_mass: 40, tyre_stiffness: 180000}
  rear: {x: -1.4, y: 0, damping: 1500, stiffness: 18000, wheel_mass: 40, tyre_stiffness: 180000, effects: EFFECTS}
known_forces: {tow_bar: {x: -2.2, rms: 120}}
"""
TOW_BAR = {"front": 1 / 600 - 1.1 * 2.2 / 900, "rear": 1 / 600 + 1.4 * 2.2 / 900}


def towed(program, folder, effects="{bump_stop: {coefficient: 0, g: 0.1}}"):
    """@return bag and vehicle file of a drive."""
    bag, path, model = folder / "towed.bag", folder / "towed.yaml", folder / "towing.yaml"
    model.write_text(TOWING.replace("EFFECTS", effects))
    program.succeed("simulate", "--vehicle-model", model, "--duration", "60", "--rate", "100", "-o", bag,
                    "--vehicle-file", path)
    return bag, path


def test_known_force_is_told_by_its_coefficients(program, tmp_path):
    vehicle = towed(program, tmp_path)
    found = result(program, "identify", vehicle, tmp_path)
    bar = found["known_forces"]["tow_bar"]
    for name, coefficient in TOW_BAR.items():
        assert bar["coefficients"][name] == pytest.approx(coefficient, abs=0.02 * TOW_BAR["rear"])
        assert 0 < bar["stddevs"][name] < 0.02 * TOW_BAR["rear"]
        x = 1.1 if name == "front" else -1.4
        own = 1 / 600 + x ** 2 / 900
        assert found["struts"][name]["la"]["stiffness_to_mass"] == pytest.approx(18000 * own, rel=0.03)
    path = tmp_path / "without.yaml"
    path.write_text(vehicle[1].read_text().partition("known_forces:")[0])
    without = program("identify", vehicle[0], "--vehicle", path, "--json", tmp_path / "without.json")
    if without.returncode == 0:  # else it has not been taken for struts at all
        wrong = json.loads((tmp_path / "without.json").read_text())["struts"]["rear"]["la"]
        assert abs(wrong["stiffness_to_mass"] / (18000 * (1 / 600 + 1.4 ** 2 / 900)) - 1) > 0.1
    health = result(program, "health", vehicle, tmp_path)
    assert health["known_forces"]["tow_bar"]["coefficients"]["rear"] == pytest.approx(TOW_BAR["rear"], rel=0.05)


def test_effect_behind_a_known_force_is_named(program, tmp_path):
    found = result(program, "diagnose", towed(program, tmp_path, "{quadratic_damping: {coefficient: 12}}"), tmp_path)
    assert found["selected"] == {"front": [], "rear": ["quadratic_damping"]}


def test_force_that_the_bag_has_not_is_refused(program, vehicle, tmp_path):
    path = tmp_path / "forces.yaml"
    for field, topic, words in (("force.z", "/tow_bar/wrench", ["no topic /tow_bar/wrench", "known_forces/bar/topic"]),
                                ("force.z", "/simulator/truth", ["/simulator/truth is", "geometry_msgs/WrenchStamped"]),
                                ("force", "/tow_bar/wrench", ["known_forces/bar/field", '"force"', "torque.z"])):
        path.write_text(vehicle[1].read_text() + f"known_forces: {{bar: {{topic: {topic}, field: {field}}}}}\n")
        program.refuse(2 if field == "force" else 3, ["identify", vehicle[0], "--vehicle", path], words, tmp_path)


@pytest.mark.parametrize("options, words", [
    (["--strut", "rear"], ["--vehicle"]),
    (["--vehicle", "V", "--strut", "middle"], ["middle", "front, rear"]),
    (["--vehicle", "V", "--sprung-topic", "/imu"], ["--sprung-topic", "left out"]),
])
def test_refusals(program, vehicle, tmp_path, options, words):
    arguments = [vehicle[1] if option == "V" else option for option in options]
    program.refuse(2, ["identify", vehicle[0], *arguments], words, tmp_path)


def test_wheels_that_move_alike_are_not_told_apart(program, tmp_path):
    bag, path = tmp_path / "drive.bag", tmp_path / "vehicle.yaml"
    program.succeed("simulate", "--vehicle-model", "ugv", "--duration", "40", "--rate", "100", "--set",
                    "tracks=identical", "-o", bag, "--vehicle-file", path)
    told = program("identify", bag, "--vehicle", path)
    assert told.returncode == 4
    assert "cannot tell" in told.stderr and "_left" in told.stderr and "_right" in told.stderr


@pytest.fixture(scope="module")
def ugv(program, tmp_path_factory):
    """@return bag of 60 s with one IMU on the body, and what its vehicle file holds."""
    folder = tmp_path_factory.mktemp("ugv")
    program.succeed("simulate", "--vehicle-model", "ugv", "--duration", "60", "--rate", "100", "--set",
                    "sprung_imus=none", "-o", folder / "drive.bag", "--vehicle-file", folder / "vehicle.yaml")
    return folder / "drive.bag", (folder / "vehicle.yaml").read_text()


def test_health_gives_one_standard_deviation_with_the_models_error(program, ugv, tmp_path):
    vehicle, told = tmp_path / "vehicle.yaml", tmp_path / "told.json"
    vehicle.write_text(ugv[1])
    text = program.succeed("health", ugv[0], "--vehicle", vehicle, "--json", told)
    printed = [float(stddev) for stddev in re.findall(r"estimate: damping/mass \S+ \+- (\S+) 1/s", text)]
    struts = json.loads(told.read_text())["struts"].values()
    assert len(printed) == 4
    assert printed == pytest.approx([strut["estimate"]["damping_to_mass_stddev"] for strut in struts], abs=1e-4)


def mirror(left, _):
    left["position"][0] *= -1.0


def swap(left, right):
    left["unsprung_imu"], right["unsprung_imu"] = right["unsprung_imu"], left["unsprung_imu"]


@pytest.mark.parametrize("command", ["identify", "compare", "diagnose"])
@pytest.mark.parametrize("make_wrong, words", [(mirror, ["other sign of x", "front_left"]), (swap, ["swapped", "front_left"])])
def test_a_mistake_in_the_vehicle_file_is_named_by_every_command(program, ugv, tmp_path, command, make_wrong, words):
    vehicle = yaml.safe_load(ugv[1])
    make_wrong(vehicle["struts"]["front_left"], vehicle["struts"]["front_right"])
    (tmp_path / "wrong.yaml").write_text(yaml.safe_dump(vehicle))
    told = program(command, ugv[0], "--vehicle", tmp_path / "wrong.yaml")
    assert told.returncode == 4
    assert all(word in told.stdout + told.stderr for word in ["vehicle file", *words])
