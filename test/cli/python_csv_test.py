"""read_csv(): the same readings as the arrays that the file was written from; units, dates and what it says of the rest."""
import os
import re
import subprocess
import sys

import numpy as np
import pytest

from python_module import ROUGH, shm

GRAVITY = 9.80665  # [m/s^2], in a g


@pytest.fixture(scope="module")
def made():
    return shm.simulate(duration=20.0, **ROUGH)


@pytest.fixture
def file(made, tmp_path):
    """With the header of NumPy: # time,body,wheel."""
    np.savetxt(tmp_path / "drive.csv", np.column_stack([made.stamps_body, made.body, made.wheel]), delimiter=",",
               header="time,body,wheel")
    return tmp_path / "drive.csv"


def write(folder, *lines):
    (folder / "some.csv").write_text("\n".join(lines) + "\n")
    return folder / "some.csv"


def assert_same_recording(found, expected):
    for name in ("stamps_body", "body", "stamps_wheel", "wheel"):
        np.testing.assert_array_equal(getattr(found, name), getattr(expected, name), err_msg=name)


@pytest.mark.parametrize("call", [shm.identify, shm.compare, shm.diagnose, shm.health])
def test_a_file_gives_what_its_arrays_give(call, file, made):
    expected = call(made.stamps_body, made.body, made.wheel)
    np.testing.assert_equal(shm.to_dict(call(shm.read_csv(file))), shm.to_dict(expected))


def test_columns_go_by_name_or_number(file, made, tmp_path):
    expected = shm.Recording(made.stamps_body, made.body, made.wheel)
    lines = file.read_text().splitlines()
    renamed = write(tmp_path, "logger 7, firmware 3", "", "t [s],no use,top", *(f"{line},9" for line in lines[1:]))
    assert_same_recording(shm.read_csv(renamed, time="t [s]", body="no use", wheel="top"), expected)
    for headless in (file, write(tmp_path, *lines[1:])):
        assert_same_recording(shm.read_csv(headless, time=0, body=1, wheel=2), expected)
    swapped = shm.read_csv(file, body="wheel", wheel=1)
    assert_same_recording(swapped, shm.Recording(made.stamps_body, made.wheel, made.body))


def test_units_are_converted_when_asked_only(file, made):
    in_g = shm.read_csv(file, acceleration_unit="g")
    np.testing.assert_array_equal(in_g.body, GRAVITY * made.body)
    np.testing.assert_array_equal(in_g.wheel, GRAVITY * made.wheel)
    np.testing.assert_array_equal(shm.read_csv(file).body, made.body)


@pytest.mark.parametrize("unit, digits", [("s", 9), ("ms", 6), ("us", 3), ("ns", 0)])
def test_times_of_every_unit_are_kept_to_the_nanosecond(unit, digits, tmp_path):
    """Of today's clocks, where a float is 200 ns coarse."""
    nanoseconds = 1777636800123456789 + 10000001 * np.arange(50)
    whole, part = np.divmod(nanoseconds, 10**digits)
    times = [f"{a}.{b:0{digits}d}" if digits else str(a) for a, b in zip(whole, part)]
    path = write(tmp_path, "time,body,wheel", *(f"{time},1,2" for time in times))
    np.testing.assert_array_equal(shm.read_csv(path, time_unit=unit).stamps_body, nanoseconds)


def test_dates_and_signs_of_other_countries(tmp_path):
    path = write(tmp_path, "time;body;wheel", "2026-05-01 12:00:00,25+02:00;1,5;-2", "2026-05-01T10:00:00,5Z;2,5;-3")
    recording = shm.read_csv(path, delimiter=";", decimal=",")
    expected = shm.Recording(["2026-05-01T10:00:00.25", "2026-05-01T10:00:00.5"], [1.5, 2.5], [-2.0, -3.0])
    assert_same_recording(recording, expected)


