"""Long work of the Python module: other threads go on, progress is told, Ctrl-C ends it; and monitors to push into."""
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

from python_module import HIDDEN, ROUGH, shm


@pytest.fixture(scope="module")
def drive():
    return shm.simulate(effect=HIDDEN, **ROUGH)


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """A drive of half a minute: progress, interruption and threads do not depend on its length."""
    path = tmp_path_factory.mktemp("python") / "drive.bag"
    shm.simulate(path, effect=HIDDEN, duration=30.0, **ROUGH)
    return path


@pytest.fixture(scope="module")
def short():
    """The same drive as arrays."""
    return shm.simulate(effect=HIDDEN, duration=30.0, **ROUGH)


@pytest.mark.parametrize("name", ["identify", "compare", "diagnose", "health"])
@pytest.mark.parametrize("source", ["arrays", "bag"])
def test_progress_rises_to_its_end_and_what_it_raises_comes_out(name, source, short, bag):
    of = short if source == "arrays" else bag
    shares = []
    getattr(shm, name)(of, progress=shares.append)
    assert shares == sorted(shares) and shares[-1] == 1.0 and 0.0 <= shares[0]

    class Enough(Exception):
        pass

    def stop(share):
        raise Enough(share)
    with pytest.raises(Enough):
        getattr(shm, name)(of, progress=stop)


def test_a_bar_is_drawn(short, capfd):
    shm.diagnose(short, progress=True)
    assert "diagnose" in capfd.readouterr().err


def test_other_threads_go_on(short):
    """Between two steps of this thread's counter a search has begun, and it has not ended."""
    done = threading.Event()
    searching = threading.Thread(target=lambda: (shm.diagnose(short), done.set()))
    searching.start()
    steps = 0
    while not done.is_set():
        steps += 1
    searching.join()
    assert steps > 1000  # with the interpreter held it would be a handful


@pytest.fixture(scope="module")
def long_drive(tmp_path_factory):
    """Paths of 20 minutes' readings: arrays, and a bag. Any work on them takes much longer than an interruption."""
    folder = tmp_path_factory.mktemp("long")
    shm.simulate(folder / "drive.bag", duration=1200.0, **ROUGH)
    made = shm.simulate(duration=1200.0, **ROUGH)
    np.save(folder / "drive.npy", [made.stamps_body, made.body, made.wheel])
    return folder


# raise(3) as a function of one more argument that counts its calls: no line of Python runs in it, so that the
# interpreter does not notice the signal there but where the library asks it.
INTERRUPT = """
import ctypes, functools, signal, sys, numpy as np, suspension_health_monitor as shm
drive, bag = np.load(sys.argv[1] + "/drive.npy"), sys.argv[1] + "/drive.bag"
whole, interrupted = [], []
interrupt = ctypes.CDLL(None)["raise"]
interrupt.argtypes, interrupt.restype = [ctypes.c_int, ctypes.py_object], interrupted.append
CALL(whole.append)
try:
    CALL(functools.partial(interrupt, signal.SIGINT))
except KeyboardInterrupt:
    print("interrupted", len(interrupted), "of", len(whole))
"""


@pytest.mark.parametrize("call", [
    "lambda told: shm.identify(*drive, integration_horizon=0.3, progress=told)",
    "lambda told: shm.compare(*drive[:, :12000], progress=told)",
    "lambda told: shm.diagnose(*drive[:, :6000], progress=told)",
    "lambda told: shm.health(*drive, progress=told)", "lambda told: shm.identify(bag, progress=told)",
    "lambda told: shm.health(bag, progress=told)", "lambda told: shm.StrutMonitor(on_report=told, every=5000).push(*drive)"])
def test_control_c_ends_it(call, long_drive):
    result = subprocess.run([sys.executable, "-c", INTERRUPT.replace("CALL", f"({call})"), long_drive], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600)
    assert result.returncode == 0, result.stderr
    word, calls, of, whole = result.stdout.split()
    assert (word, calls, of) == ("interrupted", "1", "of") and int(whole) > 2


def test_signals_are_the_interpreters_again_after_work(bag):
    before = signal.getsignal(signal.SIGTERM), signal.getsignal(signal.SIGINT)
    shm.identify(bag)
    assert (signal.getsignal(signal.SIGTERM), signal.getsignal(signal.SIGINT)) == before


