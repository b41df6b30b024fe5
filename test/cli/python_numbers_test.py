"""The Python module says what the command line says, over bags and over arrays of the same readings."""
import json
import math
import re

import numpy as np
import pytest

import imu_bag
from python_module import HIDDEN, ROUGH, shm

KEYWORDS = {"from": "from_"}  # of Python
ELSEWHERE = {"silent", "coefficients", "shapes", "stddevs", "parameters", "not_tried", "warn_events", "error_events",
             "fit_percent", "fitted_to_all_samples", "failure"}  # under other names, or in the model: compared below


@pytest.fixture(scope="module")
def rough_bag(tmp_path_factory):
    """Two minutes with a hidden effect, gaps included."""
    path = tmp_path_factory.mktemp("python") / "drive.bag"
    shm.simulate(path, effect=HIDDEN, dropout=0.001, **ROUGH)
    return path


@pytest.fixture(scope="module")
def searched_bag(tmp_path_factory):
    """The same for a minute: a search takes as long as its drive."""
    path = tmp_path_factory.mktemp("python") / "drive.bag"
    shm.simulate(path, effect=HIDDEN, dropout=0.001, duration=60.0, **ROUGH)
    return path


@pytest.fixture(scope="module")
def worn_bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("python") / "worn.bag"
    shm.simulate(path, scenario="paper_outliers")
    return path


def said(program, folder, *arguments):
    """What the command line writes with --json."""
    program(*arguments, "--json", folder / "result.json")
    return json.loads((folder / "result.json").read_text())


def assert_same(found, expected, where="result"):
    """Every number that the command line tells is the attribute of its name, to 1e-12."""
    if isinstance(expected, dict):
        for key, value in expected.items():
            if key in ELSEWHERE:
                continue
            name = KEYWORDS.get(key, key)
            part = found.get(key, 0) if isinstance(found, dict) else getattr(found, name)
            assert_same(part, value, f"{where}.{name}")
    elif isinstance(expected, list) and expected and isinstance(expected[0], dict) and not isinstance(found, list):
        assert len(found) == len(expected), where  # bins are arrays
        for key in expected[0]:
            assert_same(getattr(found, KEYWORDS.get(key, key)), [each[key] for each in expected], f"{where}.{key}")
    elif isinstance(expected, list) and expected and isinstance(expected[0], (dict, str)):
        assert len(found) == len(expected), where
        for k, each in enumerate(expected):
            assert_same(found[k], each, f"{where}[{k}]")
    elif isinstance(expected, list):
        np.testing.assert_allclose(np.array(found, dtype=float), np.array(expected, dtype=float), rtol=1e-12, atol=0,
                                   err_msg=where)
    elif expected is None:
        assert found is None or math.isnan(found), where
    elif isinstance(expected, float):
        assert found == pytest.approx(expected, rel=1e-12, abs=0), where
    else:
        assert found == expected, where


def assert_same_model(model, expected):
    """The numbers of a model: parameters, coefficients, shapes."""
    numbers = {each.name: each.value for each in model.numbers}
    assert numbers == pytest.approx({name: value for group in ("parameters", "coefficients", "shapes")
                                     for name, value in expected.get(group, {}).items()}, rel=1e-12, abs=0)


def test_the_rule_sees_a_difference():
    class Found:
        x, rows = 1.0, [1.0, 2.0]
    assert_same(Found, {"x": 1.0, "rows": [1.0, 2.0]})
    for wrong in ({"x": 1.0 + 1e-11}, {"rows": [1.0, 2.0 + 1e-11]}, {"rows": [1.0]}, {"y": 1.0}):
        with pytest.raises((AssertionError, AttributeError)):
            assert_same(Found, wrong)


@pytest.mark.parametrize("options", [{}, {"integration_horizon": 0.5, "memory": 3.0}, {"preset": "paper"}],
                         ids=["as measured", "as set", "paper"])
def test_identify(program, tmp_path, rough_bag, options):
    settings = [word for name, value in options.items() for word in ("--set", f"{name}={value}")]
    found = shm.identify(rough_bag, **options)
    assert_same(found, said(program, tmp_path, "identify", rough_bag, *settings))
    assert found.estimate.valid and found.rejected == {name: n for name, n in found.rejected.items() if n > 0}


