"""The fleet's database on PostgreSQL: a server of the test's own, and two clients that scan at once."""
import glob
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile

import pytest

import conftest
import fleet

pytest.importorskip("psycopg2")
PROGRAMS = sorted(glob.glob("/usr/lib/postgresql/*/bin/pg_ctl"))
BAGS = 12


@pytest.fixture(scope="module")
def server():
    """The URL of a database of an empty server."""
    if not PROGRAMS:
        pytest.skip("PostgreSQL is not installed (Debian: postgresql)")
    user = ["runuser", "-u", "postgres", "--"] if os.geteuid() == 0 else []  # it refuses to run as root
    programs = os.path.dirname(PROGRAMS[-1])
    with conftest.held_port() as port, \
            tempfile.TemporaryDirectory(prefix="postgres.") as folder:  # pytest's own is closed to other users
        if user:
            shutil.chown(folder, "postgres")

        def call(program, *arguments):
            done = subprocess.run([*user, f"{programs}/{program}", *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                                  stdout=log, stderr=log, timeout=conftest.HANGS)
            assert done.returncode == 0, pathlib.Path(log.name).read_text()

        with open(os.path.join(folder, "log"), "w") as log:
            call("initdb", "-D", f"{folder}/data", "-A", "trust", "-U", "fleet", "--no-sync")
            call("pg_ctl", "-D", f"{folder}/data", "-w", "-o", f"-k {folder} -p {port} -h 127.0.0.1 -F", "start")
            try:
                call("createdb", "-h", folder, "-p", str(port), "-U", "fleet", "fleet")
                yield f"postgresql://fleet:secret@127.0.0.1:{port}/fleet"
            finally:
                call("pg_ctl", "-D", f"{folder}/data", "-m", "immediate", "stop")


@pytest.fixture(scope="module")
def bags(program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bags")
    program.succeed("simulate", "--duration", "20", "-o", folder / "drive.bag")
    fleet.copies(folder / "drive.bag", folder / "robot", BAGS)
    (folder / "robot/bad.bag").write_text("no bag\n")
    return folder / "robot"


def test_two_clients_at_once_and_one_is_killed(program, bags, server, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("REAL", program.path)
    slow = fleet.write_program(tmp_path / "slow", '[ "$1" = identify ] && sleep 0.3')
    clients = [fleet.start(tmp_path, "scan", bags, "--db", server, "--workers", 1, program=slow) for _ in range(3)]
    conftest.wait_until(lambda: has_rows(server, 2))
    clients[0].send_signal(signal.SIGKILL)
    fleet.finish(clients[0])
    for client in clients[1:]:
        status, output, error = fleet.finish(client)
        assert status == 0, error
        assert f"{BAGS + 1} bags: " in output and "secret" not in output, "the password is nobody's business"
    assert fleet.statuses(server) == {"ok": BAGS, "unreadable": 1}
    fleet.require_whole(server)
    assert f"{BAGS + 1} known" in fleet.run_here(capsys, "scan", bags, "--db", server)[1]


def has_rows(url, count):
    exists = fleet.rows(url, "SELECT 1 FROM information_schema.tables WHERE table_name = 'drives'")
    return bool(exists) and fleet.rows(url, "SELECT count(*) FROM drives")[0][0] >= count


def test_histories(server):
    from suspension_health_monitor.fleet import database
    (history,) = database.histories(database.connect(server))
    assert (history.vehicle, history.strut, len(history.time)) == ("robot", "strut", BAGS)
    assert set(history.damping_to_mass) == {history.damping_to_mass[0]} and history.damping_to_mass[0] > 0


def test_a_database_of_schema_1_is_migrated_in_place(server):
    """Its column is too narrow for the name of the estimator."""
    of_its_own = server.rpartition("/")[0] + "/old"
    import sqlalchemy
    with sqlalchemy.create_engine(server).connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        connection.execute(sqlalchemy.text("CREATE DATABASE old"))
    fleet.make_schema_1(of_its_own)
    fleet.require_migration(of_its_own)


def test_a_newer_schema_is_refused(server, tmp_path, capsys):
    import sqlalchemy
    engine = sqlalchemy.create_engine(server)
    with engine.begin() as connection:
        connection.execute(sqlalchemy.text("UPDATE fleet_schema SET version = 3"))
    assert fleet.run_here(capsys, "scan", tmp_path, "--db", server)[:2] == (3, "")
    (tmp_path / "a.bag").write_text("no bag\n")
    status, output, error = fleet.run_here(capsys, "scan", tmp_path, "--db", server)
    assert (status, output) == (3, "") and "has schema version 3, this program knows 2" in error
