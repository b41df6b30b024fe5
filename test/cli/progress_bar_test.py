"""On a terminal: the bar of a long command is gone before anything else is said."""
import os
import pty
import re
import subprocess

import pytest

from conftest import HANGS

BAR = re.compile(r"\r\w+[^\r\n\[]* \[[# ]{40}\] +\d+ %")


def on_a_terminal(program, *arguments):
    """What a terminal gets of a command, standard output and error together."""
    try:
        ours, its = pty.openpty()
    except OSError as error:
        pytest.skip(f"no terminal to be had on this machine: {error}")
    with subprocess.Popen([program.path, *map(str, arguments)], stdout=its, stderr=its) as process:
        os.close(its)
        parts = []
        try:
            while part := os.read(ours, 65536):
                parts.append(part)
        except OSError:  # how Linux tells the end
            pass
        assert process.wait(HANGS) == 0
    os.close(ours)
    return b"".join(parts).decode().replace("\r\n", "\n")


@pytest.fixture(scope="module")
def drives(program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bar")
    program.succeed("simulate", "--vehicle-model", "half_sedan", "--duration", "30", "--vehicle-file", folder / "its.yaml",
                    "-o", folder / "vehicle.bag")
    program.succeed("simulate", "--duration", "30", "-o", folder / "strut.bag")
    return {"of a strut": [folder / "strut.bag"], "of a vehicle": [folder / "vehicle.bag", "--vehicle", folder / "its.yaml"]}


@pytest.mark.parametrize("kind", ["of a strut", "of a vehicle"])
@pytest.mark.parametrize("command", ["identify", "health", "compare", "diagnose"])
def test_nothing_is_written_behind_a_bar(program, drives, command, kind):
    said = on_a_terminal(program, command, *drives[kind])
    assert BAR.search(said), "it has one"
    rest = BAR.sub("\r", said)  # what follows a bar is another one, or what takes it off
    assert re.sub(r"\r+\x1b\[K", "", rest).count("\r") == 0, rest
