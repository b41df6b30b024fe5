"""Without what only the fleet needs, a command says in one line what to install. Modules are hidden, as if not installed."""
import re
import subprocess
import sys

import pytest

from conftest import HANGS
from imu_bag import REPOSITORY
from suspension_health_monitor.fleet import needs

SCRIPT = REPOSITORY / "python/suspension_fleet"
WITHOUT = """import runpy, sys
modules, script, *arguments = sys.argv[1:]
sys.modules.update(dict.fromkeys(modules.split(",")))
sys.argv = [script, *arguments]
runpy.run_path(script, run_name="__main__")
"""
FLEET = "sqlite:///fleet.db"


@pytest.mark.parametrize("document", ["doc/fleet.md", "scripts/install_dependencies"])
def test_what_is_needed_is_written_down(document):
    text = (REPOSITORY / document).read_text()
    for package in [*needs.PACKAGES.values(), *needs.PACKAGES_OF_SOME.values()]:
        assert re.search(rf"\b{package}\b", text), package


def run_without(modules, folder, *arguments):
    return subprocess.run([sys.executable, "-c", WITHOUT, modules, str(SCRIPT), *arguments], cwd=folder, timeout=HANGS,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize("modules, arguments, packages", [
    ("sqlalchemy", ["--help"], "python3-sqlalchemy"),
    ("distributed", ["scan", "drive.bag", "--db", FLEET], "python3-distributed"),
    ("scipy", ["show", "--db", FLEET], "python3-scipy"),
    ("plotly", ["report", "--db", FLEET, "-o", "page"], "python3-plotly"),
    ("psycopg2", ["show", "--db", "postgresql://user@host/fleet"], "python3-psycopg2"),
    ("plotly,distributed", ["scan", "drive.bag", "--db", FLEET], "python3-distributed python3-plotly")])
def test_a_command_says_what_to_install(tmp_path, modules, arguments, packages):
    for module in {"distributed", "plotly", "psycopg2", "scipy", "sqlalchemy"} - set(modules.split(",")):
        pytest.importorskip(module)
    done = run_without(modules, tmp_path, *arguments)
    assert done.stderr.startswith("suspension_fleet") and done.stderr.count("\n") == 1
    assert done.stderr.endswith(f": Python modules are not installed: apt-get install {packages}\n")
    assert (done.returncode, done.stdout, list(tmp_path.iterdir())) == (3, "", [])


def test_another_database_names_its_module(tmp_path):
    pytest.importorskip("sqlalchemy")
    done = run_without("MySQLdb", tmp_path, "show", "--db", "mysql://user@host/fleet")
    assert (done.returncode, done.stderr) == (3, "suspension_fleet show: the Python module MySQLdb is not installed\n")


def test_a_scan_needs_no_plotly(tmp_path):
    """What is missing for the page of a report only does not keep a robot's bags from being read."""
    done = run_without("plotly", tmp_path, "scan", "no.bag", "--db", FLEET)
    assert "no.bag" in done.stderr and "install" not in done.stderr


def test_without_a_sourced_workspace_one_sentence_says_what_to_source(tmp_path):
    done = subprocess.run([sys.executable, "-I", "-S", SCRIPT, "show"], cwd=tmp_path, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=HANGS)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("suspension_fleet: ") and done.stderr.count("\n") == 1 and "setup.bash" in done.stderr