def test_an_empty_cell_is_no_reading_and_nan_is_one(tmp_path):
    """As files are, into which two sensors write in turn; the last line was cut off."""
    path = write(tmp_path, "time,body,wheel,other", "0.00,1,", "0.01,,2", "0.02,nan,", "0.03,,4", "", "0.04,5")
    recording = shm.read_csv(path)
    assert_same_recording(recording, shm.Recording([0.0, 0.02, 0.04], [1.0, np.nan, 5.0], [0.01, 0.03], [2.0, 4.0]))
    two = write(tmp_path, "time,body,its time,wheel", "0,1,0.5,2", "1,3,1.5,4", "2,5,,")
    assert_same_recording(shm.read_csv(two, time_wheel="its time"),
                          shm.Recording([0.0, 1.0, 2.0], [1.0, 3.0, 5.0], [0.5, 1.5], [2.0, 4.0]))


LINES = "time,body,wheel", "0,1,2", "0.01,3,x"


@pytest.mark.parametrize("lines, options, words", [
    (LINES, {}, "some.csv, line 3: wheel = 'x', must be a number$"),
    (("time,body,wheel", "0,1,2", "noon,3,4"), {}, "line 3: time = 'noon', must be a number or, in all lines, a date such as"),
    (("time,body,wheel", "2026-05-01,1,2", "7,3,4"), {}, "line 3: time = '7', must be"),
    (("time,body,wheel", "1e99,1,2"), {}, "line 2: time = '1e99', must be"),
    (("time,body,wheel", ",1,2"), {}, "line 2: time = '', must be"),
    (LINES, {"time": "t"}, "has no line with the columns t, body, wheel; its first line is 'time, body, wheel'"),
    (LINES, {"wheel": 3, "time": 0, "body": 1}, "has no line with the columns 0, 1, 3"),
    (LINES, {"delimiter": ";"}, "its first line is 'time,body,wheel'.* delimiter= name"),
    ((), {}, "has no line with the columns time, body, wheel"),
    (LINES[:1], {}, "body is empty, must hold readings"),
    (LINES, {"time": None}, "a column is None, must be a name in the header, or a number from 0"),
    (LINES, {"time": -1}, "a column is -1, must be"),
    (LINES, {"time_unit": "min"}, "time_unit = 'min', must be one of s, ms, us, ns"),
    (LINES, {"acceleration_unit": "G"}, "acceleration_unit = 'G', must be one of m/s\\^2, g"),
    (LINES, {"delimiter": ", "}, "delimiter = ', ', must be one character")])
def test_what_cannot_be_read_is_told_by_line_and_column(lines, options, words, tmp_path):
    with pytest.raises(ValueError, match=words):
        shm.read_csv(write(tmp_path, *lines), **options)


def test_files_that_are_no_csv(tmp_path, made):
    (tmp_path / "binary").write_bytes(bytes(range(1, 256)) * 100)
    for path, words in ((tmp_path / "none.csv", "none.csv cannot be read: No such file"),
                        (tmp_path, "cannot be read: Is a directory"),
                        (tmp_path / "binary", "has no line with the columns time, body, wheel")):
        with pytest.raises(ValueError, match=words):
            shm.read_csv(path)


@pytest.mark.parametrize("call", [shm.identify, shm.compare, shm.diagnose, shm.health])
def test_a_csv_file_taken_for_a_bag_is_sent_to_read_csv(call, file):
    for given in ((file,), (str(file),), ([file, file],)):
        with pytest.raises(ValueError, match=rf"^{re.escape(str(file))} is no bag: a CSV file is read by read_csv\('{re.escape(str(file))}'\)"):
            call(*given)


def test_pandas_is_not_loaded(file):
    program = f"import sys, suspension_health_monitor as shm; shm.identify(shm.read_csv({str(file)!r}), " \
        "integration_horizon=0.3); print('pandas' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, env=dict(os.environ),
                          check=True, timeout=600).stdout == "False\n"
