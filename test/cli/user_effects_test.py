"""A user's own laws and models in files: --effects-file and --model, end to end."""
import json
import re

import pytest

DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03", "--duration", "60"]
LAWS = """
effects:
  second_spring:
    force: "max(0, d - gap)^2"
    unit: "1/(m s^2)"
    finding: "second spring engages"
    shapes:
      gap: {unit: m, scale: travel, min: 0.2, max: 3}
"""
MODEL = "damping_to_mass: 4\nstiffness_to_mass: 40\n"


@pytest.fixture(name="laws")
def fixture_laws(tmp_path):
    path = tmp_path / "laws.yaml"
    path.write_text(LAWS)
    return path


def diagnose(program, tmp_path, bag, *arguments):
    result = tmp_path / "result.json"
    program.succeed("diagnose", bag, "--json", result, *arguments)
    return json.loads(result.read_text())


def numbers(path):
    """@return the values of a model file as text, by the last part of their names."""
    return dict(re.findall(r"^ *(\w+): (\S+)  # \[.*\]$", path.read_text(), re.MULTILINE))


def test_hidden_law_of_the_user_is_found_and_nothing_is_missing_beside_it(program, tmp_path, laws):
    bag, model, again = tmp_path / "drive.bag", tmp_path / "model.yaml", tmp_path / "again.yaml"
    program.succeed("simulate", *DRIVE, "--effects-file", laws, "--effect", "second_spring=3000,gap=0.01", "-o", bag)
    found = diagnose(program, tmp_path, bag, "--effects-file", laws, "-o", model)
    assert (found["verdict"], found["selected"]) == ("effect_found", ["second_spring"])
    assert found["ranking"][0]["effects"] == ["second_spring"]
    assert found["extended"]["coefficients"]["second_spring"] == pytest.approx(3000, rel=0.1)
    assert found["extended"]["shapes"]["second_spring/gap"] == pytest.approx(0.01, rel=0.1)
    assert numbers(model).keys() == {"damping_to_mass", "stiffness_to_mass", "coefficient", "gap"}

    beside = diagnose(program, tmp_path, bag, "--effects-file", laws, "--model", model, "-o", again)
    assert (beside["verdict"], beside["selected"]) == ("nothing_missing", [])
    assert beside["base"]["held_out_rmse"] == pytest.approx(found["extended"]["held_out_rmse"], rel=0.01)
    for name, value in numbers(again).items():
        assert float(value) == pytest.approx(float(numbers(model)[name]), rel=0.1)


def test_effect_of_the_model_is_kept_and_the_other_one_is_found_beside_it(program, tmp_path):
    bag, model, both = tmp_path / "drive.bag", tmp_path / "model.yaml", tmp_path / "both.yaml"
    program.succeed("simulate", *DRIVE, "--effect", "quadratic_damping=1.6", "--effect", "bump_stop=47,g=0.013",
                    "-o", bag)
    model.write_text(MODEL + "effects: {quadratic_damping: {coefficient: 1}}\n")
    found = diagnose(program, tmp_path, bag, "--model", model, "-o", both)
    assert (found["verdict"], found["selected"]) == ("effect_found", ["bump_stop"])
    assert found["extended"]["coefficients"] == pytest.approx({"quadratic_damping": 1.6, "bump_stop": 47}, rel=0.1)
    assert "quadratic_damping:" in both.read_text() and "bump_stop:" in both.read_text()


def test_laws_are_listed_beside_the_catalogue(program, laws):
    listed = program.succeed("effects", "--markdown", "--effects-file", laws)
    row = "| `second_spring` | c (max(0, d - gap)^2) | 1/(m s^2) | gap [m] | second spring engages |  |\n"
    assert row in listed
    assert listed.replace(row, "") == program.succeed("effects", "--markdown")
    text = program.succeed("effects", "--effects-file", laws)
    assert "second_spring\n    c (max(0, d - gap)^2); [1/(m s^2)]; gap [m]\n    second spring engages\n" in text


@pytest.mark.parametrize("wrong, right, words", [
    ("d - gap", "d - gapp", ["effects/second_spring/force", '"max(0, d - gapp)^2"', "gapp", "character 12"]),
    ("d - gap)", "d - gap", ["effects/second_spring/force", "parenthesis", "at the end"]),
    ("(0, d", "(0; d", ["effects/second_spring/force", "character 6"]),
    ("max(0, d - gap)^2", "gap / d", ["effects/second_spring/force", "not finite", "d = 0"]),
    ("second_spring", "bump_stop", ["effects/bump_stop", "built-in"]),
    ("scale: travel", "scale: length", ["effects/second_spring/shapes/gap", "length", "travel_rate"]),
    ("finding", "fnding", ["effects/second_spring", "fnding", "finding"]),
    ("effects:", "effect:", ["effect/second_spring"]),
])
@pytest.mark.parametrize("command", ["effects", "diagnose", "simulate"])
def test_wrong_laws_are_refused(program, tmp_path, laws, command, wrong, right, words):
    laws.write_text(LAWS.replace(wrong, right))
    arguments = {"effects": [], "diagnose": [tmp_path / "none.bag"], "simulate": ["-o", tmp_path / "drive.bag"]}
    program.refuse(2, [command, *arguments[command], "--effects-file", laws], [laws, *words], tmp_path)


@pytest.mark.parametrize("text, words", [
    ("damping_to_mass: 4\n", ["stiffness_to_mass", "missing"]),
    (MODEL + "mass: 3\n", ["mass"]),
    (MODEL.replace("40", "soft"), ["stiffness_to_mass", "soft"]),
    (MODEL + "effects: {second_spring: {coefficient: 1}}\n", ["second_spring", "bump_stop"]),
    (MODEL + "effects: {bump_stop: {coefficient: 1}}\n", ["effects/bump_stop/g", "missing"]),
    (MODEL + "readings: {clock_offset: {coefficient: late}}\n", ["readings/clock_offset", "late"]),
    ("[1, 2]", ["line 1"])])
def test_wrong_models_are_refused(program, tmp_path, text, words):
    model = tmp_path / "model.yaml"
    model.write_text(text)
    program.refuse(2, ["diagnose", tmp_path / "none.bag", "--model", model], [model, *words], tmp_path)


@pytest.mark.parametrize("option", ["--effects-file", "--model"])
def test_file_that_is_not_there(program, tmp_path, option):
    program.refuse(2, ["diagnose", tmp_path / "none.bag", option, tmp_path / "no.yaml"], ["no.yaml"], tmp_path)


@pytest.mark.parametrize("option, file", [("--model", "model.yaml"), ("--effects-file", "laws.yaml")])
def test_files_that_are_read_are_not_written(program, tmp_path, laws, option, file):
    (tmp_path / "model.yaml").write_text(MODEL)
    assert laws.exists()
    program.refuse(2, ["diagnose", tmp_path / "none.bag", option, tmp_path / file, "-o", tmp_path / file], [file],
                   tmp_path)
