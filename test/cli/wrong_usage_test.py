"""Wrong options and settings: status 2, and a message that says what would be right."""
import os
import pathlib
import re
import subprocess

import pytest

import conftest
import imu_bag

USAGE = {
    "no bag": ([], ["no bag is given; usage: suspension_bag identify BAG..."]),
    "unknown option": (["{bag}", "--bogus"], ["--bogus'\n"]),
    "mistyped option": (["{bag}", "--sprung", "/imu"], ["--sprung'; the nearest known name is --sprung-topic"]),
    "abbreviated option": (["{bag}", "--conf", "x"], ["--conf"]),
    "option without its value": (["{bag}", "--csv"], ["--csv"]),
    "option twice": (["{bag}", "--json", "a", "--json", "b"], ["--json"]),
    "negative start": (["{bag}", "--start", "-1"], ["--start -1", "0 <= start"]),
    "start is no number": (["{bag}", "--start", "soon"], ["--start", "soon", "must be a number"]),
    "start is NaN": (["{bag}", "--start", "nan"], ["--start nan"]),
    "end before start": (["{bag}", "--start", "5", "--end", "4"], ["--end 4", "start < end"]),
    "no topic": (["{bag}", "--sprung-topic", ""], ["--sprung-topic is empty", "must be a topic"]),
    "same topic twice": (["{bag}", "--sprung-topic", "/unsprung/imu"], ["--sprung-topic", "/unsprung/imu", "differ"]),
}

SETTINGS = {
    "forgetting_factor=1.2": ["forgetting_factor = 1.2", "in [0.9, 1]"],
    "forgetting_factor=nan": ["forgetting_factor = nan", "in [0.9, 1]"],
    "forgetting_factor=inf": ["forgetting_factor = inf", "in [0.9, 1]"],
    "forgetting_factor=high": ["forgetting_factor", '"high"', "in [0.9, 1]"],
    "forgetting_factor=": ["forgetting_factor", '""', "in [0.9, 1]"],
    "forgetting_factor= 0.98": ["forgetting_factor", '" 0.98"', "in [0.9, 1]"],
    "forgeting_factor=0.98": ["forgeting_factor", "nearest", " forgetting_factor"],
    "payload_range=0.1": ["payload_range", "nearest", "health/payload_range"],
    "publish_every=20.5": ["publish_every", "20.5", "whole number"],
    "publish_every=99999999999": ["publish_every", "whole number in [1, 1000000]"],
    "integration_horizon=0.006": ["integration_horizon = 0.006", "at least 1"],
    "integration_horizon=9999": ["integration_horizon = 9999", "100000 samples"],
    "preset=papers": ["preset", "papers", "default, paper"],
    "tyre/enabled=true": ["tyre/enabled is no option any more", "--road-topic"],
    "integration_rule=trapezoid": ["integration_rule is no option any more", "preset: paper"],
    "la/small_divisor=0.1": ["la/small_divisor is no option any more", "preset: paper"],
    "horizon_samples=30": ["horizon_samples is no option any more", "integration_horizon"],
    "sprung_axis=up": ["sprung_axis", "up", "x, y, z, -x, -y, -z"],
    "sample_period=0": ["sample_period = 0", "in [1e-05, 10]"],
    "forgetting_factor": ["--set forgetting_factor", "NAME=VALUE"],
    "=0.98": ["--set =0.98", "NAME=VALUE"],
}

