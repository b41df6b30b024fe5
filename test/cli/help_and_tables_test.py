"""What a person reads: help, tables, the progress bar, and the tables of the documents."""
import math
import os
import pty
import re
import subprocess

import pytest
import yaml

import conftest
import imu_bag

OPTIONS = {
    "simulate": ["-o [ --output ]", "--config", "--set", "--scenario", "--vehicle", "--seed", "--duration", "--rate",
                 "--vehicle-model", "--vehicle-file"],
    "identify": ["--config", "--set", "--sprung-topic", "/sprung/imu", "--unsprung-topic", "/unsprung/imu", "--start",
                 "--end", "--csv", "--json", "-o [ --output ]", "--baseline"],
    "health": ["--config", "--set", "--sprung-topic", "--unsprung-topic", "--start", "--end", "--baseline", "--csv", "--json",
               "--report"],
    "compare": ["--config", "--set", "--sprung-topic", "--unsprung-topic", "--start", "--end", "--json", "--model",
                "--effects-file"],
    "horizon": ["--damping-to-mass", "--stiffness-to-mass", "--json"],
    "options": ["monitor", "simulator", "vehicle"],
}
DOCUMENTS = imu_bag.REPOSITORY / "doc"


@pytest.mark.parametrize("flag", ["-h", "--help"])
@pytest.mark.parametrize("command", OPTIONS)
def test_help_of_a_command_names_every_option(program, command, flag):
    text = program.succeed(command, flag)
    assert text.startswith(f"usage: suspension_bag {command}")
    for option in [*OPTIONS[command], "-h [ --help ]"]:
        assert option in text
    assert max(map(len, text.splitlines())) <= 100


@pytest.mark.parametrize("flag", ["-h", "--help"])
def test_help_names_commands_and_exit_statuses(program, flag):
    text = program.succeed(flag)
    for word in [*OPTIONS, "0 done", "2 wrong usage", "3 unreadable", "4 too little"]:
        assert word in text


@pytest.mark.parametrize("command", OPTIONS)
def test_help_of_a_command_by_its_name(program, command):
    assert program.succeed("help", command) == program.succeed(command, "--help")


def test_version_is_that_of_the_package(program):
    version = re.search("<version>(.*)</version>", (imu_bag.REPOSITORY / "package.xml").read_text())[1]
    assert program.succeed("--version") == f"suspension_bag {version}\n"


def test_help_comes_before_complaints(program):
    assert "usage" in program.succeed("identify", "--start", "-1", "-h")


@pytest.mark.parametrize("document, command", [
    ("settings.md", "options monitor"), ("effects.md", "effects --markdown")])
def test_tables_of_the_documents_are_those_of_the_program(program, document, command):
    table = program.succeed(*command.split())
    assert f"<!-- {command} -->\n{table}<!-- end -->" in (DOCUMENTS / document).read_text()


def flat(settings, prefix=""):
    """Values by full name: nested names joined with '/'."""
    return {full: value for name, nested in settings.items()
            for full, value in (flat(nested, f"{prefix}{name}/") if isinstance(nested, dict)
                                else {prefix + name: nested}).items()}


@pytest.mark.parametrize("of, count", [("monitor", 38), ("simulator", 31)])
def test_shipped_settings_show_every_option_with_its_default(program, of, count):
    """The commented ones, too; of those that have no default an example."""
    lines = program.succeed("options", of).splitlines()
    assert all(re.fullmatch(r"\|( [^|]+ \|){5}", line) for line in lines if line)
    rows = [[cell.strip(" `") for cell in line.split("|")[1:-1]] for line in lines if line.startswith("| `")]
    defaults = {row[0]: row[1] for row in rows}
    assert len(rows) == len(defaults) == count
    text = (imu_bag.REPOSITORY / f"config/{of}.yaml").read_text()
    shown = flat(yaml.safe_load(re.sub(r"^# ( *\w+:( .*)?)$", r"\1", text, flags=re.MULTILINE)))
    assert set(shown) == set(defaults)
    for name, value in shown.items():
        if defaults[name] not in ("none", '""'):
            assert value == yaml.safe_load(defaults[name]), name


def test_identify_prints_a_table(program, paper_bag):
    text = program.succeed("identify", paper_bag)
    assert "sample period 0.02 s (measured)" in text and "(proposed from the data)" in text
    assert "samples 2001" in text and "rejected" not in text
    lines = text.splitlines()
    assert max(map(len, lines)) <= 120
    rows = [line.split() for line in lines if line.endswith(("  yes", "  no"))]
    assert 6 <= len(rows) <= 24
    times = [float(row[0]) for row in rows]
    assert times == sorted(times) and times[-1] - times[0] > 30
    assert [float(value) for value in rows[-1][4:7]] == pytest.approx([13.8, 13.8, 13.8], rel=0.1)
    for name in ("estimate", "LS", "LA"):
        numbers = re.search(rf"^{name}: damping/mass (\S+) \+- (\S+) 1/s, stiffness/mass (\S+) \+- (\S+) 1/s\^2, "
                            r"(\S+) Hz, damping ratio (\S+)", text, re.MULTILINE).groups()
        b1, _, b0, _, frequency, ratio = map(float, numbers)
        assert b0 == pytest.approx(13.8, rel=0.1)
        assert frequency == pytest.approx(math.sqrt(b0) / (2 * math.pi), abs=1e-3)
        assert ratio == pytest.approx(b1 / (2 * math.sqrt(b0)), abs=1e-3)


def test_mass_gives_damping_and_stiffness(program, paper_bag):
    text = program.succeed("identify", paper_bag, "--set", "sprung_mass=50")
    b1, b0 = map(float, re.search(r"^estimate: damping/mass (\S+) .*stiffness/mass (\S+) ", text, re.MULTILINE).groups())
    damping, stiffness = map(float, re.search(r"^estimate: .*\n +damping (\S+) N s/m, stiffness (\S+) N/m$", text,
                                              re.MULTILINE).groups())
    assert (damping, stiffness) == pytest.approx((50 * b1, 50 * b0), rel=1e-3)


@pytest.mark.parametrize("b1, b0", [("3", "13.8"), ("1e-6", "1e8"), ("1e4", "1e-3")])
def test_horizon_of_any_strut_is_readable(program, b1, b0):
    text = program.succeed("horizon", "--damping-to-mass", b1, "--stiffness-to-mass", b0)
    assert float(re.search(r"integration_horizon: (\S+)", text).group(1)) > 0
    assert max(map(len, text.splitlines())) <= 130


def test_progress_bar_only_on_a_terminal(program, paper_bag):
    try:
        terminal, device = pty.openpty()
    except OSError as error:
        pytest.skip(f"no terminal to be had on this machine: {error}")
    result = subprocess.run([program.path, "identify", paper_bag], stdout=subprocess.PIPE, stderr=device,
                            encoding="utf-8", timeout=conftest.HANGS, check=True)
    os.close(device)
    shown = os.read(terminal, 100_000).decode()
    os.close(terminal)
    assert "100 %" in shown and str(paper_bag) in shown
    assert result.stdout == program.succeed("identify", paper_bag)  # which also finds standard error empty
