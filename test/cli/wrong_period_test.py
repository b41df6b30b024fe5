"""sample_period that is not the stamps': said, in the result as well, and refused where it makes no sense at all."""
import json
import math

import pytest

import imu_bag


@pytest.mark.parametrize("period", ["0.022", "0.018"])
def test_estimates_with_a_wrong_period_are_not_valid(program, paper_bag, tmp_path, period):
    result = program("identify", paper_bag, "--set", f"sample_period={period}", "--json", tmp_path / "result.json")
    assert result.returncode == 4
    for word in ("stamps come every 0.02 s", f"sample_period = {period}"):
        assert word in result.stderr
    written = json.loads((tmp_path / "result.json").read_text())
    assert not written["la"]["valid"] and not written["ls"]["valid"]
    assert written["mean_period"] == pytest.approx(0.02)
    assert len(written["warnings"]) == 1 and f"sample_period = {period}" in written["warnings"][0]


def test_the_right_period_has_no_warning(program, paper_bag, tmp_path):
    program.succeed("identify", paper_bag, "--set", "sample_period=0.02", "--json", tmp_path / "result.json")
    assert json.loads((tmp_path / "result.json").read_text())["warnings"] == []


@pytest.mark.parametrize("settings", [["integration_horizon=1"], []])
def test_a_period_far_below_the_spacing_is_refused_at_once(program, paper_bag, tmp_path, settings):
    arguments = [part for setting in ("sample_period=1e-5", *settings) for part in ("--set", setting)]
    program.refuse(2, ["identify", paper_bag, *arguments], ["sample_period = 1e-05", "at least 0.002"], tmp_path)


@pytest.mark.parametrize("period, status", [(0.01, 0), (0.004, 4)])  # 0.02 s, interpolated; too far apart
def test_a_period_below_the_spacing_is_no_loss_of_readings(program, paper_bag, period, status):
    settings = ["--set", f"sample_period={period}", "--set", "integration_horizon=0.6"]
    result = program("identify", paper_bag, *settings)
    assert result.returncode == status, result.stderr
    text = result.stdout + result.stderr
    assert f"readings come every 0.02 s (50 Hz), but sample_period = {period} [s]" in text
    assert "lost" not in text


def test_an_end_without_a_valid_estimate_is_too_little(program, tmp_path):
    times, sprung, unsprung = imu_bag.paper_drive()
    sprung[1200:] = unsprung[1200:] = 0.0  # parked, without noise
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times, sprung, unsprung))
    result = program("identify", bag, "--set", "integration_horizon=0.6", "--json", tmp_path / "result.json")
    assert result.returncode == 4
    assert "no estimate is valid at the end" in result.stderr
    assert not json.loads((tmp_path / "result.json").read_text())["la"]["valid"]
    assert program("identify", bag, "--set", "integration_horizon=0.6", "--end", "20").returncode == 0


def test_a_drive_that_ends_parked_keeps_what_it_has_learned(program, tmp_path):
    times, sprung, unsprung = imu_bag.paper_drive()
    noise = [0.024 * math.sin(1e4 * k * k) for k in range(2 * len(times))]
    for k in range(1200, len(times)):
        sprung[k], unsprung[k] = noise[k], noise[k + len(times)]
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times, sprung, unsprung))
    result = program("identify", bag, "--set", "integration_horizon=0.6", "--json", tmp_path / "result.json")
    assert result.returncode == 0, result.stderr
    assert "parked: no excitation" in result.stdout
    la = json.loads((tmp_path / "result.json").read_text())["la"]
    assert not la["valid"]
    assert la["damping_to_mass"] == pytest.approx(3.0, rel=0.1)
