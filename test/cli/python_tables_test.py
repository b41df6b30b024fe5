"""Drives as people have them: Series, DataFrames, instants with and without a time zone, arrays by name."""
import datetime

import numpy as np
import pytest

from python_module import ROUGH, shm

pandas = pytest.importorskip("pandas")

CALLS = [shm.identify, shm.compare, shm.diagnose, shm.health]
BERLIN = datetime.timezone(datetime.timedelta(hours=2))
SUMMER = np.datetime64("2026-05-01T10:00:00", "ns")


@pytest.fixture(scope="module")
def drive():
    """stamps [s], body, wheel [m/s^2], 30 s."""
    made = shm.simulate(duration=30.0, effect="quadratic_damping=1.6", **ROUGH)
    return made.stamps_body, made.body, made.wheel


@pytest.fixture(scope="module")
def instants(drive):
    """The same stamps as datetime64, UTC."""
    return SUMMER + np.round(1e9 * drive[0]).astype("timedelta64[ns]")


@pytest.fixture(scope="module")
def frame(drive):
    return pandas.DataFrame(dict(zip(("time", "body", "wheel"), drive)))


def assert_same(found, expected):
    """Bit for bit, of all attributes."""
    np.testing.assert_equal(shm.to_dict(found), shm.to_dict(expected))


def assert_same_recording(found, expected):
    for name in ("stamps_body", "body", "stamps_wheel", "wheel", "across"):
        np.testing.assert_array_equal(getattr(found, name), getattr(expected, name), err_msg=name)


@pytest.mark.parametrize("call", CALLS)
def test_frames_series_and_names_give_what_arrays_give(call, drive, frame):
    expected = call(*drive)
    assert_same(call(frame), expected)
    assert_same(call(frame.time, frame.body, frame.wheel), expected)
    assert_same(call(time=drive[0], body=drive[1], wheel=drive[2]), expected)


def test_a_frame_may_have_its_stamps_in_the_index_and_other_columns_beside(frame, drive, instants):
    expected = shm.Recording(*drive)
    assert_same_recording(shm.Recording(frame.assign(road="rough")[["road", "wheel", "body", "time"]]), expected)
    assert_same_recording(shm.Recording(frame.set_index("time")), expected)
    assert_same_recording(shm.Recording(frame.rename(columns={"time": "stamps"})), expected)
    readings = frame[["body", "wheel"]]
    assert_same_recording(shm.Recording(readings.set_index(pandas.to_timedelta(np.round(1e9 * drive[0]), unit="ns"))), expected)
    zoned = pandas.DatetimeIndex(instants, tz="UTC").tz_convert("Asia/Tokyo")
    assert_same_recording(shm.Recording(readings.set_index(zoned)), shm.Recording(instants, *drive[1:]))


def test_frames_are_taken_one_after_the_other(frame, drive):
    expected = shm.identify(*drive)
    parts = frame[:1500], frame[1500:]
    assert_same(shm.identify(*parts), expected)
    assert_same(shm.identify(list(parts)), expected)


def test_arrays_by_name_may_have_two_clocks_or_none(drive):
    stamps, body, wheel = drive
    by_name = shm.Recording(wheel=wheel, stamps_wheel=stamps, body=body, stamps_body=stamps)
    assert_same_recording(by_name, shm.Recording(stamps, body, stamps, wheel))
    assert_same_recording(shm.Recording(period=0.01, body=body, wheel=wheel), shm.Recording(0.01, body, wheel))


def test_missing_numbers_are_nan(drive, frame):
    holed = frame.astype("Float64")
    holed.loc[[500, 501], "body"] = pandas.NA
    holed.loc[7, "wheel"] = pandas.NA
    found = shm.identify(holed)
    assert found.rejected["not_finite"] == 3
    nanoseconds = pandas.Series(np.round(1e9 * drive[0]), dtype="Int64")
    assert_same(shm.identify(nanoseconds, holed.body, holed.wheel), found)
    nanoseconds[3] = pandas.NA
    with pytest.raises(ValueError, match=r"stamps\[3\] = nan, must be finite"):
        shm.identify(nanoseconds, frame.body, frame.wheel)


def as_text(instants, pattern):
    """pattern: of text, with {} in place of the instant as clocks of UTC + 2 h show it."""
    return [pattern.format(each) for each in instants + np.timedelta64(2, "h")]


