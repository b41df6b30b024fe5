"""Curves of damper and spring by suspension_bag identify --curves and diagnose, on simulated drives."""
import json

import pytest

B1, B0, HARDER = 4.0, 40.0, 1.2  # of the ugv [1/s], [1/s^2]; what compression has more and rebound less [1/s]
DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03"]
LAWS = {"damper_curve": ("velocity", lambda v: B1 * v + HARDER * abs(v)),
        "spring_curve": ("travel", lambda d: B0 * d)}


@pytest.fixture(scope="module")
def bag(program, tmp_path_factory):
    """A drive whose damper is harder in compression. Not to be written to."""
    path = tmp_path_factory.mktemp("curves") / "drive.bag"
    program.succeed("simulate", *DRIVE, "--duration", "60", "--effect", f"asymmetric_damping={HARDER}", "-o", path)
    return path


def assert_holds(curve, variable, law):
    for at, force, stddev in zip(curve[variable], curve["force"], curve["stddev"]):
        assert abs(force - law(at)) <= 4.0 * stddev  # by chance beyond in one of 16 000, and there are some forty


def run(program, tmp_path, command, *arguments):
    result = tmp_path / "result.json"
    return program.succeed(command, *arguments, "--json", result), json.loads(result.read_text())


@pytest.mark.parametrize("command", [["identify", "--curves"], ["diagnose"]])
def test_curves_are_the_true_laws(program, tmp_path, bag, command):
    _, result = run(program, tmp_path, command[0], bag, *command[1:])
    for name, (variable, law) in LAWS.items():
        curve = result[name]
        assert sorted(curve) == sorted(["force", "stddev", variable])
        assert len(curve[variable]) == len(curve["force"]) == len(curve["stddev"]) > 10
        assert curve[variable] == sorted(curve[variable])
        assert curve["force"][curve[variable].index(0.0)] == 0.0
        assert_holds(curve, variable, law)


@pytest.mark.parametrize("command, model, effect", [
    (["identify", "--curves"], "ugv", None), (["identify", "--curves"], "sedan", ("front_left", HARDER)),
    (["diagnose"], "sedan", ("front_left", HARDER))])
def test_curves_of_a_vehicle_are_those_of_its_struts(program, tmp_path, command, model, effect):
    bag, vehicle = tmp_path / "drive.bag", tmp_path / "vehicle.yaml"
    hidden = ["--effect", f"{effect[0]}/asymmetric_damping={effect[1]}"] if effect else []
    told = program.succeed("simulate", "--vehicle-model", model, "--duration", "60", "--rate", "100", "-o", bag,
                           "--vehicle-file", vehicle, *hidden)
    own = {line.split()[0]: tuple(map(float, line.split()[1:3])) for line in told.splitlines()[2:] if len(line.split()) > 2}
    text, result = run(program, tmp_path, command[0], bag, "--vehicle", vehicle, *command[1:])
    assert text.count("damper at [m/s]") == text.count("spring at [mm]") == len(own) == len(result["struts"])
    for name, (b1, b0) in own.items():
        harder = effect[1] if effect and name == effect[0] else 0.0
        curves = result["struts"][name]
        assert len(curves["damper_curve"]["force"]) > 10 and len(curves["spring_curve"]["force"]) > 10
        assert_holds(curves["damper_curve"], "velocity", lambda v: b1 * v + harder * abs(v))
        assert_holds(curves["spring_curve"], "travel", lambda d: b0 * d)


def test_forces_are_in_newtons_where_the_mass_is_known(program, tmp_path, bag):
    plain, result = run(program, tmp_path, "identify", bag, "--curves")
    heavy, same = run(program, tmp_path, "identify", bag, "--curves", "--set", "sprung_mass=50")
    assert result["damper_curve"] == same["damper_curve"]
    assert "damper at [m/s]" in plain and "spring at [mm]" in plain
    assert "force [m/s^2]" in plain and "force [N]" in heavy

    def forces(text):
        """@return compression and rebound at the slowest rate that is shown."""
        lines = text.splitlines()
        row = lines[next(i for i, line in enumerate(lines) if line.startswith("damper at")) + 1].split()
        return float(row[1]), float(row[4])

    assert forces(heavy) == pytest.approx([50.0 * force for force in forces(plain)], rel=2e-3)
    compression, rebound = forces(plain)
    assert compression / -rebound == pytest.approx((B1 + HARDER) / (B1 - HARDER), rel=0.1)


def test_identify_fits_them_only_if_asked(program, tmp_path, bag):
    text, result = run(program, tmp_path, "identify", bag)
    assert "damper at" not in text and "damper_curve" not in result


def test_too_little_to_tell_is_a_result(program, tmp_path):
    short, result = tmp_path / "short.bag", tmp_path / "result.json"
    program.succeed("simulate", *DRIVE, "--duration", "5", "-o", short)
    told = program("identify", short, "--curves", "--json", result)
    assert "damper at [m/s]: the drives do not tell" in told.stdout
    assert json.loads(result.read_text())["damper_curve"] == {"velocity": [], "force": [], "stddev": []}
