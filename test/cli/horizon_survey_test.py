"""The horizon that identify proposes: as soon as the drive tells it, wherever it is rough."""
import json

import numpy as np
import pytest

import imu_bag

ROUGH = 1200  # samples of the paper's drive before readings are lost
LONG = 45000  # samples


def proposed(program, tmp_path, drive):
    result = tmp_path / "result.json"
    bag = imu_bag.write_bag(tmp_path / "drive.bag", drive)
    program("identify", bag, "--json", result)
    return json.loads(result.read_text())["horizon_samples"]


@pytest.fixture(scope="module")
def expected(program, tmp_path_factory):
    return proposed(program, tmp_path_factory.mktemp("rough"), [column[:ROUGH] for column in imu_bag.paper_drive()])


@pytest.mark.parametrize("begin", [0, 30000, LONG - ROUGH])
def test_a_parked_drive_with_a_short_rough_part_gets_the_horizon_of_that_part(program, tmp_path, expected, begin):
    noise = np.random.default_rng(1).normal(0.0, 1e-3, (2, LONG))
    for row, column in zip(noise, imu_bag.paper_drive()[1:]):
        row[begin:begin + ROUGH] += column[:ROUGH]
    assert proposed(program, tmp_path, (0.02 * np.arange(LONG), *noise)) == pytest.approx(expected, rel=0.05)