def test_identify_a_part_with_effects_and_topics(program, tmp_path, rough_bag):
    flags = ["--start", "20", "--end", "80", "--sprung-topic", "/sprung/imu"]
    found = shm.identify(rough_bag, start=20, end=80, sprung_topic="/sprung/imu", effects=["quadratic_damping"])
    assert_same(found, said(program, tmp_path, "identify", rough_bag, *flags, "--set", "effects=quadratic_damping"))
    assert found.estimate.valid, "effects are columns of it"


def test_compare(program, tmp_path, rough_bag):
    found = shm.compare(rough_bag)
    expected = said(program, tmp_path, "compare", rough_bag)
    expected["free_run"].update(held_out_rmse=found.free_run.rmse)  # an attribute of the comparison itself
    held_out = json.loads((tmp_path / "result.json").read_text())["free_run"]["held_out_rmse"]
    assert found.held_out_rmse == pytest.approx(held_out, rel=1e-12)
    expected["free_run"].pop("held_out_rmse")
    expected["one_step"].pop("horizon_samples")
    model = expected.pop("model")
    assert_same(found, expected)
    assert_same_model(found.model, model)
    assert found.free_run.fit_percent == pytest.approx(expected["free_run"]["fit_percent"], rel=1e-12)


def test_diagnose_and_compare_with_what_was_found(program, tmp_path, searched_bag):
    found = shm.diagnose(searched_bag)
    expected = said(program, tmp_path, "diagnose", searched_bag, "-o", tmp_path / "model.yaml")
    assert found.verdict == "effect_found" and found.selected == ["quadratic_damping"]
    assert_same(found, expected)
    for ranked, row in zip(found.ranking, expected["ranking"]):
        assert_same_model(ranked.model, row)
    assert_same_model(found.model, expected["extended"])
    assert found.extended_fit_percent == pytest.approx(expected["extended"]["fit_percent"], rel=1e-12)
    assert found.final_fit.stddev == pytest.approx(list(expected["extended"]["stddevs"].values()), rel=1e-12) or \
        sorted(found.final_fit.stddev) == pytest.approx(sorted(expected["extended"]["stddevs"].values()), rel=1e-12)
    assert found.model.yaml() == (tmp_path / "model.yaml").read_text()
    compared = said(program, tmp_path, "compare", searched_bag, "--model", tmp_path / "model.yaml")
    for model in (found.model, tmp_path / "model.yaml"):
        assert shm.compare(searched_bag, model=model).free_run.rmse == \
            pytest.approx(compared["free_run"]["rmse"], rel=1e-12)


def test_how_the_strut_is_against_nominal_values(program, tmp_path, searched_bag):
    """The sentence of the command line, of bags and of arrays."""
    nominal = {"nominal_damping_to_mass": 9.0, "integration_horizon": 0.25, "sample_period": 0.01}
    settings = [f"--set={name.replace('nominal_', 'nominal/')}={value}" for name, value in nominal.items()]
    for command, call in (("identify", shm.identify), ("diagnose", shm.diagnose)):
        found = call(bag=searched_bag, **nominal)
        assert re.match(r"the strut, .*: damping \d\d % below nominal", found.change)
        assert found.change == said(program, tmp_path, command, searched_bag, *settings)["change"]
        assert call(*arrays_of(searched_bag), **nominal).change == found.change
        assert found.change in found._repr_html_()
    assert shm.identify(searched_bag).change == ""


@pytest.mark.parametrize("options", [{"nominal_damping_to_mass": 3.0}, {}], ids=["nominal", "learned"])
def test_health(program, tmp_path, worn_bag, options):
    settings = ["--set", "nominal/damping_to_mass=3"] if options else []
    found = shm.health(worn_bag, **options)
    expected = said(program, tmp_path, "health", worn_bag, *settings)
    early = expected.pop("early_warnings")
    assert_same(found, expected)
    assert len(found.early_warnings) == early
    assert found.counts["WARN"] == expected["warn_events"] and found.counts["ERROR"] == expected["error_events"]


