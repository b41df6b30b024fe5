"""The Python module beside the generated messages; its stubs, its page, and what is left of it without ROS."""
import ast
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest

import python_page
from imu_bag import REPOSITORY
from python_module import ROUGH, shm
from suspension_health_monitor import _core

PAGE = REPOSITORY / "doc" / "python.md"
STUB = REPOSITORY / "python" / "suspension_health_monitor" / "_core.pyi"


def run(program, **environment):
    result = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            timeout=300, env={**os.environ, **environment})
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_the_page_is_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    count, failures = python_page.run(PAGE)
    assert count > 15 and failures == ""


def test_from_csv_to_verdict_takes_ten_lines():
    assert len(re.findall(r"^>>>|^\.\.\.", python_page.blocks(PAGE)[1], re.MULTILINE)) <= 10


def test_messages_load_without_the_module_and_beside_it():
    loaded = run("import sys; from suspension_health_monitor.msg import SuspensionHealth; "
                 "from suspension_health_monitor.srv import Diagnose; print('numpy' in sys.modules, "
                 "'suspension_health_monitor._core' in sys.modules)")
    assert loaded.split()[1] == "False"
    assert run("import suspension_health_monitor as shm; from suspension_health_monitor.msg import SuspensionHealth; "
               "print(len(shm.effects()) > 10, shm.identify.__name__)") == "True identify\n"


def test_arrays_need_the_path_of_the_package_and_no_ros():
    path = os.pathsep.join(str(pathlib.Path(folder).parent) for folder in shm.__path__)
    program = "import suspension_health_monitor as shm; print(shm.simulate(duration=60).damping_to_mass[0])"
    done = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={"PYTHONPATH": path})
    assert (done.returncode, done.stderr) == (0, "") and float(done.stdout) > 0.0


def test_matplotlib_is_loaded_by_the_first_plot_only():
    assert run("import sys, suspension_health_monitor as shm; shm.effects(); print('matplotlib' in sys.modules)") == \
        "False\n"


def test_every_name_is_there_and_has_its_text():
    assert set(shm.__all__) <= set(dir(shm))
    for name in shm.__all__:
        assert inspect.getdoc(getattr(shm, name)), name
    with pytest.raises(AttributeError, match="no attribute 'identfy'"):
        shm.identfy  # pylint: disable=pointless-statement


def public(cls):
    return {name for name in vars(cls) if not name.startswith("_")}


def test_stubs_are_the_classes():
    """Name by name and attribute by attribute; what plots() and tables add is there once a result has been asked for."""
    assert shm.effects()
    stubs = {node.name: {part.target.id if isinstance(part, ast.AnnAssign) else part.name for part in node.body}
             for node in ast.parse(STUB.read_text()).body if isinstance(node, ast.ClassDef)}
    inner = {"EffectLibrary", "UnusableList", "Readings", "StrutMonitor", "VehicleMonitor", "ModelNumber"}
    for name, cls in inspect.getmembers(_core, inspect.isclass):
        if name in inner - set(stubs):
            continue
        assert {part for part in stubs.pop(name) if not part.startswith("_")} == public(cls), name
    assert stubs == {}


def test_help_tells_what_an_attribute_is():
    """The texts of the stubs, with units."""
    assert shm.effects()
    assert vars(_core.StrutEstimate)["delay_stddev"].__doc__ == "[s]"
    assert "stamped late" in vars(_core.StrutEstimate)["delay"].__doc__
    assert "[m/s^2]" in vars(_core.Comparison)["noise_floor"].__doc__
    assert vars(_core.TimeBins)["drive"].__doc__ == "which of the drives, from 0"


def test_without_ros_arrays_work_and_bags_say_why_not(tmp_path):
    """The files and the part that needs the library only, as cmake -S src/core puts them together."""
    folder = tmp_path / "suspension_health_monitor"
    folder.mkdir()
    for path in (REPOSITORY / "python" / "suspension_health_monitor").iterdir():
        (folder / path.name).symlink_to(path)
    (folder / os.path.basename(_core.__file__)).symlink_to(_core.__file__)
    said = run(f"""
import suspension_health_monitor as shm
print(shm.identify(shm.simulate(duration=20.0, **{ROUGH!r}), integration_horizon=0.3).la.valid)
for call in (lambda: shm.identify("drive.bag"), lambda: shm.simulate("drive.bag"),
             lambda: shm.compare(0.01, [0.0], [0.0], model="model.yaml"), lambda: shm.effects("laws.yaml")):
    try:
        call()
    except ValueError as error:
        print(error)
""", PYTHONPATH=str(tmp_path)).splitlines()
    assert said[0] == "True" and len(said) == 5
    for line in said[1:]:
        assert line.startswith("bags and YAML files are read by the module that is built with ROS")


@pytest.fixture(scope="module")
def results():
    drive = shm.simulate(effect="quadratic_damping=1.6", duration=60.0, **ROUGH)
    found = {call.__name__: call(drive) for call in (shm.identify, shm.compare, shm.diagnose, shm.health)}
    return {**found, "simulate": drive}


def test_results_show_themselves(results):
    for name, result in results.items():
        assert repr(result).startswith("<") and "object at" not in repr(result), name
        page = result._repr_html_()
        assert page.count("<table>") == page.count("</table>") > 0, name
    assert repr(results["compare"].free_run).startswith("<rmse 0.0")
    assert "quadratic_damping" in results["diagnose"]._repr_html_()
    assert "d |d|^(p-1)" in shm.effects()._repr_html_() and "<td" in shm.effects()._repr_html_()


def assert_healthy_is_in_view(worn):
    """However far the strut is from it; and nothing is drawn worse than an error."""
    levels, damping, _ = worn.plot().axes
    low, high = damping.get_ylim()
    assert low < worn.la.damping_to_mass < 5 < 9 < high
    assert [label.get_text() for label in levels.get_yticklabels()][-1] == "ERROR"
    assert levels.get_ylim()[0] < 0 and levels.get_ylim()[1] > 3, "no level lies on the frame"


def test_results_draw_themselves(results, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    for name, result in results.items():
        figure = result.plot()
        figure.savefig(tmp_path / f"{name}.png")
        assert all(axis.lines or axis.patches for axis in figure.axes), name
        _, axes = pyplot.subplots(len(figure.axes), squeeze=False)
        assert result.plot(axes=list(axes[:, 0])) is not figure
        pyplot.close("all")
    damper, spring = results["diagnose"].plot_curves().axes
    assert damper.lines and damper.collections and spring.lines and "m/s]" in damper.get_xlabel()
    assert_healthy_is_in_view(shm.health(results["simulate"], nominal_damping_to_mass=9.0))
    with pytest.raises(ValueError, match="1 axes, must be 2"):
        results["identify"].plot(axes=[None])
