"""Every command that stands in a block of doc/ is run, in the order of its document; readme_test.py runs those of the README.

cmake builds, as scripts/test does.
"""
import re
import shutil
import subprocess

import pytest

import imu_bag
from conftest import HANGS
from terminal import Terminal, commands_of, launch_and_look


def documents_with_commands():
    for document in sorted((imu_bag.REPOSITORY / "doc").glob("*.md")):
        text = document.read_text()
        commands = [command for block in commands_of(text) for command in block]
        commands += re.findall(r"`(roslaunch suspension_health_monitor [^`]+)`", re.sub(r"```.*?```", "", text, flags=re.DOTALL))
        if commands:
            yield pytest.param(commands, id=document.name)


def test_the_rules_see_commands():
    text = "```sh\nrosrun a b --c \\\n  d   # why\nno command\n```\n```yaml\ncp: x\n```\n"
    assert list(commands_of(text)) == [["rosrun a b --c    d"]]


@pytest.mark.parametrize("commands", documents_with_commands())
def test_commands_of_a_document(program, tmp_path, port, commands):
    terminal = Terminal(tmp_path, port)
    terminal.environment["PATH"] = f"{program.path.rpartition('/')[0]}:{terminal.environment['PATH']}"
    for command in commands:
        if command.startswith("roslaunch"):
            launch_and_look(terminal, command)
        else:
            terminal.run(command)


def test_scripts_of_the_readme_are_there():
    text = (imu_bag.REPOSITORY / "README.md").read_text()
    for script in re.findall(r"^scripts/\w+", text, re.MULTILINE):
        assert shutil.which(str(imu_bag.REPOSITORY / script)), script


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in (imu_bag.REPOSITORY / "doc").glob("*.png")) <= 300_000


def test_readme_is_short():
    assert len((imu_bag.REPOSITORY / "README.md").read_text().splitlines()) <= 170


def test_demo_tells_its_options():
    told = subprocess.run([imu_bag.REPOSITORY / "scripts/demo", "--help"], check=True, stdout=subprocess.PIPE, text=True,
                          timeout=HANGS).stdout
    assert "--no-install" in told and "--quick" in told
