"""What the Python module takes: shapes, types, stamps, names of options; and what it says of the rest."""
import math

import numpy as np
import pytest

from python_module import ROUGH, shm

OPTIONS = {"sample_period": 0.01, "integration_horizon": 0.3}


@pytest.fixture(scope="module")
def drive():
    """stamps [s], body, wheel [m/s^2], 20 s."""
    made = shm.simulate(duration=20.0, **ROUGH)
    return made.stamps_body, made.body, made.wheel


def numbers(found):
    return found.la.damping_to_mass, found.la.stiffness_to_mass, found.estimate.damping_to_mass, found.rows


def test_one_stamp_or_two_or_a_period_or_nanoseconds(drive):
    stamps, body, wheel = drive
    expected = numbers(shm.identify(stamps, body, wheel, **OPTIONS))
    nanoseconds = np.round(1e9 * stamps).astype(np.int64)
    for arrays in ((stamps, body, stamps, wheel), (0.01, body, wheel), (nanoseconds, body, wheel),
                   (nanoseconds.astype("datetime64[ns]"), body, wheel), (list(stamps), list(body), list(wheel)),
                   (stamps - 7.0, body, wheel), (stamps[::1], np.repeat(body, 2)[::2], wheel),
                   (shm.Recording(stamps, body, wheel),), ([shm.Recording(stamps, body, wheel)],)):
        assert numbers(shm.identify(*arrays, **OPTIONS)) == expected


def test_single_precision_is_read_as_it_is(drive):
    stamps, body, wheel = drive
    rough = shm.identify(stamps, body.astype(np.float32), wheel.astype(np.float32), **OPTIONS)
    assert rough.la.stiffness_to_mass == pytest.approx(shm.identify(*drive, **OPTIONS).la.stiffness_to_mass, rel=1e-4)


def test_gravity_and_stamps_shift_nothing_but_time(drive):
    stamps, body, wheel = drive
    here, there = shm.identify(*drive, **OPTIONS), shm.identify(stamps + 100.0, body, wheel, **OPTIONS)
    np.testing.assert_allclose(there.course.time - here.course.time, 100.0, rtol=0, atol=1e-6)
    np.testing.assert_array_equal(there.course.damping_to_mass, here.course.damping_to_mass)
    assert here.course.time[-1] == pytest.approx(stamps[-1], abs=1e-9)


def test_swapped_sensors_are_no_strut(drive):
    stamps, body, wheel = drive
    with pytest.raises(ValueError, match="no estimate is valid.* swapped, or not in m/s"):
        shm.identify(stamps, wheel, body)
    with pytest.raises(ValueError, match="no estimate is valid.* damping is negative"):
        shm.identify(stamps, body, -wheel)


def test_readings_that_are_no_numbers_are_counted(drive):
    stamps, body, wheel = drive
    holed = body.copy()
    holed[[500, 501, 900]] = np.nan
    found = shm.identify(stamps, holed, wheel, **OPTIONS)
    assert found.rejected["not_finite"] == 3 and found.gaps == 2 and found.la.valid
    assert shm.diagnose(stamps, holed, wheel).base.held_out_rmse > 0.0


def test_several_recordings_are_taken_one_after_the_other(drive):
    stamps, body, wheel = drive
    first, second = (shm.Recording(stamps[part], body[part], wheel[part]) for part in (slice(0, 900), slice(900, None)))
    joined = shm.identify(first, second, **OPTIONS)
    assert numbers(joined) == numbers(shm.identify([first, second], **OPTIONS)) == \
        numbers(shm.identify(*drive, **OPTIONS))


def test_a_recording_keeps_what_it_was_given(drive):
    arrays = [array.copy() for array in drive]
    across = np.zeros((len(arrays[0]), 4))
    recording = shm.Recording(*arrays, stamps_road=arrays[0], road=arrays[2], across=across)
    expected = [array.copy() for array in (recording.stamps_body, recording.body, recording.wheel, recording.road, recording.across)]
    nanoseconds = np.round(1e9 * arrays[0]).astype(np.int64)
    whole = shm.Recording(nanoseconds, arrays[1], arrays[2])
    for array in (*arrays, across, nanoseconds):
        array[:] = 7
    for now, before in zip((recording.stamps_body, recording.body, recording.wheel, recording.road, recording.across), expected):
        np.testing.assert_array_equal(now, before)
    np.testing.assert_array_equal(whole.stamps_body, expected[0])


