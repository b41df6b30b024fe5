"""inspect: a verdict on a vehicle of which nothing is known beforehand."""
import json
import re

import pytest

WORN = ("--set", "struts/rear_left/damping_end_fraction=0.5")


@pytest.fixture(scope="module")
def drives(program, tmp_path_factory):
    """@return bag and vehicle file of a healthy sedan and of one whose rear left damper has lost half."""
    folder = tmp_path_factory.mktemp("inspect")
    made = {}
    for name, settings in (("healthy", ()), ("worn", WORN)):
        bag, vehicle = folder / f"{name}.bag", folder / f"{name}.yaml"
        program.succeed("simulate", "--vehicle-model", "sedan", "--duration", "60", "--rate", "100", *settings, "-o", bag,
                        "--vehicle-file", vehicle)
        made[name] = (bag, "--vehicle", vehicle)
    return made


def number(told, quantity, *struts):
    return next(its for its in told["numbers"] if its["quantity"] == quantity and its["struts"] == list(struts))


def test_a_healthy_vehicle_passes(program, drives, tmp_path):
    path = tmp_path / "found.json"
    text = program.succeed("inspect", *drives["healthy"], "--json", path)
    assert "\nverdict: passes\nThis is no replacement of a legal test.\n" in text
    assert re.search(r"adhesion +front_left .* not asked\n", text)
    told = json.loads(path.read_text())
    assert told["verdict"] == "passes" and len(told["numbers"]) == 8
    assert told["seconds"] == pytest.approx(60, abs=1)
    for its in told["numbers"]:
        low, high = its["interval"]
        assert low <= its["value"] <= high and its["verdict"] == "passes" and its["sentence"] == "passes"
    for name, frequency in told["bounce_frequency"].items():
        assert frequency["interval"][0] < frequency["value"] < frequency["interval"][1], name


def test_a_worn_damper_fails_at_its_corner(program, drives, tmp_path):
    path = tmp_path / "found.json"
    result = program("inspect", *drives["worn"], "--json", path)
    assert result.returncode == 1
    assert result.stderr == "suspension_bag inspect: fails: damping imbalance of rear_left\n"
    told = json.loads(path.read_text())
    assert told["verdict"] == "fails"
    its = number(told, "damping_imbalance", "rear_left", "rear_right")
    assert its["weaker"] == "rear_left" and its["sentence"] == "fails: weaker is rear_left"
    assert its["value"] == pytest.approx(0.5, abs=0.05)
    assert number(told, "damping_imbalance", "front_left", "front_right")["verdict"] == "passes"


def test_what_is_near_a_limit_cannot_be_told(program, drives):
    result = program("inspect", *drives["worn"], "--most-imbalance", "50")
    assert result.returncode == 4
    assert result.stderr.startswith("suspension_bag inspect: cannot tell: damping imbalance of rear_left")
    assert re.search(r"damping imbalance +rear_left / rear_right .* cannot tell: (drive \d+ s in all, or a rougher road|"
                     r"too near the limit)", result.stdout)


def test_wheel_and_tyre_tell_the_adhesion(program, drives, tmp_path):
    path = tmp_path / "found.json"
    options = ("--wheel-mass", "0.1..0.14", "--tyre-stiffness", "520")
    program("inspect", *drives["healthy"], "--json", path, *options)
    over_mass = [its for its in json.loads(path.read_text())["numbers"] if its["quantity"] == "adhesion"]
    assert len(over_mass) == 4
    assert all(0.0 <= its["interval"][0] <= its["value"] <= its["interval"][1] < 1.0 for its in over_mass)
    program("inspect", *drives["healthy"], "--json", path, "--set", "sprung_mass=400", "--wheel-mass", "40..56",
            "--tyre-stiffness", "208000")
    in_si = [its for its in json.loads(path.read_text())["numbers"] if its["quantity"] == "adhesion"]
    assert [its["value"] for its in in_si] == pytest.approx([its["value"] for its in over_mass], rel=1e-9)


def test_the_page_is_one_sheet_without_a_script(program, drives, tmp_path):
    page = tmp_path / "page"
    text = program.succeed("inspect", *drives["healthy"], "--report", page)
    assert text.endswith(f"wrote {page}/report.html\n")
    html = (page / "report.html").read_text()
    assert "Verdict: <strong>passes</strong>" in html and "no replacement of a legal test" in html
    assert "<script" not in html and "@@" not in html and "size: A4" in html
    assert html.count("<tr>") == 1 + 4 + 4 + 8  # headings, frequencies, adhesion not asked, numbers


def test_one_strut_alone_has_its_damping_ratio(program, paper_bag, tmp_path):
    path = tmp_path / "found.json"
    assert program("inspect", paper_bag, "--json", path).returncode in (0, 4)
    assert [its["quantity"] for its in json.loads(path.read_text())["numbers"]] == ["damping_ratio"]


def test_where_no_hand_pushes_a_drive_is_judged_as_a_bounce_would_be(program, paper_bag, tmp_path):
    ratios = []
    for options in ((), ("--bounce",)):
        path = tmp_path / "found.json"
        program("inspect", paper_bag, "--json", path, *options)
        ratios.append(json.loads(path.read_text())["numbers"][0])
    assert ratios[1]["value"] == pytest.approx(ratios[0]["value"], rel=0.1)


@pytest.mark.parametrize("options, words", [
    (("--wheel-mass", "0.1"), ("--wheel-mass and --tyre-stiffness", "both")),
    (("--wheel-mass", "0.2..0.1", "--tyre-stiffness", "500"), ("--wheel-mass 0.2..0.1", "LOW..HIGH")),
    (("--wheel-mass", "x", "--tyre-stiffness", "500"), ("--wheel-mass x", "LOW..HIGH")),
    (("--wheel-mass", "0.1", "--tyre-stiffness", "2e5"), ("--tyre-stiffness over the sprung mass = 200000", "[30, 100000]")),
    (("--bounce", "--vehicle", "v.yaml"), ("--bounce beside --vehicle",)),
    (("--most-imbalance", "0"), ("--most-imbalance = 0 [%]", "[1, 99]")),
    (("--least-damping-ratio", "-1"), ("--least-damping-ratio = -1", "above 0")),
])
def test_wrong_options_are_refused(program, paper_bag, tmp_path, options, words):
    program.refuse(2, ("inspect", paper_bag, *options), words, tmp_path)
