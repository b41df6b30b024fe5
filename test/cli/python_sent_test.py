"""Results of the Python module that are sent to another process, kept, or taken apart."""
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest

from python_module import HIDDEN, ROUGH, shm

LAWS = "effects:\n  second_spring:\n    force: d^3\n    unit: 1/(m^2 s^2)\n    finding: a second spring\n"


@pytest.fixture(scope="module")
def results():
    drive = shm.simulate(effect=HIDDEN, duration=60.0, **ROUGH)
    monitor = shm.StrutMonitor(sample_period=0.01)
    monitor.push(drive.stamps_body, drive.body, drive.wheel)
    found = {call.__name__: call(drive) for call in (shm.identify, shm.compare, shm.diagnose, shm.health)}
    return {**found, "simulate": drive, "report": monitor.report, "input": monitor.input, "effects": shm.effects()}


def assert_same(one, other, where="result"):
    if isinstance(one, dict):
        assert list(one) == list(other), where
        for name, value in one.items():
            assert_same(value, other[name], f"{where}.{name}")
    elif isinstance(one, list):
        assert len(one) == len(other), where
        for k, value in enumerate(one):
            assert_same(value, other[k], f"{where}[{k}]")
    elif isinstance(one, np.ndarray):
        np.testing.assert_array_equal(one, other, err_msg=where)
    else:
        assert type(one) in (int, float, bool, str, type(None)), where
        assert one == other or (math.isnan(one) and math.isnan(other)), where


@pytest.mark.parametrize("name", ["identify", "compare", "diagnose", "health", "simulate", "report", "input", "effects"])
def test_what_is_sent_comes_back(results, name):
    result = results[name]
    back = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))
    plain = shm.to_dict(result)
    assert_same(plain, shm.to_dict(back))
    assert repr(back) == repr(result) or "object at" in repr(result)
    if hasattr(result, "_repr_html_"):
        assert back._repr_html_() == result._repr_html_()


def test_every_attribute_is_there(results):
    plain = shm.to_dict(results["diagnose"])
    assert plain["base"]["held_out_rmse"] == results["diagnose"].base.held_out_rmse
    assert plain["ranking"][0]["effects"] == results["diagnose"].ranking[0].effects
    assert plain["model"]["settings"]["effects"]["quadratic_damping"]["coefficient"] == pytest.approx(1.6, rel=0.1)
    views = shm.to_dict(results["compare"])["views"]
    np.testing.assert_array_equal(views["travel"]["mean"], results["compare"].views.travel.mean)
    assert len(pickle.loads(pickle.dumps(results["compare"])).views.travel) == len(results["compare"].views.travel)


def test_a_model_that_was_sent_is_a_model(results, tmp_path):
    drive, model = results["simulate"], results["diagnose"].model
    back = pickle.loads(pickle.dumps(model))
    assert back.yaml() == model.yaml()
    expected = shm.compare(drive, model=model).free_run.rmse
    assert shm.compare(drive, model=back).free_run.rmse == shm.compare(drive, model=back.settings).free_run.rmse == expected
    laws = tmp_path / "laws.yaml"
    laws.write_text(LAWS)
    own = {"damping_to_mass": 4.0, "stiffness_to_mass": 40.0, "effects": {"second_spring": {"coefficient": 900.0}}}
    compared = shm.compare(drive, model=own, effects_file=laws)
    again = shm.compare(drive, model=pickle.loads(pickle.dumps(compared.model)), effects_file=laws)
    assert again.free_run.rmse == compared.free_run.rmse


def test_a_baseline_is_sent_as_what_it_is():
    learned = shm.health(shm.simulate(duration=60.0, **ROUGH), baseline_learn_time=20.0).baseline
    back = pickle.loads(pickle.dumps(learned))
    assert isinstance(back, shm.Baseline) and learned.learned
    assert shm.to_dict(back) == shm.to_dict(learned) and back.learned_to > back.learned_from + 15.0


def test_plots_go_with_results(results):
    pytest.importorskip("matplotlib").use("Agg")
    for name in ("identify", "compare", "diagnose", "health", "simulate"):
        assert pickle.loads(pickle.dumps(results[name])).plot().axes


def test_a_fleet_of_processes(tmp_path):
    """As multiprocessing starts them where nothing is shared."""
    script = tmp_path / "fleet.py"
    script.write_text(f"""
import multiprocessing, suspension_health_monitor as shm
def judge(seed):
    return shm.identify(shm.simulate(seed=seed, duration=30.0, **{ROUGH!r}))
if __name__ == "__main__":
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        print([round(each.estimate.stiffness_to_mass) for each in pool.map(judge, [1, 2, 3])])
""")
    result = subprocess.run([sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
    assert result.stdout == "[40, 40, 40]\n", result.stderr
