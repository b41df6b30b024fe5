"""suspension_bag compare, end to end on simulated drives of 120 s."""
import json

import pytest

DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03"]
STOP = ["--effect", "bump_stop=47,g=0.013"]
TRUTH = """damping_to_mass: 4
stiffness_to_mass: 40
effects:
  bump_stop:
    coefficient: 47
    g: 0.013
"""


@pytest.fixture(scope="module")
def stop_bag(program, tmp_path_factory):
    """A drive with a hidden bump stop. Not to be written to."""
    bag = tmp_path_factory.mktemp("stop") / "stop.bag"
    program.succeed("simulate", *DRIVE, *STOP, "-o", bag)
    return bag


def compare(program, tmp_path, *arguments):
    result = tmp_path / "result.json"
    table = program.succeed("compare", *arguments, "--json", result)
    return table, json.loads(result.read_text())


def test_says_where_the_linear_strut_fails(program, tmp_path, stop_bag):
    table, result = compare(program, tmp_path, stop_bag)
    assert set(result) >= {"model", "free_run", "one_step", "noise_floor", "structured_share", "where", "views"}
    assert set(result["free_run"]) == {"rmse", "fit_percent", "held_out_rmse"}
    assert set(result["one_step"]) >= {"rmse", "fit_percent"}
    worst = result["where"][0]
    assert worst["sentence"].startswith("In deep compression (travel above ")
    assert "harder than the model" in worst["sentence"]
    assert worst["rmse"] > 2 * result["free_run"]["rmse"]
    assert result["structured_share"] == pytest.approx(
        1 - (result["noise_floor"] / result["free_run"]["rmse"]) ** 2, abs=1e-9)
    assert not result["views"]["whiteness"]["within"]
    assert f"- {worst['sentence']}" in table
    assert "one step" in table and "free run" in table and "noise floor" in table
    assert "++" in table.split("missing force")[1], "the map shows the stop"


def test_the_true_model_leaves_noise(program, tmp_path, stop_bag):
    model = tmp_path / "model.yaml"
    model.write_text(TRUTH)
    table, result = compare(program, tmp_path, stop_bag, "--model", model)
    _, plain = compare(program, tmp_path, stop_bag)
    assert result["model"]["parameters"] == {"damping_to_mass": 4, "stiffness_to_mass": 40}
    assert result["model"]["coefficients"] == {"bump_stop": 47}
    assert result["model"]["shapes"] == {"bump_stop/g": 0.013}
    assert (result["model"]["fitted"], plain["model"]["fitted"]) == (False, True)
    assert result["free_run"]["rmse"] == pytest.approx(0.03, rel=0.1)
    assert plain["free_run"]["rmse"] > 3 * result["free_run"]["rmse"]
    assert plain["one_step"]["rmse"] > 2 * result["one_step"]["rmse"]
    assert [region["region"] for region in result["where"]] == ["nowhere"]
    assert "is noise" in table


def test_several_bags_are_one_comparison(program, tmp_path, stop_bag):
    other = tmp_path / "other.bag"
    program.succeed("simulate", *DRIVE, *STOP, "--seed", "2", "-o", other)
    _, result = compare(program, tmp_path, stop_bag, other)
    assert {bin["drive"] for bin in result["views"]["time"]} == {0, 1}
    assert "In deep compression" in result["where"][0]["sentence"]


def test_stamps_that_jitter_are_no_fault_of_the_model_while_their_clock_is_learned(program, tmp_path):
    program.succeed("simulate", "--scenario", "iso_road", "--rate", "250", "--set", "unsprung_rate=160", "--set", "stamp_jitter=0.002",
                    "--set", "noise=0.02", "-o", tmp_path / "jitter.bag")
    _, result = compare(program, tmp_path, tmp_path / "jitter.bag")
    assert result["where"][0]["sentence"].startswith("What the model leaves is noise")


def test_help_names_the_model(program):
    text = program.succeed("compare", "-h")
    assert text.startswith("usage: suspension_bag compare BAG...")
    assert "--model" in text and "--json" in text


def test_wrong_usage_and_wrong_input(program, tmp_path, stop_bag):
    program.refuse(2, ["compare"], ["bag"], tmp_path)
    program.refuse(3, ["compare", tmp_path / "none.bag"], ["none.bag"], tmp_path)
    model = tmp_path / "model.yaml"
    model.write_text("damping_to_mass: 4\n")
    program.refuse(2, ["compare", stop_bag, "--model", model], ["model.yaml", "stiffness_to_mass"], tmp_path)
    model.write_text(TRUTH)
    program.refuse(2, ["compare", stop_bag, "--model", model, "--json", model], ["model.yaml"], tmp_path)


def test_too_short_a_drive(program, tmp_path):
    program.succeed("simulate", *DRIVE, "--duration", "1", "-o", tmp_path / "short.bag")
    program.refuse(4, ["compare", tmp_path / "short.bag"], [], tmp_path)
