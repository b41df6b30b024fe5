"""sample_period that is not the stamps': said, in the result as well, and refused where it makes no sense at all."""
import json
import math

import pytest

import imu_bag


@pytest.mark.parametrize("period", ["0.022", "0.018"])
def test_ls_and_la_with_a_wrong_period_are_not_valid(program, paper_bag, tmp_path, period):
    """The estimate goes by the stamps."""
    told = program.succeed("identify", paper_bag, "--set", f"sample_period={period}", "--json", tmp_path / "result.json")
    for word in ("warning: stamps come every 0.02 s", f"sample_period = {period}"):
        assert word in told
    written = json.loads((tmp_path / "result.json").read_text())
    assert not written["la"]["valid"] and not written["ls"]["valid"] and written["estimate"]["valid"]
    assert written["estimate"]["stiffness_to_mass"] == pytest.approx(13.8, rel=0.02)
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


@pytest.mark.parametrize("noise", [0.0, 0.024])  # [m/s^2]
def test_a_drive_that_ends_parked_keeps_what_it_has_learned(program, tmp_path, noise):
    times, sprung, unsprung = imu_bag.paper_drive()
    for k in range(1200, len(times)):
        sprung[k], unsprung[k] = (noise * math.sin(1e4 * j * j) for j in (k, k + len(times)))
    bag = imu_bag.write_bag(tmp_path / "drive.bag", (times, sprung, unsprung))
    program.succeed("identify", bag, "--set", "integration_horizon=0.6", "--json", tmp_path / "result.json")
    estimate = json.loads((tmp_path / "result.json").read_text())["estimate"]
    assert estimate["valid"] and estimate["age"] > times[-1] - times[1200] - 4.0  # the last block of 4 s that counts
    for name, truth in (("damping_to_mass", 3.0), ("stiffness_to_mass", 13.8)):
        assert abs(estimate[name] - truth) < 3 * estimate[f"{name}_stddev"] < 0.1 * truth
