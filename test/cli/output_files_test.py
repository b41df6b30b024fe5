"""Results appear whole or not at all, and nothing else is touched."""
import json
import os
import pathlib
import resource
import signal
import stat
import threading

import pytest

import conftest

SETTINGS = ["--config", conftest.PAPER_SETTINGS]


@pytest.mark.parametrize("option", ["--csv", "--json"])
def test_output_that_cannot_be_written(program, paper_bag, tmp_path, option):
    (tmp_path / "file").write_text("here first")
    for path, words in ((tmp_path / "no folder" / "out", ["No such file"]), (tmp_path, ["directory"]),
                        (tmp_path / "file" / "out", ["Not a directory"])):
        program.refuse(3, ["identify", paper_bag, option, path], [path, "cannot be written", *words], tmp_path)
    program.refuse(3, ["identify", paper_bag, option, ""], ["cannot be written"], tmp_path)


@pytest.mark.parametrize("option", ["--csv", "--json"])
def test_an_output_is_never_an_input(program, paper_bag, tmp_path, option):
    bag = tmp_path / "drive.bag"
    bag.write_bytes(paper_bag.read_bytes())
    (tmp_path / "link").symlink_to(bag)
    settings = tmp_path / "settings.yaml"
    settings.write_text("forgetting_factor: 0.98\n")
    for path in (bag, tmp_path / "." / "drive.bag", tmp_path / "link", settings):
        program.refuse(2, ["identify", bag, "--config", settings, option, path], [option, path.name, "of its own"],
                       tmp_path)


def run_apart(program, *arguments):
    """Standard output and standard error of a run."""
    result = program(*arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout, result.stderr


@pytest.mark.parametrize("command, option", [("identify", "--json"), ("identify", "--csv"), ("identify", "-o"),
                                             ("health", "--json"), ("health", "--csv"), ("compare", "--json"),
                                             ("diagnose", "--json"), ("diagnose", "-o")])
def test_a_result_called_minus_is_all_of_standard_output(program, paper_bag, tmp_path, monkeypatch, command, option):
    monkeypatch.chdir(tmp_path)
    of = [command, paper_bag, *SETTINGS, "--end", "40"]
    words, _ = run_apart(program, *of)
    program.succeed(*of, option, tmp_path / "result")
    output, errors = run_apart(program, *of, option, "-")
    assert output == (tmp_path / "result").read_text()
    assert errors == words
    assert list(tmp_path.iterdir()) == [tmp_path / "result"]


def test_what_is_no_text_has_a_name(program, paper_bag, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    program.refuse(2, ["identify", paper_bag, "--json", "-", "--csv", "-"], ["--json -", "of its own"], tmp_path)
    program.refuse(2, ["simulate", "-o", "-"], ["--output -, must be a file"], tmp_path)
    program.refuse(2, ["health", paper_bag, "--report", "-"], ["--report -, must be a folder"], tmp_path)


def test_two_results_do_not_share_a_file(program, paper_bag, tmp_path):
    path = tmp_path / "result"
    program.refuse(2, ["identify", paper_bag, "--csv", path, "--json", path], [path, "of its own"], tmp_path)


def test_simulation_does_not_overwrite_its_settings(program, tmp_path):
    settings = tmp_path / "settings.yaml"
    settings.write_text("duration: 1.0\n")
    program.refuse(2, ["simulate", "--config", settings, "-o", settings], [settings, "of its own"], tmp_path)


@pytest.mark.parametrize("path", ["", "no folder/drive.bag", "."])
def test_bag_that_cannot_be_written(program, tmp_path, path):
    path = tmp_path / path if path else path
    program.refuse(3, ["simulate", "--duration", "1", "-o", path], [f"{path}: cannot be written"], tmp_path)


def test_a_failed_run_leaves_the_old_result(program, paper_bag, tmp_path):
    for name in ("rows.csv", "result.json", "drive.bag"):
        (tmp_path / name).write_text("of yesterday\n")
    outputs = ["--csv", tmp_path / "rows.csv", "--json", tmp_path / "result.json"]
    program.refuse(4, ["identify", paper_bag, *SETTINGS, "--end", "1", *outputs], ["no regression row"], tmp_path)
    program.refuse(3, ["identify", paper_bag, tmp_path / "none.bag", *SETTINGS, *outputs], ["none.bag"], tmp_path)
    program.refuse(3, ["identify", tmp_path / "drive.bag", *outputs], ["drive.bag"], tmp_path)
    program.refuse(2, ["simulate", "--rate", "0", "-o", tmp_path / "drive.bag"], ["rate"], tmp_path)
    program.refuse(3, ["horizon", "--damping-to-mass", "3", "--stiffness-to-mass", "13.8", "--json",
                       tmp_path / "no folder" / "horizon.json"], ["horizon.json"], tmp_path)


def test_a_run_replaces_the_old_result(program, paper_bag, tmp_path):
    (tmp_path / "target.csv").write_text("of yesterday\n" * 100000)
    (tmp_path / "rows.csv").symlink_to("target.csv")
    program.succeed("identify", paper_bag, *SETTINGS, "--csv", tmp_path / "rows.csv")
    assert (tmp_path / "rows.csv").is_symlink()
    assert (tmp_path / "target.csv").read_text().startswith("time,")
    assert "yesterday" not in (tmp_path / "target.csv").read_text()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["rows.csv", "target.csv"]


def test_what_is_no_regular_file_is_written_to_and_stays(program, paper_bag, tmp_path):
    """As /dev/null or /dev/stdout, which the tests of a root must not risk."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    received = []
    reader = threading.Thread(target=lambda: received.append(pipe.read_text()), daemon=True)
    reader.start()
    program.succeed("identify", paper_bag, *SETTINGS, "--json", pipe)
    reader.join(timeout=conftest.HANGS)
    assert json.loads(received[0])["rows"] == 1941
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_json_on_standard_output(program, paper_bag):
    text = program.succeed("identify", paper_bag, *SETTINGS, "--json", "/proc/self/fd/1")
    assert json.JSONDecoder().raw_decode(text)[0]["rows"] == 1941


def fill_disk_at(size):
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return limit


@pytest.mark.parametrize("size", [0, 5000, 100_000, 700_000])
def test_full_disk(program, paper_bag, tmp_path, size):
    before = conftest.snapshot(tmp_path)
    for arguments, name in ((["simulate", "-o"], "drive.bag"), (["identify", paper_bag, *SETTINGS, "--csv"], "rows.csv")):
        if (name, size) == ("rows.csv", 700_000):
            continue  # it is smaller
        result = program(*arguments, tmp_path / name, preexec_fn=fill_disk_at(size))
        assert (result.returncode, result.stdout) == (3, "")
        assert f"{tmp_path / name}: cannot be written" in result.stderr
        assert conftest.snapshot(tmp_path) == before


@pytest.mark.skipif(not pathlib.Path("/dev/full").is_char_device(), reason="no /dev/full")
def test_standard_output_that_takes_nothing(program, paper_bag):
    with open("/dev/full", "w") as full:
        for arguments in (["identify", paper_bag], ["options"], ["identify", "-h"]):
            result = program(*arguments, stdout=full)
            assert result.returncode == 3
            assert "standard output: cannot be written" in result.stderr