def test_health_by_a_baseline(program, tmp_path, worn_bag):
    (tmp_path / "healthy.yaml").write_text(
        "damping_to_mass: 3.0\nstiffness_to_mass: 25.0\nfriction_damping_covariance: 0.0\n")
    expected = said(program, tmp_path, "health", worn_bag, "--baseline", tmp_path / "healthy.yaml")
    expected.pop("early_warnings")
    found = shm.health(worn_bag, baseline=tmp_path / "healthy.yaml")
    assert_same(found, expected)
    assert found.reference.startswith(f"the baseline of {tmp_path / 'healthy.yaml'}: damping/mass 3 1/s")


def test_health_by_what_somebody_has_given(program, tmp_path, worn_bag):
    expected = said(program, tmp_path, "health", worn_bag, "--set", "nominal/damping_to_mass=3", "--set",
                    "nominal/stiffness_to_mass=25")
    expected.pop("early_warnings")
    settings = tmp_path / "settings.yaml"
    settings.write_text("nominal: {damping_to_mass: 3, stiffness_to_mass: 25}\nsprung_axis: z\n")
    given = shm.Baseline(damping_to_mass=3.0, stiffness_to_mass=25.0)
    for found in (shm.health(worn_bag, baseline=given), shm.health(worn_bag, baseline=settings)):
        assert_same(found, expected)
        assert found.reference == "nominal values: damping/mass 3 1/s, stiffness/mass 25 1/s^2"
    for healthy in (given, settings):
        with pytest.raises(ValueError, match="nominal values are both given, must be one of them"):
            shm.health(worn_bag, baseline=healthy, nominal_damping_to_mass=3.0)


def test_health_by_what_an_earlier_drive_has_taught(worn_bag):
    """As arrays, whose stamps begin before 0, as well: these are no part of what the earlier drive was."""
    learned = shm.health(worn_bag, end=40, baseline_learn_time=20).baseline
    # Its first estimate knows the two blocks of 4 s before it.
    assert learned.learned and 20.0 - 8.0 <= learned.learned_to - learned.learned_from + 1e-6 < 40.0
    stamps_body, body, stamps_wheel, wheel = arrays_of(worn_bag)
    early = stamps_body[0] + 10**12
    for found in (shm.health(worn_bag, baseline=learned),
                  shm.health(stamps_body - early, body, stamps_wheel - early, wheel, baseline=learned)):
        assert found.reference.startswith(
            f"the baseline learned from {learned.learned_from:.2f} s to {learned.learned_to:.2f} s: ")
        assert "baseline" in found.end.message
        assert (found.baseline.learned_from, found.baseline.learned_to) == (learned.learned_from, learned.learned_to)


def arrays_of(bag):
    """Stamps [ns] and accelerations of both topics."""
    streams = {imu_bag.SPRUNG: [], imu_bag.UNSPRUNG: []}
    with imu_bag.rosbag.Bag(str(bag)) as file:
        for topic, message, _ in file.read_messages(list(streams)):
            streams[topic].append((message.header.stamp.to_nsec(), message.linear_acceleration.z))
    return [np.array(column) for stream in streams.values() for column in zip(*stream)]


def test_arrays_are_the_bag(searched_bag):
    """The same period, horizon and search: the same numbers, from the readings themselves."""
    arrays = arrays_of(searched_bag)
    for options in ({"integration_horizon": 0.5, "sample_period": 0.01},):
        from_bag, from_arrays = shm.identify(searched_bag, **options), shm.identify(*arrays, **options)
        for name in ("estimate", "ls", "la"):
            for number in ("damping_to_mass", "stiffness_to_mass", "damping_to_mass_stddev"):
                assert getattr(getattr(from_arrays, name), number) == \
                    pytest.approx(getattr(getattr(from_bag, name), number), rel=1e-12)
        assert from_arrays.rejected == from_bag.rejected
        assert shm.diagnose(*arrays, **options).base.held_out_rmse == \
            pytest.approx(shm.diagnose(searched_bag, **options).base.held_out_rmse, rel=1e-12)
        assert shm.compare(*arrays, **options).free_run.rmse == \
            pytest.approx(shm.compare(searched_bag, **options).free_run.rmse, rel=1e-12)
    healthy = {"nominal_damping_to_mass": 4.0}
    assert [(e.time, e.level, e.message) for e in shm.health(*arrays, **healthy).events] == \
        [(e.time, e.level, e.message) for e in shm.health(searched_bag, **healthy).events]