@pytest.mark.parametrize("unit, words", [(1e2, "one every 1e-09 s"), (1e3, "one every 1e-08 s"), (1e6, "one every 1e-05 s")])
@pytest.mark.parametrize("call", [shm.identify, shm.compare, shm.diagnose, shm.health])
def test_whole_numbers_of_another_unit_are_told_as_nanoseconds(drive, unit, words, call):
    """Counts, milliseconds, microseconds; units a second."""
    stamps = np.round(unit * drive[0]).astype(int)
    with pytest.raises(ValueError, match=f"^stamps are whole numbers, which are nanoseconds: {words}, must be 0.0001 s or"):
        call(stamps, *drive[1:])


def test_fast_stamps_are_taken_as_floats_and_datetimes(drive):
    fast = np.round(1e6 * drive[0]).astype(np.int64)
    for stamps in (1e-9 * fast, fast.astype("datetime64[ns]")):
        assert shm.identify(stamps, *drive[1:], integration_horizon=0.0003).sample_period == pytest.approx(1e-5)


N = np.zeros(30)
T = 0.01 * np.arange(30)


@pytest.mark.parametrize("arrays, words", [
    ((), "nothing is given"),
    (([],), "no drive is given"),
    ((["2026-05-01T12:00"] * 29 + ["noon"], N, N), r"stamps\[29\] = 'noon', must be a datetime, or a date as text such as"),
    ((["0.01"] * 30, N, N), r"stamps\[0\] = '0.01', must be .*; numbers must be in an array of numbers"),
    ((["2026-13-01"] * 30, N, N), r"stamps\[0\] = '2026-13-01', must be"),
    ((T, N), r"^given: ndarray of shape \(30,\), ndarray of shape \(30,\); must be stamps \(or time, or period\), body, wheel or"),
    ((T, N[:-1], N), "stamps has 30 and body 29 entries"),
    ((T, N, N[:-1]), "stamps has 30 and wheel 29 entries"),
    ((T, N, T[:-1], N), "stamps_wheel has 29 and wheel 30 entries"),
    ((T, N.reshape(30, 1), N), r"body has the shape \(30, 1\), must be \(n,\)"),
    ((T, N, [[0.0]]), r"wheel has the shape \(1, 1\)"),
    ((T, [], []), "body is empty"),
    ((T, ["a"] * 30, N), "body is of type <U1, must be real numbers"),
    ((T, N > 0, N), "body is of type bool"),
    ((T, N + 1j, N), "body is of type complex128"),
    ((T, [None] * 30, N), "body is of type object"),
    ((T[::-1], N, N), "stamps go back at 1: 0.280000000 after 0.290000000"),
    ((np.where(T > 0.1, np.nan, T), N, N), r"stamps\[11\] = nan, must be finite"),
    ((1e18 * T, N, N), r"stamps\[1\] = 1e\+16, must be finite seconds below 4e\+09"),
    ((0.0, N, N), r"stamps = 0 \[s\], must be a period in \[1e-05, 10\]"),
    ((float("nan"), N, N), r"stamps = nan \[s\]"),
    ((T[:5], N[:5], N[:5]), r"cannot be measured: fewer than 10 .* of one of the sensors \(of 10 readings; 11 of each are enough\)"),
    ((0 * T, N, N), "the sample period cannot be measured"),
    ((T, N, N), "no regression row: .* samples in all: 30"),
    ((3, 4), "^given: 3, 4; must be"),
    ((N,), r"^given: ndarray of shape \(30,\); must be"),
    ((None,), "^given: None; must be"),
    ((T, "drive.bag", N), "body is of type <U9")])
def test_what_is_no_recording_is_refused(arrays, words):
    with pytest.raises(ValueError, match=words):
        shm.identify(*arrays)


@pytest.mark.parametrize("call", [shm.identify, shm.compare, shm.diagnose, shm.health])
@pytest.mark.parametrize("options, words", [
    ({"memry": 3}, "unknown option memry = 3; the nearest known name is memory"),
    ({"helth_damping_warn": 0.2}, "the nearest known name is health/damping_warn"),
    ({"progres": None, "thread": 3}, "unknown option thread"),
    ({"memory": "long"}, r'memory = "long" \[s\], must be in \[0.0001, 1000000\]'),
    ({"memory": math.nan}, r"memory = nan"),
    ({"memory": [1, 2]}, r"memory = \[1, 2\]"),
    ({"memory": {1, 2}}, r"memory = \{1, 2\}, must be true or false, a number or a text"),
    ({"memory": 1 << 80}, r"memory = 1.2089258\d*e\+24"),
    ({"health_damping_warn": 0.2, "health/damping_warn": 0.3}, "health/damping_warn is given twice"),
    ({"horizon_samples": 30}, "horizon_samples is no option any more: integration_horizon"),
    ({"sprung_axis": "x"}, "sprung_axis is an option of messages and files, must not come with arrays: these have the acc"),
    ({"effects": "coulomb_friction"}, "effects is an option of .* with arrays: for these there is model="),
    ({"start": 3.0}, "start is an option of bags, must not come with arrays"),
    ({"progress": 3}, "progress = 3, must be True, None or a function")])
