"""suspension_bag effects, simulate --effect and diagnose, end to end on simulated drives of 120 s."""
import json

import pytest

DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03"]


def diagnose(program, tmp_path, simulate, *arguments):
    bag, result = tmp_path / "drive.bag", tmp_path / "result.json"
    program.succeed("simulate", *simulate, "-o", bag)
    return program.succeed("diagnose", bag, "--json", result, *arguments), json.loads(result.read_text())


@pytest.mark.parametrize("effect, name", [("quadratic_damping=1.6", "quadratic_damping"),
                                          ("bump_stop=47,g=0.013", "bump_stop")])
def test_hidden_effect_is_named_with_its_size(program, tmp_path, effect, name):
    table, result = diagnose(program, tmp_path, [*DRIVE, "--effect", effect], "-o", tmp_path / "model.yaml")
    assert result["verdict"] == "effect_found"
    assert result["selected"] == [name]
    assert f"Missing from the model: {name}." in table
    assert result["extended"]["held_out_rmse"] < 0.6 * result["base"]["held_out_rmse"]
    true = float(effect.split("=")[1].split(",")[0])
    assert result["extended"]["coefficients"][name] == pytest.approx(true, rel=0.1)
    assert result["extended"]["parameters"]["stiffness_to_mass"] == pytest.approx(40.0, rel=0.03)
    assert f"  {name}:\n    coefficient: " in (tmp_path / "model.yaml").read_text()


def test_nothing_is_proposed_where_nothing_is_missing(program, tmp_path):
    table, result = diagnose(program, tmp_path, DRIVE)
    assert (result["verdict"], result["selected"]) == ("nothing_missing", [])
    assert "Nothing is missing" in table
    assert "extended" not in result


@pytest.mark.parametrize("scenario", ["paper_clean", "paper_outliers"])
def test_wear_is_named_and_lost_data_is_no_effect(program, tmp_path, scenario):
    _, result = diagnose(program, tmp_path, ["--scenario", scenario])
    assert result["selected"] == ["damping_drift"]


def test_several_threads_find_the_same(program, tmp_path):
    hidden = ["--effect", "quadratic_damping=1.6", "--duration", "40"]
    results = [diagnose(program, tmp_path, [*DRIVE, *hidden], "--threads", str(threads))[1] for threads in (1, 2)]
    assert results[0] == results[1]


def test_effects_lists_the_catalogue(program):
    table, text = program.succeed("effects", "--markdown"), program.succeed("effects")
    for name in ("progressive_spring", "coulomb_friction", "hysteresis", "clock_offset"):
        assert f"| `{name}` |" in table and f"\n{name}\n" in text
    assert max(map(len, text.splitlines())) <= 80 and not any(line.endswith(" ") for line in text.splitlines())
    assert "Design, not wear: oil through an orifice" in text


@pytest.mark.parametrize("effect, words", [
    ("bump=3", ["bump", "bump_stop"]), ("bump_stop=3", ["effects/bump_stop/g", "missing"]),
    ("bump_stop=3,h=1,g=0.1", ["effects/bump_stop/h", "unknown"]), ("bump_stop", ["NAME=COEFFICIENT"]),
    ("bump_stop=stiff,g=0.1", ["stiff"]), ("bump_stop=3,g=-1", ["effects/bump_stop/g", "must be in"])])
def test_wrong_effects_are_refused(program, tmp_path, effect, words):
    program.refuse(2, ["simulate", *DRIVE, "--effect", effect, "-o", tmp_path / "drive.bag"], words, tmp_path)


def test_too_short_a_drive(program, tmp_path):
    program.succeed("simulate", *DRIVE, "--duration", "3", "-o", tmp_path / "short.bag")
    program.refuse(4, ["diagnose", tmp_path / "short.bag"], [], tmp_path)