def test_two_threads_get_what_one_gets(short, bag):
    expected = shm.diagnose(bag).base.held_out_rmse, shm.identify(short).la.damping_to_mass
    found = [None] * 2

    def work(k):
        found[k] = (shm.diagnose(bag, threads=1).base.held_out_rmse, shm.identify(short).la.damping_to_mass)
    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 2


# Monitors ----------------------------------------------------------------------------------------------------------

def test_a_monitor_says_the_same_whatever_the_pieces(drive):
    def estimates(count):
        monitor = shm.StrutMonitor(integration_horizon=0.3)
        for piece in np.array_split(np.arange(len(drive.body)), count):
            monitor.push(drive.stamps_body[piece], drive.body[piece], drive.wheel[piece])
        la = monitor.report.la
        return la.damping_to_mass, la.stiffness_to_mass, monitor.input.samples, monitor.report.stamp
    assert estimates(1) == estimates(7) == estimates(3000)
    assert estimates(1)[2] == len(drive.body) and estimates(1)[3] == pytest.approx(120.0)


def test_a_monitor_takes_single_readings_and_two_clocks(drive):
    whole, single = shm.StrutMonitor(sample_period=0.01), shm.StrutMonitor(sample_period=0.01)
    whole.push(drive.stamps_body[:500], drive.body[:500], drive.stamps_wheel[:500], drive.wheel[:500])
    for k in range(500):
        single.push(drive.stamps_body[k], drive.body[k], drive.wheel[k])
    assert single.report.la.damping_to_mass == whole.report.la.damping_to_mass
    assert single.sample_period == 0.01


def test_on_report_is_called_after_every_nth_sample(drive):
    stamps = []
    monitor = shm.StrutMonitor(sample_period=0.01, every=100, on_report=lambda report: stamps.append(report.stamp))
    monitor.push(drive.stamps_body[:1000], drive.body[:1000], drive.wheel[:1000])
    np.testing.assert_allclose(np.diff(stamps), 1.0)
    assert len(stamps) == 10


def test_on_report_may_ask_but_not_push_and_what_it_raises_comes_out(drive):
    asked = []
    monitor = shm.StrutMonitor(sample_period=0.01, on_report=lambda report: asked.append(monitor.input.samples))
    monitor.push(drive.stamps_body[:50], drive.body[:50], drive.wheel[:50])
    assert asked[-1] == 50

    pushing = shm.StrutMonitor(sample_period=0.01, on_report=lambda report: pushing.push(1.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="from within on_report"):
        pushing.push(drive.stamps_body[:50], drive.body[:50], drive.wheel[:50])


def test_threads_may_share_a_monitor(drive):
    monitor = shm.StrutMonitor(sample_period=0.01, on_report=lambda report: None)
    pieces = np.array_split(np.arange(len(drive.body)), 40)

    def push(parts):
        for piece in parts:
            monitor.push(drive.stamps_body[piece], drive.body[piece], drive.wheel[piece])
            assert monitor.report is not None
    threads = [threading.Thread(target=push, args=(pieces[k::4],)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert monitor.input.samples > 0


def test_a_monitor_tells_wear_by_a_baseline(drive):
    monitor = shm.StrutMonitor(baseline=shm.Baseline(damping_to_mass=9.0, stiffness_to_mass=40.0))
    monitor.push(drive.stamps_body, drive.body, drive.wheel)
    assert monitor.report.health.level == "ERROR" and monitor.report.health.damping_change < -0.3
    assert monitor.baseline.damping_to_mass == 9.0


def test_a_monitor_with_a_model_explains_more(drive):
    found = shm.diagnose(drive.stamps_body[:6000], drive.body[:6000], drive.wheel[:6000])
    monitor = shm.StrutMonitor(model=found.model)
    monitor.push(drive.stamps_body, drive.body, drive.wheel)
    assert monitor.report.comparison.rmse < 0.7 * monitor.report.comparison.base_rmse
    assert len(monitor.report.la.coefficients) == 1


def test_a_vehicle_of_one_strut_is_that_strut(drive):
    vehicle = shm.VehicleMonitor(["only"], sample_period=0.01, integration_horizon=0.3)
    vehicle.push(drive.stamps_body, drive.body[:, None], drive.wheel[:, None])
    alone = shm.StrutMonitor(sample_period=0.01, integration_horizon=0.3)
    alone.push(drive.stamps_body, drive.body, drive.wheel)
    assert vehicle.is_coupled
    assert vehicle.reports["only"].la.damping_to_mass == pytest.approx(alone.report.la.damping_to_mass, rel=1e-12)