def test_simulated_arrays_are_the_simulated_bag(tmp_path):
    options = {"dropout": 0.01, "clock_offset": 0.003, "body_acceleration": 1.0, "duration": 20.0, **ROUGH}
    shm.simulate(tmp_path / "drive.bag", effect=["coulomb_friction=0.2,vs=0.05", "scale_error=0.1"], **options)
    made = shm.simulate(effect=["coulomb_friction=0.2,vs=0.05", "scale_error=0.1"], **options)
    stamps_body, body, stamps_wheel, wheel = arrays_of(tmp_path / "drive.bag")
    np.testing.assert_array_equal(made.body, body)
    np.testing.assert_array_equal(made.wheel, wheel)
    np.testing.assert_allclose(made.stamps_body, 1e-9 * stamps_body, rtol=0, atol=2e-9)
    np.testing.assert_allclose(made.stamps_wheel, 1e-9 * stamps_wheel, rtol=0, atol=2e-9)
    assert made.across.shape == (len(body), 4) and np.isnan(made.across[:, 2:]).all()


LAWS = """effects:
  second_spring:
    force: "max(0, d - gap)^2"
    unit: "1/(m s^2)"
    finding: second spring engages
    shapes: {gap: {unit: m, scale: travel, min: 0.2, max: 3}}
"""


def test_laws_of_ones_own(tmp_path):
    laws = tmp_path / "laws.yaml"
    laws.write_text(LAWS)
    assert {each.name for each in shm.effects(laws)} - {each.name for each in shm.effects()} == {"second_spring"}
    hidden = {"effect": "second_spring=4000,gap=0.01", "effects_file": laws, "duration": 60.0, **ROUGH}
    shm.simulate(tmp_path / "drive.bag", **hidden)
    drive = shm.simulate(**hidden)
    for found in (shm.diagnose(drive, effects_file=laws), shm.diagnose(tmp_path / "drive.bag", effects_file=laws)):
        assert found.selected == ["second_spring"]
        for of in (drive, tmp_path / "drive.bag"):
            assert shm.compare(of, model=found.model, effects_file=laws).free_run.rmse < \
                0.8 * shm.compare(of).free_run.rmse
            assert shm.identify(of, model=found.model, effects_file=laws).estimate.valid


def test_a_file_of_settings_of_a_robot_is_for_arrays_too(tmp_path, rough_bag):
    """What is about its messages has no meaning there; what changes the result is refused."""
    file = tmp_path / "strut.yaml"
    file.write_text("sprung_axis: z\ntarget_frame: strut\nsprung_range: 160\nexpected_rate: {sprung: 100}\nmax_lag: 0.1\n"
                    "publish_every: 5\ndiagnose: {window: 60}\ntyre: {road_axis: y}\ninput_timeout: 3\nmemory: 5\n"
                    "nominal: {damping_to_mass: 4}\n")
    arrays = arrays_of(rough_bag)
    by_file, by_name = shm.health(*arrays, config=file), shm.health(*arrays, memory=5, nominal_damping_to_mass=4)
    assert by_file.la.damping_to_mass == by_name.la.damping_to_mass and by_file.reference == by_name.reference
    assert shm.StrutMonitor(config=file, sample_period=0.01).sample_period == 0.01
    for line, argument in (("baseline_file: b.yaml", "baseline"), ("model_file: m.yaml", "model"),
                           ("effects_file: l.yaml", "effects_file"), ("effects: [coulomb_friction]", "model")):
        file.write_text(line + "\n")
        with pytest.raises(ValueError, match=f"{line.split(':')[0]} is an option of .*for these there is {argument}="):
            shm.identify(*arrays, config=file)


def test_options_of_a_file(tmp_path, rough_bag):
    file = tmp_path / "strut.yaml"
    file.write_text("memory: 5\nintegration_horizon: 0.4\nhealth: {damping_warn: 0.1}\n")
    arrays = arrays_of(rough_bag)
    for drive in ((rough_bag,), arrays):
        by_name = shm.identify(*drive, memory=5, integration_horizon=0.3, health_damping_warn=0.1)
        by_file = shm.identify(*drive, config=file, integration_horizon=0.3)  # what is given beside it counts
        assert by_file.la.damping_to_mass == by_name.la.damping_to_mass and by_file.horizon_samples == 30