FILES = {
    "unknown name": ("health:\n  confirm_tme: 1\n", ["health/confirm_tme", "nearest", "health/confirm_time"]),
    "below a node's name": ("monitor:\n  forgetting_factor: 0.98\n", ["monitor/forgetting_factor", "nearest"]),
    "out of range": ("forgetting_factor: 1.2\n", ["forgetting_factor = ", "1.2", "in [0.9, 1]"]),
    "wrong type": ("forgetting_factor: high\n", ["forgetting_factor", "high", "in [0.9, 1]"]),
    "list": ("forgetting_factor: [0.9, 0.98]\n", ["forgetting_factor = [0.9, 0.98] [-], must be in [0.9, 1]"]),
    "list of lists": ("sample_period: [[0.9], [1]]\n", ["sample_period = [[...], [...]] [s], must be in [1e-05, 10]"]),
    "list of this and that": ("effects: [quadratic_damping, 3]\n",
                              ["effects = [quadratic_damping, 3] [-], must be any text or a list of texts"]),
    "no value": ("sample_period: 0.02\nforgetting_factor:\n", ["{file}: line", "forgetting_factor", "plain value"]),
    "tree for a value": ("forgetting_factor:\n  low: 0.9\n", ["forgetting_factor/low", "nearest"]),
    "only a word": ("hello\n", ["{file}: line 1", "plain value"]),
    "given twice": ("forgetting_factor: 0.98\nforgetting_factor: 0.97\n", ["{file}: line 2", "forgetting_factor",
                                                                          "twice"]),
    "unclosed bracket": ("sample_period: 0.02\nhealth: [1, 2\n", ["{file}: line 3"]),
    "tab": ("health:\n\tconfirm_time: 1\n", ["{file}: line 2"]),
    "tree for a name": ("? {a: b}\n: 1\n", ["{file}: line 1"]),
    "alias within itself": ("health: &health\n  more: *health\n", ["{file}: line 1", "plain value"]),
    "binary": ("\x01\x02\x7f\x00", ["{file}: line 1"]),
}


@pytest.mark.parametrize("arguments, words", USAGE.values(), ids=USAGE.keys())
def test_wrong_arguments(program, paper_bag, tmp_path, arguments, words):
    program.refuse(2, ["identify", *(argument.format(bag=paper_bag) for argument in arguments)], words, tmp_path)


@pytest.mark.parametrize("setting, words", SETTINGS.items(), ids=SETTINGS.keys())
def test_wrong_setting(program, paper_bag, tmp_path, setting, words):
    outputs = ["--csv", tmp_path / "rows.csv", "--json", tmp_path / "result.json"]
    program.refuse(2, ["identify", paper_bag, "--set", setting, *outputs], words, tmp_path)


@pytest.mark.parametrize("text, words", FILES.values(), ids=FILES.keys())
def test_wrong_settings_file(program, paper_bag, tmp_path, text, words):
    path = tmp_path / "settings.yaml"
    path.write_text(text)
    arguments = ["identify", paper_bag, "--config", path, "--csv", tmp_path / "rows.csv"]
    program.refuse(2, arguments, [word.format(file=path) for word in words], tmp_path)


@pytest.mark.parametrize("name", ["missing.yaml", ""])
def test_settings_file_that_cannot_be_read(program, paper_bag, tmp_path, name):  # missing, or a folder
    path = tmp_path / name
    program.refuse(2, ["identify", paper_bag, "--config", path], [path, "must be a YAML file"], tmp_path)


@pytest.mark.parametrize("command, option", [
    ("identify", "--config"), ("identify", "--vehicle"), ("health", "--baseline"), ("compare", "--model"),
    ("diagnose", "--effects-file"), ("inspect", "--config")])
def test_a_pipe_in_place_of_a_settings_file_is_refused_at_once(program, paper_bag, tmp_path, command, option):
    os.mkfifo(tmp_path / "pipe.yaml")
    program.refuse(2, [command, paper_bag, option, tmp_path / "pipe.yaml"],
                   [tmp_path / "pipe.yaml", "is a pipe, must be a YAML file"], tmp_path)


def test_a_relative_path_is_told_with_its_folder(program, paper_bag, tmp_path):
    result = program("identify", paper_bag, "--config", "missing.yaml", cwd=tmp_path)
    assert f"missing.yaml: cannot be read in {tmp_path}, must be a YAML file" in result.stderr


def test_settings_that_contradict_each_other(program, paper_bag, tmp_path):
    arguments = ["--set", "memory=1", "--set", "sample_period=0.5"]
    program.refuse(2, ["identify", paper_bag, *arguments],
                   ["memory = 1 [s]", "at least 5 [s]", "sample_period = 0.5 [s]"], tmp_path)


def test_a_former_option_says_what_serves_instead(program, paper_bag, tmp_path):
    program.refuse(2, ["identify", paper_bag, "--set", "fastest_memory=2"],
                   ["fastest_memory is no option any more: the estimate follows a change of the strut by itself"], tmp_path)


def test_set_overrides_the_file(program, paper_bag):
    plain, equal, other = (program.succeed("identify", paper_bag, "--config", conftest.PAPER_SETTINGS, *more)
                           for more in ([], ["--set", "forgetting_factor=0.98"], ["--set", "forgetting_factor=0.95"]))
    assert plain == equal != other


