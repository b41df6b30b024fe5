"""The install space: everything in it can be used, and another package builds on it, in a terminal of its own."""
import os
import pathlib
import re
import subprocess

import pytest

import imu_bag
from conftest import HANGS, SANITIZED
from terminal import Terminal, launch_and_look

BUILD = pathlib.Path.cwd()  # as cmake runs the tests
NAME = "suspension_health_monitor"
BARE = {"HOME": os.environ.get("HOME", "/"), "PATH": "/usr/bin:/bin"}  # of a new terminal: no workspace is sourced
DOWNSTREAM = {
    "package.xml": f"""<package format="2">
  <name>my_robot</name><version>0.0.0</version><description>one</description><license>BSD</license>
  <maintainer email="me@robot.example">me</maintainer>
  <buildtool_depend>catkin</buildtool_depend><depend>{NAME}</depend>
</package>""",
    "CMakeLists.txt": f"""cmake_minimum_required(VERSION 3.16)
project(my_robot CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(catkin REQUIRED COMPONENTS {NAME})
catkin_package()
include_directories(${{catkin_INCLUDE_DIRS}})
add_executable(my_monitor {imu_bag.REPOSITORY}/example/monitor_live.cpp)
target_link_libraries(my_monitor ${{catkin_LIBRARIES}})
add_dependencies(my_monitor ${{catkin_EXPORTED_TARGETS}})
install(TARGETS my_monitor DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})
"""}


def run(command, folder, environment):
    """What a command tells in bash."""
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=HANGS)
    assert done.returncode == 0, f"{command}: {done.stdout}"
    return done.stdout


@pytest.fixture(scope="module")
def space(tmp_path_factory):
    """The install space, below a folder of its own: catkin knows the prefix from the configuration on."""
    if SANITIZED:
        pytest.skip("what builds on it would need the sanitizers, too")
    root = tmp_path_factory.mktemp("root")
    run(f"cmake --install '{BUILD}'", root, {**os.environ, "DESTDIR": str(root)})
    prefix = re.search(r"^CMAKE_INSTALL_PREFIX:PATH=/(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE)[1]
    return root / prefix


@pytest.fixture(scope="module")
def sourced(space):
    """The environment of a terminal that has sourced it, with the ROS that it was built with."""
    lines = run(f"source '{space}/setup.bash' && env -0", "/", BARE).split("\0")
    return dict(line.split("=", 1) for line in lines if "=" in line)


def test_it_is_found_where_it_was_installed(space, sourced):
    assert run(f"rospack find {NAME}", "/", sourced).strip() == str(space / "share" / NAME)


def test_every_program_tells_what_it_is(space, sourced, tmp_path):
    programs = sorted(path.name for path in (space / "lib" / NAME).iterdir())
    assert {"monitor_node", "simulator_node", "suspension_bag", "suspension_fleet", "vehicle_node"} == set(programs)
    for program in programs:
        assert program in run(f"rosrun {NAME} {program} --help", tmp_path, sourced)


def test_it_simulates_and_identifies_in_python_and_on_the_command_line(sourced, tmp_path):
    tool = f"rosrun {NAME} suspension_bag"
    run(f"{tool} simulate --scenario iso_road --vehicle ugv --rate 100 -o drive.bag", tmp_path, sourced)
    run(f"{tool} identify drive.bag", tmp_path, sourced)
    if os.environ.get("PYTHON_MODULE") == "ON":
        python = f"import {NAME} as shm; print(shm.identify('drive.bag').estimate.valid)"
        assert run(f'python3 -c "{python}"', tmp_path, sourced) == "True\n"


def test_a_launch_file_finds_nodelets_and_settings(sourced, tmp_path, port):
    launch_and_look(Terminal(tmp_path, port, sourced), f"roslaunch {NAME} paper.launch", ["/monitor/estimate/valid"])


def test_another_package_builds_and_installs_on_it(sourced, tmp_path):
    package = tmp_path / "src" / "my_robot"
    package.mkdir(parents=True)
    for name, text in DOWNSTREAM.items():
        (package / name).write_text(text)
    run("catkin_make_isolated --install", tmp_path, sourced)
    own = run("source install_isolated/setup.bash && rosrun my_robot my_monitor", tmp_path, sourced)
    assert "damping/mass" in own


def test_catkin_make_isolated_configures_it(tmp_path):
    """In a workspace where the package is a link, and below a space of its own; nothing is compiled."""
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / NAME).symlink_to(imu_bag.REPOSITORY)
    told = run("catkin_make_isolated --make-args help", tmp_path, {**os.environ, "CMAKE_PREFIX_PATH": ""})
    assert "1 of 1" in told and not re.search(r"CMake (Deprecation )?Warning.*CMakeLists", told), told
