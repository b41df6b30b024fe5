"""--vehicle: every strut of a whole vehicle from its bag, as identify, compare, diagnose and health tell it."""
import json

import pytest


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
    assert 1.0 <= found["condition"] < 20.0


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