@pytest.mark.parametrize("arguments, words", [
    (["--scenario", "moon"], ["scenario", "moon", "paper_clean"]),
    (["--vehicle", "bicycle"], ["vehicle", "bicycle", "golden_car"]),
    (["--seed", "-1"], ["seed = -1", "whole number in [0, "]),
    (["--seed", "1.5"], ["seed", "1.5", "whole number"]),
    (["--duration", "-1"], ["duration = -1", "in [0, "]),
    (["--rate", "0"], ["rate = 0", "in [0.1, "]),
    (["--rate", "fast"], ["rate", "fast", "in [0.1, "]),
    (["--set", "stamp_jitter=0.02"], ["stamp_jitter = 0.02", "one sample period"]),
    (["--set", "damping_ramp=false"], ["damping_ramp is no option any more", "damping_end_fraction: 1"]),
    (["--set", "sede=1"], ["sede", "nearest", "seed"]),
    (["stray.bag"], ["options only", "-o OUT.bag"])])
def test_wrong_simulation(program, tmp_path, arguments, words):
    program.refuse(2, ["simulate", *arguments, "-o", tmp_path / "drive.bag"], words, tmp_path)


def test_simulation_needs_an_output(program, tmp_path):
    program.refuse(2, ["simulate"], ["--output is missing", "-o OUT.bag"], tmp_path)


@pytest.mark.parametrize("b1, b0, word", [("-1", "10", "damping_to_mass = -1"), ("1", "0", "stiffness_to_mass = 0"),
                                          ("nan", "10", "above 0"), ("1", "inf", "above 0"), ("1", "x", "a number")])
def test_horizon_of_no_strut(program, tmp_path, b1, b0, word):
    program.refuse(2, ["horizon", "--damping-to-mass", b1, "--stiffness-to-mass", b0], [word], tmp_path)


@pytest.mark.parametrize("given, nearest", [("analyse", None), ("diagnos", "diagnose"), ("indentify", "identify")])
def test_unknown_command(program, given, nearest):
    result = program(given)
    assert (result.returncode, result.stdout) == (2, "")
    assert f"unknown command {given}" in result.stderr and "identify" in result.stderr
    assert (f"nearest known name is {nearest}" in result.stderr) == (nearest is not None)


def test_unknown_effect(program, tmp_path):
    program.refuse(2, ["simulate", "--scenario", "iso_road", "--effect", "quadratic=1", "-o", tmp_path / "drive.bag"],
                   ["effect quadratic, must be one of", "nearest known name is quadratic_damping"], tmp_path)


def test_no_command(program):
    result = program()
    assert (result.returncode, result.stdout) == (2, "")
    assert "usage: suspension_bag COMMAND" in result.stderr


def test_unknown_table_of_options(program, tmp_path):
    program.refuse(2, ["options", "car"], ["car", "monitor, simulator or vehicle"], tmp_path)


NODES = {"monitor": "options monitor", "vehicle": "options monitor", "simulator": "options simulator"}


def run_node(program, name, *arguments):
    """Where nobody has told of a master."""
    node = pathlib.Path(program.path).with_name(f"{name}_node")
    environment = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
    return subprocess.run([node, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment,
                          timeout=conftest.HANGS)


@pytest.mark.parametrize("name, settings", NODES.items())
@pytest.mark.parametrize("option", ["--help", "-h"])
def test_a_node_tells_how_it_is_started_without_a_master(program, name, settings, option):
    done = run_node(program, name, "__name:=mine", option)
    assert (done.returncode, done.stderr) == (0, "")
    assert f"usage: {name}_node" in done.stdout and "private parameters" in done.stdout and settings in done.stdout
    launch_file, *arguments = re.search(r"roslaunch suspension_health_monitor (.*)", done.stdout)[1].split()
    text = (imu_bag.REPOSITORY / "launch" / launch_file).read_text()
    for argument in arguments:
        assert f'<arg name="{argument.split(":=")[0]}"' in text


@pytest.mark.parametrize("name", NODES)
@pytest.mark.parametrize("arguments", [["--bogus"], ["sprung/imu:=/body/imu", "--bogus"], ["drive.bag"]])
def test_a_node_refuses_an_argument_that_is_no_remapping(program, name, arguments):
    done = run_node(program, name, *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"{name}_node: unknown argument {arguments[-1]}\nusage: ")
