"""identify with the paper's settings against the reference vectors of an independent program."""
import numpy as np
import pytest

import conftest
import imu_bag

REFERENCE = imu_bag.read_table(imu_bag.REFERENCE_FOLDER / "reference_paper.csv")
# Later rows of la amplify rounding, see test/core/paper_reference_test.cpp.
SENSITIVE = 1300

RECORDINGS = {
    "plain": dict(),
    "no gravity": dict(gravity=0.0),
    "stamps from 0": dict(start=0),
    "stamps from 0, no gravity": dict(start=0, gravity=0.0),
    "bz2": dict(compression="bz2"),
    "lz4": dict(compression="lz4"),
    "many chunks": dict(chunk_size=2000),
    "many chunks, bz2": dict(chunk_size=2000, compression="bz2"),
    "wheel first": dict(order="wheel first", chunk_size=20000),
    "one topic after the other": dict(order="one topic after the other"),
    "overlapping chunks": dict(order="one topic after the other", chunk_size=5000),
    "overlapping chunks, lz4": dict(order="one topic after the other", chunk_size=5000, compression="lz4"),
    "body recorded 1 s late": dict(order="body recorded 1 s late", chunk_size=5000),
}


def identify(program, folder, *bags, settings=("--config", conftest.PAPER_SETTINGS)):
    program.succeed("identify", *bags, *settings, "--csv", folder / "estimates.csv")
    return imu_bag.read_table(folder / "estimates.csv")


@pytest.mark.parametrize("recording", RECORDINGS.values(), ids=RECORDINGS.keys())
def test_estimates_equal_the_reference(program, tmp_path, recording):
    bag = imu_bag.write_bag(tmp_path / "drive.bag", imu_bag.paper_drive(), **recording)
    estimates = identify(program, tmp_path, bag)
    start = recording.get("start", 1_700_000_000)
    np.testing.assert_allclose(estimates["time"] - start, REFERENCE["time"], rtol=0, atol=1e-6)
    for name in ("damping_to_mass", "stiffness_to_mass"):
        ls, la = f"ls_{name}", f"la_{name}"
        np.testing.assert_allclose(estimates[ls], REFERENCE[ls], rtol=1e-6)
        np.testing.assert_allclose(estimates[la][:SENSITIVE], REFERENCE[la][:SENSITIVE], rtol=1e-6)
        np.testing.assert_allclose(estimates[la], REFERENCE[la], rtol=2e-4)


def test_the_preset_alone_is_the_paper(program, tmp_path, paper_bag):
    file, one_line = (identify(program, tmp_path, paper_bag, **settings)
                      for settings in ({}, {"settings": ("--set", "preset=paper")}))
    for name, column in file.items():
        np.testing.assert_array_equal(one_line[name], column)


def test_a_drive_in_two_bags_is_one_drive(program, tmp_path, paper_bag):
    drive = imu_bag.paper_drive()
    parts = [imu_bag.write_bag(tmp_path / f"{name}.bag", [column[part] for column in drive])
             for name, part in (("first", slice(0, 900)), ("second", slice(900, None)))]
    joined = identify(program, tmp_path, *parts)
    whole = identify(program, tmp_path, paper_bag)
    for name, column in whole.items():
        np.testing.assert_array_equal(joined[name], column)


def test_csv_holds_the_measurement_and_what_the_model_leaves(program, tmp_path, paper_bag):
    with_rows = identify(program, tmp_path, paper_bag)
    header = (tmp_path / "estimates.csv").read_text().split("\n", 1)[0]
    assert header == ("time,ls_damping_to_mass,ls_stiffness_to_mass,la_damping_to_mass,la_stiffness_to_mass,"
                      "measured,predicted,residual,estimate_damping_to_mass,estimate_stiffness_to_mass,"
                      "estimate_damping_to_mass_stddev,estimate_stiffness_to_mass_stddev")
    _, sprung, _ = imu_bag.paper_drive()
    np.testing.assert_array_equal(with_rows["measured"], sprung[60:] + 9.81)  # the first row is at sample 2 L
    predicts = np.isfinite(with_rows["predicted"])
    assert predicts.mean() > 0.8
    assert not predicts[-12:].any()  # the comparison is that late
    assert predicts[-13]
    np.testing.assert_array_equal(np.isfinite(with_rows["residual"]), predicts)
    np.testing.assert_allclose((with_rows["predicted"] + with_rows["residual"])[predicts],
                               with_rows["measured"][predicts], rtol=1e-12)
