"""pip install . puts together what arrays need. The compiler's work is left out: the part for arrays is the one of the build."""
import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from xml.etree import ElementTree

import pytest

from imu_bag import REPOSITORY
from python_module import ROUGH
from suspension_health_monitor import _core

if not all(map(importlib.util.find_spec, ("pip", "setuptools", "wheel"))):
    pytest.skip("pip or wheel is not installed (Debian: python3-pip, python3-wheel)", allow_module_level=True)

# In place of cmake: tells its arguments, and puts the part where a build would.
CMAKE = f"""#!/bin/sh
echo "$@" >> "$CALLS"
if [ "$1" = -S ]; then
  mkdir -p "$4/python/suspension_health_monitor" && cp '{_core.__file__}' "$4/python/suspension_health_monitor/"
fi
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The calls of cmake, and the wheel that pip makes of a copy of the repository."""
    folder = tmp_path_factory.mktemp("install")
    for name in ("setup.py", "pyproject.toml", "package.xml", "LICENSE"):
        shutil.copy(REPOSITORY / name, folder)
    shutil.copytree(REPOSITORY / "python", folder / "python", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    (folder / "bin").mkdir()
    (folder / "bin" / "cmake").write_text(CMAKE)
    (folder / "bin" / "cmake").chmod(0o755)
    environment = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}", "CALLS": str(folder / "calls")}
    result = subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index",
                             "--wheel-dir", folder / "made", folder], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, timeout=600, env=environment)
    assert result.returncode == 0, result.stdout
    made, = (folder / "made").iterdir()
    return (folder / "calls").read_text().splitlines(), made


def test_cmake_builds_the_part_for_arrays_of_this_python(wheel):
    configure, build = wheel[0]
    assert configure.split()[1].endswith("src/core") and f"-DPYTHON_EXECUTABLE={sys.executable}" in configure
    target = build.split()[-1]
    assert target == "suspension_health_monitor_python_core"
    assert f"{target} " in (REPOSITORY / "src" / "core" / "CMakeLists.txt").read_text()


def test_the_wheel_holds_what_arrays_need_and_no_more(wheel):
    version = ElementTree.parse(REPOSITORY / "package.xml").getroot().findtext("version")
    assert wheel[1].name.startswith(f"suspension_health_monitor-{version}-cp{sys.version_info[0]}{sys.version_info[1]}-")
    files = {name.partition("/")[2] for name in zipfile.ZipFile(wheel[1]).namelist()
             if name.startswith("suspension_health_monitor/")}
    sources = REPOSITORY / "python" / "suspension_health_monitor"
    assert files == {path.name for path in sources.iterdir() if path.suffix in (".py", ".pyi") or path.name == "py.typed"} | \
        {os.path.basename(_core.__file__)}


def test_what_is_installed_identifies(wheel, tmp_path):
    zipfile.ZipFile(wheel[1]).extractall(tmp_path)
    program = "import suspension_health_monitor as shm; print(shm.__file__); " \
        f"print(shm.identify(shm.simulate(duration=20.0, **{ROUGH!r}), integration_horizon=0.3).la.valid)"
    said = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, timeout=600, check=True,
                          env={**os.environ, "PYTHONPATH": str(tmp_path)}).stdout.splitlines()
    assert said == [str(tmp_path / "suspension_health_monitor" / "__init__.py"), "True"]


def test_catkin_installs_files_only(tmp_path):
    """Compiled parts are its CMake's own; the fleet is of it."""
    subprocess.run([sys.executable, "setup.py", "-q", "egg_info", "--egg-base", tmp_path, "build", "--build-base", tmp_path,
                    "install", "--root", tmp_path / "root", "--prefix", "/there"], cwd=REPOSITORY, check=True, timeout=600,
                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, "CATKIN_BINARY_DIR": str(tmp_path)})
    installed = {path.name for path in (tmp_path / "root").rglob("*") if path.parent.name in ("fleet", "suspension_health_monitor")}
    assert {"_api.py", "_core.pyi", "py.typed", "scan.py", "report_page"} <= installed
    assert not [name for name in installed if name.endswith(".so")]
