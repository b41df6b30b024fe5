"""A simulated fleet wears, is repaired and loaded as it says; and scan finds it so."""
import dataclasses
import json

import numpy as np
import pytest

import conftest
import fleet
from suspension_health_monitor.fleet import fleet_model
from suspension_health_monitor.fleet.errors import FleetError, UsageError
from suspension_health_monitor.fleet.fleet_model import DAY, MONTH, Laws
from suspension_health_monitor.fleet.simulation import read_model

# Nothing but what a test is about.
CALM = dict(wearing=0, sagging=0, payload=0, season=0, tolerance=0, bad=0)


def vehicle(**laws):
    """The truth about one robot."""
    return fleet_model.fleet(fleet_model.ROBOT, Laws(**{**CALM, **laws}), 1)["robot_1"]


def shares(truth, strut, number="damping"):
    return np.array([drive.struts[strut][number] for drive in truth.drives])


def test_a_fleet_without_laws_stays_as_the_model():
    truth = vehicle(days=5)
    assert all(drive.payload == 1 and drive.temperature == 15 and drive.bad is None for drive in truth.drives)
    for name in fleet_model.ROBOT["struts"]:
        assert shares(truth, name).tolist() == shares(truth, name, "stiffness").tolist() == [1] * 5
    model = fleet_model.vehicle_of_drive(fleet_model.ROBOT, truth.drives[0])
    assert model == fleet_model.ROBOT


