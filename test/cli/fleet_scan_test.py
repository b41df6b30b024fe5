"""suspension_fleet scan: every bag a row, once, whoever is killed on the way."""
import contextlib
import os
import pathlib
import signal
import sqlite3
import subprocess
import sys
import time

import pytest

import conftest
import fleet
from suspension_health_monitor.fleet.cluster import open_client
from suspension_health_monitor.fleet.errors import FleetError

CORRUPT = 3
GOOD = 21
ONE = ("--workers", 1)  # where no bag waits for another


@pytest.fixture(scope="module")
def bag(program, tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "drive.bag"
    program.succeed("simulate", "--duration", "20", "-o", path)
    return path


@pytest.fixture
def bags(bag, tmp_path):
    """Of two vehicles, and some that are none."""
    fleet.copies(bag, tmp_path / "bags/robot_1", 10)
    fleet.copies(bag, tmp_path / "bags/robot_2", GOOD - 10, first=10)
    content = bag.read_bytes()
    (tmp_path / "bags/robot_1/cut.bag").write_bytes(content[:len(content) // 2])
    (tmp_path / "bags/robot_1/text.bag").write_text("no bag\n")
    (tmp_path / "bags/robot_2/empty.bag").touch()
    return tmp_path / "bags"


@pytest.fixture
def url(tmp_path):
    return f"sqlite:///{tmp_path / 'fleet.db'}"


@pytest.fixture
def counting(program, tmp_path, monkeypatch):
    """suspension_bag, and a function that tells which bags it has identified."""
    monkeypatch.setenv("REAL", program.path)
    log = tmp_path / "read"
    log.touch()
    path = fleet.write_program(tmp_path / "counting", f'[ "$1" = identify ] && basename "$2" >> {log}')
    return path, lambda: sorted(log.read_text().split())


def slow(program, folder, monkeypatch, seconds="0.2"):
    monkeypatch.setenv("REAL", program.path)
    return fleet.write_program(folder / "slow", f'[ "$1" = identify ] && sleep {seconds}')


def require_all(url):
    assert fleet.statuses(url) == {"ok": GOOD, "unreadable": 2, "unread": 1}
    fleet.require_whole(url)
    assert fleet.rows(url, "SELECT vehicle, count(*) FROM drives GROUP BY vehicle ORDER BY vehicle") == [
        ("robot_1", 12), ("robot_2", 12)]
    reasons = dict(fleet.rows(url, "SELECT path, reason FROM drives WHERE reason IS NOT NULL"))
    assert {os.path.basename(path): words for path, words in reasons.items() if "bag of format" not in words} == {
        "cut.bag": "is cut off (rosbag reindex saves what is left)", "empty.bag": "is empty"}
    assert len(reasons) == CORRUPT


def test_every_bag_is_a_row_and_is_read_once(bags, url, tmp_path, counting):
    program, read = counting
    output = fleet.succeed(tmp_path, "scan", bags, "--db", url, "--workers", 2, program=program)
    assert output.splitlines()[0] == "24 bags: 21 ok, 1 unread, 2 unreadable"
    require_all(url)
    assert len(read()) == GOOD + 2, "the empty one is not worth a process"
    output = fleet.succeed(tmp_path, "scan", "bags", "--db", url, program=program)
    assert output.splitlines()[0] == "24 bags: 23 known, 1 unread"
    assert len(read()) == GOOD + 2, "none is read again"
    require_all(url)
    fleet.copies(bags / "robot_1/0.bag", bags / "robot_2", 1, first=99)  # a new one,
    (bags / "robot_1/text.bag").write_bytes((bags / "robot_1/0.bag").read_bytes().replace(b"00000000", b"00000088", 1))
    output = fleet.succeed(tmp_path, "scan", "bags/*/*", "--db", url, program=program)
    assert output.splitlines()[0] == "25 bags: 22 known, 2 ok, 1 unread"
    assert len(read()) == GOOD + 4 and {"99.bag", "text.bag"} <= set(read())
    assert fleet.statuses(url) == {"ok": GOOD + 2, "unreadable": 1, "unread": 1}, "what was at that path is forgotten"


def test_streams_that_are_closed_are_none_that_matter(bags, url, tmp_path):
    """Neither the database nor a page may become standard error."""
    for command in (["scan", "bags", "--db", url], ["show", "--db", url], ["report", "--db", url, "-o", "page"],
                    ["show", "--db", "sqlite:///none.db"]):
        process = subprocess.run(["sh", "-c", 'exec "$@" <&- 2>&-', "sh", *fleet.COMMAND, *map(str, command)], cwd=tmp_path,
                                 stdout=subprocess.PIPE, text=True, timeout=conftest.HANGS)
        if "sqlite:///none.db" in command:
            assert (process.returncode, process.stdout) == (3, ""), "what is said of it is not told as its output"
        else:
            assert process.returncode == 0 and process.stdout.startswith({"scan": "24 bags: 21 ok", "show": "vehicle",
                                                                          "report": "wrote page"}[command[0]])
    require_all(url)


def test_a_bag_that_lies_there_twice_is_one(bag, url, tmp_path):
    for name in ("a", "b", "c"):
        fleet.copies(bag, tmp_path / name, 1)
    assert "3 bags: 2 known, 1 ok" in fleet.succeed(tmp_path, "scan", ".", "--db", url, *ONE)
    assert fleet.statuses(url) == {"ok": 1}


def test_a_database_that_is_lost_is_said_in_words(bag, url, tmp_path):
    fleet.copies(bag, tmp_path / "robot", 1)
    fleet.succeed(tmp_path, "scan", "robot", "--db", url, *ONE)
    with sqlite3.connect(tmp_path / "fleet.db") as connection:
        connection.execute("DROP TABLE struts")
    status, output, error = fleet.run(tmp_path, "scan", "robot", "--db", url, "--again", *ONE)
    assert (status, output) == (3, "") and "no such table: struts" in error and "Traceback" not in error


def test_what_failed_may_not_fail_with_other_options(bag, url, tmp_path):
    fleet.copies(bag, tmp_path / "robot", 2)
    assert "2 unreadable" in fleet.succeed(tmp_path, "scan", "robot", "--db", url, *ONE, "--sprung-topic", "/none")
    assert "2 ok" in fleet.succeed(tmp_path, "scan", "robot", "--db", url, *ONE)
    assert "2 known" in fleet.succeed(tmp_path, "scan", "robot", "--db", url, "--set", "memory=3")
    assert "2 ok" in fleet.succeed(tmp_path, "scan", "robot", "--db", url, "--set", "memory=3", "--again", *ONE)
    assert fleet.statuses(url) == {"ok": 2}
    fleet.require_whole(url)


def test_wrong_options_end_it_and_write_nothing(bags, url, tmp_path, capsys):
    for arguments, status, words in (
            (["--set", "no_option=1", *ONE], 2, "unknown option no_option"), (["--workers", "0"], 2, "--workers"),
            (["--vehicle-pattern", "robot"], 2, "has no group"), (["--config", "none.yaml"], 3, "none.yaml"),
            (["--pages", "pages"], 2, "--diagnose")):
        command = ["scan", bags / "robot_1/0.bag", "--db", url, *arguments]
        # suspension_bag refuses a wrong --set; it runs in a worker, so this case needs a cluster.
        found, output, error = fleet.run(tmp_path, *command) if "--set" in arguments else fleet.run_here(capsys, *command)
        assert (found, output) == (status, ""), error
        assert words in error and "Traceback" not in error
        assert not pathlib.Path(url[len("sqlite:///"):]).exists() or fleet.statuses(url) == {}


def test_a_scheduler_that_does_not_answer_is_named():
    with pytest.raises(FleetError, match="no scheduler at tcp://127.0.0.1:1"):
        with open_client(scheduler="tcp://127.0.0.1:1", patience=1):
            pass


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_scan_that_is_ended_goes_on_where_it_was(program, bags, url, tmp_path, number, monkeypatch, counting):
    process = fleet.start(tmp_path, "scan", bags, "--db", url, program=slow(program, tmp_path, monkeypatch),
                          start_new_session=True)
    conftest.wait_until(lambda: has_rows(url, 6))
    (os.kill if number == signal.SIGKILL else os.killpg)(process.pid, number)  # the latter as a terminal does
    status, output, error = fleet.finish(process)
    assert (status, output) == (-number, "")
    told = [] if number == signal.SIGKILL else [f"suspension_fleet scan: ended by {number.name}"]
    assert [line for line in error.splitlines() if ".bag: " not in line] == told
    done = sum(fleet.statuses(url).values())
    assert 6 <= done < GOOD + CORRUPT
    fleet.require_whole(url)
    again, read = counting
    fleet.succeed(tmp_path, "scan", bags, "--db", url, program=again)
    assert len(read()) <= GOOD + CORRUPT - done
    require_all(url)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("seconds", [0, 0.8])
def test_a_scan_that_is_ended_before_it_reads_says_so(program, bags, url, tmp_path, number, seconds, monkeypatch):
    process = fleet.start(tmp_path, "scan", bags, "--db", url, program=slow(program, tmp_path, monkeypatch, "3"),
                          start_new_session=True)
    conftest.wait_until(lambda: "\nSigBlk:\t0000000000004002\n" in pathlib.Path(f"/proc/{process.pid}/status").read_text())
    time.sleep(seconds)  # meanwhile it imports, and starts its cluster
    os.killpg(process.pid, number)
    assert fleet.finish(process) == (-number, "", f"suspension_fleet scan: ended by {number.name}\n")
    conftest.wait_until(lambda: fleet.session(process.pid) == [])


def has_rows(url, count):
    return pathlib.Path(url[len("sqlite:///"):]).exists() and tables_are_there(url) and \
        fleet.rows(url, "SELECT count(*) FROM drives")[0][0] >= count


def tables_are_there(url):
    return fleet.rows(url, "SELECT name FROM sqlite_master WHERE name = 'drives'") != []


@contextlib.contextmanager
def dask(folder, name, *arguments):
    with open(folder / f"{name}.log", "w") as log:
        process = subprocess.Popen([sys.executable, "-m", f"distributed.cli.dask_{name}", *map(str, arguments),
                                    "--no-dashboard"], cwd=folder, stdout=log, stderr=log)
    try:
        yield process
    finally:
        process.terminate()
        process.wait()


def workers(stack, folder, address):
    """Two of them, started by hand; their processes."""
    return [stack.enter_context(dask(folder, "worker", address, "--nthreads", 1, "--no-nanny", "--local-directory",
                                     folder / f"local_{number}")) for number in range(2)]


def test_a_worker_and_the_scheduler_are_killed(program, bags, url, port, tmp_path, monkeypatch):
    path = slow(program, tmp_path, monkeypatch)  # workers, too, have its environment
    address = f"tcp://127.0.0.1:{port}"
    scheduler = ["scheduler", "--host", "127.0.0.1", "--port", port]
    with contextlib.ExitStack() as stack:
        first = stack.enter_context(dask(tmp_path, *scheduler))
        of_first = workers(stack, tmp_path, address)
        process = fleet.start(tmp_path, "scan", bags, "--db", url, "--scheduler", address, program=path)
        conftest.wait_until(lambda: has_rows(url, 4))
        of_first[0].kill()
        conftest.wait_until(lambda: has_rows(url, 8))
        first.kill()
        first.wait()
        stack.enter_context(dask(tmp_path, *scheduler))
        workers(stack, tmp_path, address)
        status, output, error = fleet.finish(process)
    assert status == 0, error
    assert output.splitlines()[0] == "24 bags: 21 ok, 1 unread, 2 unreadable"
    require_all(url)


def test_a_bag_that_kills_its_process_takes_no_other(program, bags, url, tmp_path, monkeypatch):
    monkeypatch.setenv("REAL", program.path)
    deadly = fleet.write_program(tmp_path / "deadly", 'case "$2" in */7.bag) kill -9 $$;; esac')
    fleet.succeed(tmp_path, "scan", bags, "--db", url, program=deadly)
    assert fleet.statuses(url) == {"ok": GOOD - 1, "crashed": 1, "unreadable": 2, "unread": 1}
    ((path, reason),) = fleet.rows(url, "SELECT path, reason FROM drives WHERE status = 'crashed'")
    assert path.endswith("/7.bag") and "SIGKILL" in reason


def test_a_good_result_outlives_a_crash(program, bag, url, tmp_path, monkeypatch):
    monkeypatch.setenv("REAL", program.path)
    fleet.copies(bag, tmp_path / "robot", 2)
    fleet.succeed(tmp_path, "scan", "robot", "--db", url, *ONE)
    before = fleet.rows(url, "SELECT * FROM drives JOIN struts ON struts.drive_id = drives.id ORDER BY path")
    deadly = fleet.write_program(tmp_path / "deadly", "kill -9 $$")
    status, output, error = fleet.run(tmp_path, "scan", "robot", "--db", url, "--again", *ONE, program=deadly)
    assert (status, output.splitlines()[0]) == (0, "2 bags: 2 known"), error
    assert error.count("was ended by SIGKILL, as for want of memory; what is known of it stays\n") == 2
    assert before == fleet.rows(url, "SELECT * FROM drives JOIN struts ON struts.drive_id = drives.id ORDER BY path")


def test_a_wrong_program_ends_it_and_writes_nothing(bag, url, tmp_path, capsys, monkeypatch):
    fleet.copies(bag, tmp_path / "robot", 1)
    for path in (tmp_path / "none", tmp_path, bag):
        monkeypatch.setenv("SUSPENSION_BAG", str(path))
        status, output, error = fleet.run_here(capsys, "scan", tmp_path / "robot", "--db", url)
        assert (status, output) == (3, "")
        assert error.startswith(f"suspension_fleet scan: SUSPENSION_BAG is {path}, must be the path of")
    (tmp_path / "script").write_text("#!/nowhere/sh\n")
    (tmp_path / "script").chmod(0o755)
    status, output, error = fleet.run(tmp_path, "scan", "robot", "--db", url, *ONE, program=tmp_path / "script")
    assert (status, output) == (3, "") and "failed to execute" in error and "Traceback" not in error
    assert fleet.statuses(url) == {}


def test_names_do_not_reach_the_terminal_as_controls(url, tmp_path, capsys):
    folder = tmp_path / "ro\x1b[31mbot\n"
    folder.mkdir()
    (folder / "\x1b]0;title\x07.bag").touch()
    status, output, error = fleet.run(tmp_path, "scan", folder, "--db", url, *ONE)
    assert (status, output.splitlines()[0]) == (0, "1 bags: 1 unread")
    assert error == f"{tmp_path}/ro\\x1b[31mbot\\n/\\x1b]0;title\\x07.bag: is empty\n"
    status, _, error = fleet.run_here(capsys, "scan", folder / "none", "--db", url)
    assert status == 3 and "ro\\x1b[31mbot\\n/none: no such file" in error


def test_a_bag_that_kills_its_workers_ends_as_a_row(bag, url, tmp_path, monkeypatch):
    """With the worker that runs it: no worker is left in the end, and yet the scan ends."""
    fleet.copies(bag, tmp_path / "robot", 1)
    monkeypatch.setenv("DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES", "0")
    deadly = fleet.write_program(tmp_path / "deadly", "kill -9 $PPID")
    status, output, error = fleet.run(tmp_path, "scan", "robot", "--db", url, "--workers", 1, program=deadly)
    assert (status, output.splitlines()[0]) == (0, "1 bags: 1 unread"), error
    assert fleet.rows(url, "SELECT reason FROM drives") == [("the workers that were to read it have ended",)]