def test_wrong_options_are_refused_by_name(call, options, words, drive):
    with pytest.raises(ValueError, match=words):
        call(*drive, **options)


def test_every_name_of_an_option_is_its_own():
    from suspension_health_monitor._settings import array_keywords, assignments
    names = {"health_damping_warn": 0.2, "health/damping_error": 0.4, "health": {"confirm_time": 1.0},
             "nominal_damping_to_mass": np.float64(3.0), "memory": None, "effects": ["a", "b"]}
    assert assignments(array_keywords(names, None, [])) == [
        "effects=a, b", "health/confirm_time=1", "health/damping_error=0.40000000000000002",
        "health/damping_warn=0.20000000000000001", "nominal/damping_to_mass=3"]


@pytest.mark.parametrize("call", [shm.identify, shm.compare, shm.diagnose, shm.health])
def test_a_period_far_below_the_spacing_is_refused(call, drive):
    """Nearly all samples would be made up."""
    with pytest.raises(ValueError, match=r"sample_period = 1e-05 \[s\], must be at least .*: the stamps come every 0.01 s"):
        call(*drive, sample_period=1e-5)


@pytest.mark.parametrize("call, words", [
    (lambda: shm.simulate(scenari="paper_clean"), "unknown option scenari"),
    (lambda: shm.simulate(scenario="moon"), "scenario = \"moon\".*must be one of"),
    (lambda: shm.simulate(effect="rust=3"), "rust"),
    (lambda: shm.simulate(real_time_factor=2), "real_time_factor is an option of the nodelet"),
    (lambda: shm.diagnose(T, N, N, threads=0), "threads = 0, must be 1 or more"),
    (lambda: shm.diagnose(T, N, N, threads=1.5), "threads = 1.5, must be a whole number"),
    (lambda: shm.compare(T, N, N, model=3), "model = 3, must be a StrutModel, a dict"),
    (lambda: shm.health(T, N, N, baseline=3), "baseline = 3, must be a Baseline or the path"),
    (lambda: shm.compare(T, N, N, model={"damping_to_mass": 3.0}), "stiffness_to_mass"),
    (lambda: shm.compare(0.01, N, N), "the drives"),
    (lambda: shm.StrutMonitor(memry=3), "the nearest known name is memory"),
    (lambda: shm.StrutMonitor(every=0), "every = 0, must be 1 or more"),
    (lambda: shm.StrutMonitor(on_report=3), "on_report = 3, must be a function or None"),
    *[(lambda its=struts: shm.VehicleMonitor(its, sample_period=0.01), "must be names, each once")
      for struts in ([], ["a", "a"], ["a", ""], "ab", [1, 2])],
    (lambda: shm.simulate(vehicle_model="sedan"), "vehicle_model is of a bag: output is not given"),
    (lambda: shm.VehicleMonitor(["a"], sample_period=None), "sample_period is missing"),
    (lambda: shm.VehicleMonitor(["a", "b"], sample_period=0.01).push(T, np.zeros((30, 1)), np.zeros((30, 2))),
     r"body has the shape \(30, 1\), must be \(n, 2\)")])
def test_other_calls_are_refused_alike(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_wrong_bags_are_refused_as_by_the_command_line(program, tmp_path, paper_bag):
    for path, flags, options in ((tmp_path / "none.bag", [], {}),
                                 (paper_bag, ["--sprung-topic", "/x"], {"sprung_topic": "/x"}),
                                 (paper_bag, ["--start", "-1"], {"start": -1}),
                                 (paper_bag, ["--set", "memory=0"], {"memory": 0}),
                                 (paper_bag, ["--end", "0.05"], {"end": 0.05}),
                                 (paper_bag, ["--config", tmp_path / "no.yaml"], {"config": tmp_path / "no.yaml"})):
        for name in ("identify", "compare", "diagnose", "health"):
            words = program(name, path, *flags).stderr.strip()[len(f"suspension_bag {name}: "):]
            with pytest.raises(ValueError) as refused:
                getattr(shm, name)(path, **options)
            assert str(refused.value) == words