def test_wear_is_a_line_until_the_repair():
    truth = vehicle(days=700, wearing=1, least_wear=0.04, most_wear=0.04, repair_at=0.3)
    time = np.array([drive.start for drive in truth.drives])
    damping = shares(truth, "front_left")
    month = int(MONTH // DAY)
    assert damping[month] == pytest.approx(1 - 0.04 * time[month] / MONTH) and damping[0] == pytest.approx(1, abs=1e-3)
    first = truth.struts["front_left"].repairs[0]
    assert first == pytest.approx(0.3 / 0.04 * MONTH, abs=1.5 * DAY)
    assert damping[time < first].min() == pytest.approx(0.7, abs=0.003)
    assert damping[time >= first][0] == pytest.approx(1, abs=1e-3), "a new one"
    assert len(truth.struts["front_left"].repairs) == 3
    assert shares(truth, "front_left", "stiffness").tolist() == [1] * 700


def test_payload_season_and_bad_bags_are_as_large_as_asked():
    truth = vehicle(days=2000, payload=0.1, season=10, bad=0.1)
    assert np.std(np.log([drive.payload for drive in truth.drives])) == pytest.approx(0.1, rel=0.1)
    assert np.mean([drive.bad is not None for drive in truth.drives]) == pytest.approx(0.1, rel=0.3)
    assert {drive.bad for drive in truth.drives} == {None, *fleet_model.BAD}
    year = np.array([drive.start / DAY / 365.25 % 1 for drive in truth.drives])
    warm = np.array([drive.temperature for drive in truth.drives])
    summer, winter = warm[abs(year - 0.54) < 0.05], warm[abs(year - 0.04) < 0.02]
    assert summer.mean() == pytest.approx(25, abs=1) and winter.mean() == pytest.approx(5, abs=1)
    np.testing.assert_allclose(shares(truth, "rear_left"), 1 - 0.003 * (warm - 15))


def test_the_truth_of_a_strut_is_that_of_the_simulator(program, tmp_path):
    """b1 and b0 as `suspension_bag simulate` prints them, also of a loaded body."""
    drive = vehicle(days=1, payload=0.3, tolerance=0.2).drives[0]
    assert abs(drive.payload - 1) > 0.05
    model = fleet_model.vehicle_of_drive(fleet_model.ROBOT, drive)
    (tmp_path / "model.yaml").write_text(json.dumps(model))
    told = program.succeed("simulate", "--vehicle-model", tmp_path / "model.yaml", "--duration", "1", "-o",
                           tmp_path / "drive.bag")
    printed = {line.split()[0]: [float(word) for word in line.split()[1:3]] for line in told.splitlines()
               if line.split()[0] in model["struts"]}
    assert len(printed) == 4
    for name, numbers in fleet_model.strut_numbers(model).items():
        assert printed[name] == pytest.approx(list(numbers), rel=1e-3)


def test_a_seed_is_a_fleet():
    def truth(seed):
        return dataclasses.asdict(vehicle(seed=seed, days=3, tolerance=0.1))
    assert truth(1) == truth(1) != truth(2)


def test_wrong_laws_are_refused(tmp_path, capsys, monkeypatch):
    for laws, words in ((dict(bad=1.5), r"--bad 1.5, must lie in \[0, 1\]"), (dict(days=0), "--days 0"),
                        (dict(payload=float("nan")), "--payload nan"), (dict(least_wear=1.0), "--least-wear 1")):
        with pytest.raises(UsageError, match=words):
            Laws(**laws)
    monkeypatch.chdir(tmp_path)
    status, output, error = fleet.run_here(capsys, "simulate", "-o", "fleet", "--days", "0")
    assert (status, output) == (2, "") and error.startswith("suspension_fleet simulate: --days 0, must lie in")
    (tmp_path / "none.yaml").write_text("a: 1\n")
    status, _, error = fleet.run_here(capsys, "simulate", "-o", "fleet", "--vehicle-model", "none.yaml")
    assert status == 3 and "none.yaml" in error
    assert not (tmp_path / "fleet").exists()


STRUT = {"x": 0, "y": 0, "damping": 78, "stiffness": 1500, "wheel_mass": 2.6, "tyre_stiffness": 16000}
MODEL = {"mass": 60, "speed": 3, "struts": {"only": STRUT}}
SHORT = ["--vehicles", "1", "--days", "1", "--duration", "1", "--bad", "0"]


@pytest.mark.parametrize("model, words", [
    ("\xff", ""), ("[1, 2", ": line 1"), ("- 1", ""), ("", ": mass is missing"),
    (dict(MODEL, mass="heavy"), ': mass = "heavy"'), (dict(MODEL, mass=0), ": mass = "),
    (dict(MODEL, struts={}), " no strut"), (dict(MODEL, struts={"only": 1}), ": struts/only"), (dict(MODEL, struts={"only": {**STRUT, "x": None}}), "only/x"),
    (dict(MODEL, struts={"only": {"x": 1}}), ": y is missing"), (dict(MODEL, struts={"../up": STRUT}), ": struts/..")])
def test_odd_models_are_refused_in_the_simulators_words(program, tmp_path, model, words):
    path = tmp_path / "model.yaml"
    path.write_bytes(model.encode("latin-1") if isinstance(model, str) else json.dumps(model).encode())
    with pytest.raises(FleetError, match=f"^{path}: [^\n]*$") as refusal:
        read_model(program.path, str(path))
    assert words in str(refusal.value)


def test_models_are_read_as_the_simulator_reads_them(program, tmp_path):
    """In YAML as others read it 6e1 is a text, and a strut called on a truth value."""
    (tmp_path / "model.yaml").write_text(json.dumps(dict(MODEL, struts={"on": STRUT})).replace("60", "6e1", 1)
                                         .replace('"on"', "on"))
    fleet.succeed(tmp_path, "simulate", "-o", "fleet", "--vehicle-model", "model.yaml", *SHORT, "--payload", "0",
                  "--season", "0", "--tolerance", "0", "--wearing", "0", "--sagging", "0")
    (drive,) = json.loads((tmp_path / "fleet/truth.json").read_text())["vehicles"]["robot_1"]["drives"]
    assert drive["struts"]["on"]["damping_to_mass"] == pytest.approx(78 / 60)


def test_a_folder_is_of_one_fleet(program, tmp_path, capsys, monkeypatch):
    def simulate(*arguments):
        return fleet.run_here(capsys, "simulate", "-o", "fleet", *SHORT, *arguments)
    monkeypatch.chdir(tmp_path)
    assert simulate("--rate", "1e9")[0] == 3, "of which no bag is there"
    assert simulate("--seed", "1")[0] == 0
    before = conftest.snapshot(tmp_path)
    for other in (["--seed", "2"], ["--days", "2"], ["--rate", "50"], ["--duration", "2"]):
        status, output, error = simulate("--seed", "1", *other)
        assert (status, output) == (3, "")
        assert error.startswith("suspension_fleet simulate: fleet has bags of another fleet, must have none or")
    assert conftest.snapshot(tmp_path) == before
    assert simulate("--seed", "1")[0] == 0
    (tmp_path / "fleet/truth.json").unlink()
    assert simulate("--seed", "2")[0] == 3, "nobody knows of which fleet they are"


def test_a_place_that_is_no_folder_is_said_in_words(program, tmp_path):
    (tmp_path / "file").write_text("here first")
    status, output, error = fleet.run(tmp_path, "simulate", "-o", "file", *SHORT)
    assert (status, output, error) == (3, "", "suspension_fleet simulate: file: File exists\n")


def test_scan_finds_the_truth(program, tmp_path):
    """Every law at once, in bags: all estimates within their intervals as often as these promise."""
    arguments = ["simulate", "-o", "fleet", "--vehicles", "2", "--days", "50", "--every", "10", "--duration", "30",
                 "--wearing", "1", "--most-wear", "0.2", "--payload", "0.2", "--bad", "0.3", "--start", "2025-12-01",
                 "--seed", "4"]
    assert fleet.succeed(tmp_path, *arguments).splitlines()[0] == "10 bags of 2 vehicles"
    truth = json.loads((tmp_path / "fleet/truth.json").read_text())["vehicles"]
    bags = {path: path.stat().st_mtime_ns for path in (tmp_path / "fleet").rglob("*.bag")}
    assert len(bags) == 10 and not list((tmp_path / "fleet").glob(".part*"))
    next(iter(bags)).unlink()
    fleet.succeed(tmp_path, *arguments)
    assert sum(path.stat().st_mtime_ns == bags[path] for path in bags) == 9, "what is there stays"

    url = f"sqlite:///{tmp_path / 'fleet.db'}"
    fleet.succeed(tmp_path, "scan", "fleet", "--db", url, "--vehicle-file", "fleet/vehicle.yaml", "--temperature-topic",
                  "/temperature")
    fleet.require_whole(url)
    drives = {str(tmp_path / "fleet" / drive["path"]): drive for each in truth.values() for drive in each["drives"]}
    expected = {"cut_off": "unreadable", "no_bag": "unreadable", "empty": "unread", "parked": "poor", None: "ok"}
    found = dict(fleet.rows(url, "SELECT path, status FROM drives"))
    assert found == {path: expected[drive["bad"]] for path, drive in drives.items()}
    assert {"ok", "unreadable"} <= set(found.values())

    deviations = []
    for path, start, strut, temperature, *numbers in fleet.rows(url, """
            SELECT d.path, d.start, s.strut, s.temperature, s.damping_to_mass, s.damping_to_mass_stddev, s.stiffness_to_mass,
                   s.stiffness_to_mass_stddev FROM drives d JOIN struts s ON s.drive_id = d.id WHERE s.valid"""):
        drive = drives[path]
        true = drive["struts"][strut]
        assert start == pytest.approx(drive["start"], abs=0.01)
        assert temperature == pytest.approx(drive["temperature"])
        deviations.append(((numbers[0] - true["damping_to_mass"]) / numbers[1],
                           (numbers[2] - true["stiffness_to_mass"]) / numbers[3]))
    assert len(deviations) == 4 * sum(drive["bad"] is None for drive in drives.values())
    # Of so many intervals of 95 % more than a fifth miss by chance once in 10 000 fleets.
    assert np.mean(np.abs(deviations) > 1.96) < 0.2
