"""The library knows no ROS, and what estimates never sees what simulates."""
import pathlib
import re

import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
ROS_INCLUDE = re.compile(
    r'^\s*#\s*include\s*[<"](ros|nodelet|pluginlib|rosbag|rosgraph_msgs|sensor_msgs|std_msgs|std_srvs'
    r'|diagnostic_\w+|message_filters|tf2\w*|dynamic_reconfigure)/')
GENERATED_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]suspension_health_monitor/[A-Z]\w*\.h[>"]')
SIMULATION_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]suspension_health_monitor/(?:internal/)?simulation/')

INTERNAL_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](suspension_health_monitor/internal/|\.\.|(?:\w+/)*src/)')
REFERENCE_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](?:.*/)?reference/')

LIBRARY = sorted(path for folder in ("include", "src/core") for path in (REPOSITORY / folder).rglob("*")
                 if path.suffix in (".h", ".cpp"))
ESTIMATION = [path for path in LIBRARY if "simulation" not in path.parent.parts]
PUBLIC = sorted([*(REPOSITORY / "include" / "suspension_health_monitor").glob("*.h"), *(REPOSITORY / "example").glob("*")])


def name(path):
    return str(path.relative_to(REPOSITORY))


def includes(path, pattern):
    """The lines of path that include what pattern forbids."""
    return [line for line in path.read_text().splitlines() if pattern.search(line)]


def test_library_has_files():
    assert LIBRARY and ESTIMATION


@pytest.mark.parametrize("include, pattern", [
    ("#include <ros/ros.h>", ROS_INCLUDE), ('#include "sensor_msgs/Imu.h"', ROS_INCLUDE),
    ("# include <tf2_ros/buffer.h>", ROS_INCLUDE), ("#include <diagnostic_updater/publisher.h>", ROS_INCLUDE),
    ("#include <suspension_health_monitor/SuspensionHealth.h>", GENERATED_INCLUDE),
    ('#include "suspension_health_monitor/internal/simulation/road.h"', SIMULATION_INCLUDE),
    ('#include "suspension_health_monitor/internal/math/statistics.h"', INTERNAL_INCLUDE)])
def test_rule_sees_a_forbidden_include(include, pattern):
    assert pattern.match(include)


@pytest.mark.parametrize("path", LIBRARY, ids=name)
def test_library_includes_no_ros(path):
    assert includes(path, ROS_INCLUDE) == []
    assert includes(path, GENERATED_INCLUDE) == []


@pytest.mark.parametrize("path", ESTIMATION, ids=name)
def test_estimation_includes_no_simulation(path):
    assert includes(path, SIMULATION_INCLUDE) == []


@pytest.mark.parametrize("path", PUBLIC, ids=name)
def test_public_headers_and_examples_include_nothing_internal(path):
    assert includes(path, INTERNAL_INCLUDE) == []


# From below: a folder of the library includes those before it, and itself. What stands in no folder, the public calls, is
# on top. The public headers are below all: they hold types.
LAYERS = ["math", "base", "signal", "identification", "blocks", "model", "simulation", "record", "fit", "search", "compare",
          "vehicle", "health", "monitor", "wording", "calls"]
OWN_INCLUDE = re.compile(r'^#include "suspension_health_monitor/internal/(?:(\w+)/)?\w+\.h"', re.MULTILINE)


def layer(path):
    parts = path.relative_to(REPOSITORY).parts
    inner = parts[2:] if parts[:2] == ("src", "core") else parts[3:] if parts[2] == "internal" else None
    return None if inner is None else LAYERS.index(inner[0] if len(inner) > 1 else "calls")


@pytest.mark.parametrize("path", [path for path in LIBRARY if layer(path) is not None], ids=name)
def test_folders_of_the_library_include_only_those_below(path):
    for folder in OWN_INCLUDE.findall(path.read_text()):
        assert LAYERS.index(folder or "calls") <= layer(path), f"{folder} is above"


PYTHON_WITHOUT_ROS = sorted(path for path in (REPOSITORY / "src/python").glob("*.cpp") if not path.name.startswith("bags_"))


def included(path, found):
    """path and all files of ours that it includes by a path of theirs, and these by one."""
    if path not in found:
        found.add(path)
        for target in re.findall(r'^#include "((?!suspension_health_monitor/)[^"]+)"', path.read_text(), re.MULTILINE):
            included((path.parent / target).resolve(), found)
    return found


@pytest.mark.parametrize("path", PYTHON_WITHOUT_ROS, ids=name)
def test_python_over_arrays_includes_no_ros(path):
    for file in included(path, set()):
        assert includes(file, ROS_INCLUDE) + includes(file, GENERATED_INCLUDE) == [], file


def test_few_headers_are_public():
    assert len([path for path in PUBLIC if path.suffix == ".h"]) <= 12


@pytest.mark.parametrize("path", sorted(path for folder in ("include", "src") for path in (REPOSITORY / folder).rglob("*")
                                        if path.suffix in (".h", ".cpp")), ids=name)
def test_product_includes_no_reference(path):
    assert includes(path, REFERENCE_INCLUDE) == []
