"""Sensors as they really come: 200 Hz and 333 Hz, out of step, readings up to 1 ms late, 2 % of them lost, and the body's
pitched by 5 degrees."""
import json

import pytest

import mount_test

DRIVE = ["--rate", "200", "--duration", "60"]
AS_IT_COMES = ["--set", "unsprung_rate=333", "--set", "unsprung_phase=0.0011", "--set", "sampling_jitter=0.001",
               "--set", "dropout=0.02"]


@pytest.fixture(scope="module", params=["paper_clean", "iso_road"])
def bags(program, tmp_path_factory, request):
    """The same drive by ideal sensors and by real ones. Not to be written to."""
    folder = tmp_path_factory.mktemp("bags")
    drive = ["simulate", "--scenario", request.param, *DRIVE]
    program.succeed(*drive, "-o", folder / "ideal.bag")
    program.succeed(*drive, *AS_IT_COMES, "-o", folder / "real.bag")
    return {name: folder / f"{name}.bag" for name in ("ideal", "real")}


def run(program, tmp_path, command, bag, *arguments):
    result = tmp_path / "result.json"
    program.succeed(command, bag, *arguments, "--json", result)
    return json.loads(result.read_text())


def test_estimates_are_within_two_percent_of_those_from_ideal_readings(program, tmp_path, bags):
    settings = ["--set", "forgetting_factor=0.9995", "--set", "integration_horizon=0.4"]
    ideal, real = (run(program, tmp_path, "identify", bags[name], *settings) for name in ("ideal", "real"))
    assert ideal["alignment"] == "paired"
    assert real["alignment"].startswith("resampled because") and "rates differ" in real["alignment"]
    assert real["bridged"] == pytest.approx(0.02 * 60 * (200 + 333), rel=0.25)
    assert real["gaps"] <= 10 and ideal["gaps"] == 0
    assert real["estimate"]["valid"]
    for estimator in ("estimate", "ls", "la"):
        for parameter in ("damping_to_mass", "stiffness_to_mass"):
            assert real[estimator][parameter] == pytest.approx(ideal[estimator][parameter], rel=0.02)


def test_pitched_sensor_of_the_body_is_turned_back_by_its_static_transform(program, tmp_path, bags):
    bag = mount_test.write_turned(bags["real"], tmp_path / "pitched.bag", mount_test.PITCH, 0.0)
    settings = ["--set", "forgetting_factor=0.9995", "--set", "integration_horizon=0.4"]
    ideal = run(program, tmp_path, "identify", bags["ideal"], *settings)
    real = run(program, tmp_path, "identify", bag, *settings, "--set", "target_frame=strut")
    assert real["estimate"]["valid"]
    for estimator in ("estimate", "ls", "la"):
        for parameter in ("damping_to_mass", "stiffness_to_mass"):
            assert real[estimator][parameter] == pytest.approx(ideal[estimator][parameter], rel=0.02)


def test_compare_finds_no_more_error_than_in_ideal_readings(program, tmp_path, bags):
    ideal, real = (run(program, tmp_path, "compare", bags[name]) for name in ("ideal", "real"))
    assert real["free_run"]["rmse"] < 1.1 * ideal["free_run"]["rmse"]
    assert real["noise_floor"] == pytest.approx(ideal["noise_floor"], rel=0.1)  # resampled noise is still white
    assert abs(real["structured_share"] - ideal["structured_share"]) < 0.1


def test_paired_on_request(program, tmp_path, bags):
    assert run(program, tmp_path, "identify", bags["ideal"], "--set", "alignment=paired")["alignment"] == "paired"
    assert run(program, tmp_path, "identify", bags["ideal"], "--set", "alignment=resampled")["alignment"] == "resampled"
    program.refuse(2, ["identify", bags["ideal"], "--set", "alignment=both"], ["alignment", "both", "resampled"], tmp_path)