def test_every_zone_gives_the_same_seconds(drive, instants):
    expected = shm.Recording(instants, *drive[1:])
    utc = pandas.Series(pandas.DatetimeIndex(instants, tz="UTC"))
    objects = list(utc.dt.to_pydatetime())
    for stamps in (utc, utc.dt.tz_convert("Europe/Berlin"), pandas.DatetimeIndex(utc.dt.tz_convert("America/New_York")),
                   list(utc), objects, [each.astimezone(BERLIN) for each in objects],
                   [each.replace(tzinfo=None) for each in objects], list(map(str, instants)),
                   [f"{each}Z" for each in instants], pandas.Series([f"{each} Z" for each in instants], dtype="string"),
                   as_text(instants, "{}+02:00"), as_text(instants, "{}+0200"), as_text(instants, "{}+02"),
                   [each.replace("T", " ").replace(".", ",") for each in as_text(instants, "{} +02:00")]):
        assert_same_recording(shm.Recording(stamps, *drive[1:]), expected)


def test_clocks_that_are_set_back_an_hour_go_on_in_utc():
    """In Berlin 02:30 comes twice on that day."""
    times = pandas.date_range("2026-10-25T00:00", periods=120, freq="min", tz="UTC").tz_convert("Europe/Berlin")
    recording = shm.Recording(times, np.zeros(120), np.zeros(120))
    assert set(np.diff(recording.stamps_body)) == {60 * 10**9}
    with pytest.raises(ValueError, match="stamps go back at 60"):
        shm.Recording(times.tz_localize(None), np.zeros(120), np.zeros(120))


def test_a_monitor_takes_instants_and_names_too(drive, instants):
    stamps, body, wheel = (array[:500] for array in (instants, *drive[1:]))
    whole, by_text, by_name = (shm.StrutMonitor(sample_period=0.01) for _ in range(3))
    whole.push(stamps, body, wheel)
    for each in zip(stamps, body, wheel):
        by_text.push(f"{each[0]}Z", *each[1:])
    by_name.push(pandas.DataFrame({"time": stamps, "body": body, "wheel": wheel})[:200])
    by_name.push(stamps=pandas.Series(stamps[200:]).dt.tz_localize("UTC"), body=body[200:], wheel=wheel[200:])
    assert_same(by_text.report, whole.report)
    assert_same(by_name.report, whole.report)


def test_columns_of_a_vehicle_go_by_name(drive):
    stamps, body, wheel = drive
    columns = {"left": (body, wheel), "right": (1.1 * body, 0.9 * wheel)}

    def vehicle():
        return shm.VehicleMonitor(["left", "right"], sample_period=0.01)
    by_order, by_name = vehicle(), vehicle()
    by_order.push(stamps, *(np.column_stack([columns[name][k] for name in ("left", "right")]) for k in (0, 1)))
    by_name.push(stamps, *(pandas.DataFrame({name: columns[name][k] for name in ("right", "left")}) for k in (0, 1)))
    assert_same(by_name.reports, by_order.reports)
    with pytest.raises(ValueError, match="wheel has the columns right, must have left, right"):
        by_name.push(stamps, np.zeros((len(body), 2)), pandas.DataFrame({"right": wheel}))


def test_what_the_imu_measures_across_goes_by_name(drive):
    across = np.arange(4.0 * len(drive[0])).reshape(-1, 4)
    names = ["a_x", "a_y", "w_x", "w_y"]
    frame = pandas.DataFrame(across, columns=names)
    assert_same_recording(shm.Recording(*drive, across=frame[names[::-1]]), shm.Recording(*drive, across=across))


N = [0.0] * 30


@pytest.mark.parametrize("call, words", [
    (lambda: shm.identify(period=0.01, body=N), r"^given: period, body; must be stamps \(or time, or period\), body, wheel or"),
    (lambda: shm.identify(0.01, body=N, wheel=N), "^body, wheel are given by name and 0.01 in order, must be all"),
    (lambda: shm.identify(time=N, stamps=N, body=N, wheel=N), "^given: time, stamps, body, wheel; must be"),
    (lambda: shm.identify(road=N, stamps_road=N), "^given: nothing; must be"),
    (lambda: shm.identify(pandas.DataFrame({"t": N, "body": N, "wheel": N})),
     "^a DataFrame has the columns t, body, wheel, must have stamps .*; rename columns"),
    (lambda: shm.identify(pandas.DataFrame({"t": N, "body": N, "wheel": N}).set_index("t")),
     "^a DataFrame has the columns body, wheel and the index t, must have stamps"),
    (lambda: shm.identify(pandas.Series(["a"] * 30), N, N), r"stamps\[0\] = 'a', must be a datetime, or a date as text"),
    (lambda: shm.identify([pandas.NaT] * 30, N, N), r"stamps\[0\] = NaT, must be a time"),
    (lambda: shm.identify(0.01, pandas.Series(["a"] * 30), N), "body is of type object, must be real numbers"),
    (lambda: shm.identify(pandas.DataFrame({"time": N, "body": N, "wheel": N}), start=3), "start is an option of bags")])
def test_errors_say_what_was_given_and_what_is_allowed(call, words):
    with pytest.raises(ValueError, match=words):
        call()
