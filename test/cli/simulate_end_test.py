"""How simulate ends when it cannot go on: a strut that runs away or is too stiff. Nothing is left of the bag."""
import pytest

DRIVE = ["simulate", "--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100"]


@pytest.mark.parametrize("effect, words", [
    ("quadratic_damping=-50", ["quadratic_damping = -50", "unstable"]),
    ("clock_offset=0.01", None),
    ("coulomb_friction=1,vs=1e-9", ["coulomb_friction = 1, vs = 1e-09", "too stiff"]),
    ("hysteresis=1,x=1e-9", ["hysteresis = 1, x = 1e-09", "too stiff"])])
def test_a_strut_that_cannot_be_simulated_is_refused(program, tmp_path, effect, words):
    arguments = [*DRIVE, "--duration", "30", "--effect", effect, "-o", tmp_path / "drive.bag"]
    if words is None:
        program.succeed(*arguments)
    else:
        program.refuse(2, arguments, words, tmp_path)


def test_unknown_effect_lists_faults_of_the_reading_too(program, tmp_path):
    program.refuse(2, [*DRIVE, "--effect", "fooo=1", "-o", tmp_path / "drive.bag"],
                   ["fooo", "quadratic_damping", "clock_offset", "accelerometer_bias", "scale_error", "mount_tilt",
                    "lever_arm"], tmp_path)


def test_two_rates_are_both_told(program, tmp_path):
    told = program.succeed("simulate", "--duration", "2", "--rate", "1000", "--set", "unsprung_rate=50",
                           "-o", tmp_path / "drive.bag")
    assert "1000 Hz (sprung) and 50 Hz (unsprung)" in told
    assert "at 40 Hz," in program.succeed("simulate", "--duration", "2", "--rate", "40", "-o", tmp_path / "drive.bag")
