"""What the tests of suspension_fleet share: the command, small bags by the dozen, what a database holds."""
import contextlib
import os
import pathlib
import signal
import subprocess
import sys

import pytest

import conftest

for module in ("distributed", "scipy", "sqlalchemy"):
    pytest.importorskip(module)

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
COMMAND = [sys.executable, str(REPOSITORY / "python/suspension_fleet")]
TOPICS = {"sprung": "/sprung/imu", "unsprung": "/unsprung/imu"}


def start(folder, *arguments, program=None, **keywords):
    """The command as a process, in a folder; program: instead of suspension_bag."""
    environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1", **({"SUSPENSION_BAG": str(program)} if program else {}))
    return subprocess.Popen([*COMMAND, *map(str, arguments)], cwd=folder, env=environment, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, preexec_fn=_as_at_a_terminal, **keywords)


def _as_at_a_terminal():
    signal.signal(signal.SIGINT, signal.default_int_handler)


def finish(process):
    """(exit status, standard output, standard error)"""
    output, error = process.communicate(timeout=conftest.HANGS)
    return process.returncode, output, error


def run(folder, *arguments, **keywords):
    return finish(start(folder, *arguments, **keywords))


def succeed(folder, *arguments, **keywords):
    status, output, error = run(folder, *arguments, **keywords)
    assert status == 0, error
    assert "Traceback" not in error
    return output


def run_here(capsys, *arguments):
    """The same in this process, for what ends before a cluster starts: half of a run is its imports."""
    from suspension_health_monitor.fleet.command import main
    before = signal.getsignal(signal.SIGTERM), sys.unraisablehook
    try:
        status = main(list(map(str, arguments)))
    except SystemExit as end:  # of argparse
        status = end.code
    finally:
        signal.signal(signal.SIGTERM, before[0])
        sys.unraisablehook = before[1]
    return (status, *capsys.readouterr())


def copies(bag, folder, count, first=0):
    """Bags that differ in the padding of their header only: as many contents of the same drive."""
    content = pathlib.Path(bag).read_bytes()
    padding = content.index(b" " * 8)
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(first, first + count):
        (folder / f"{number}.bag").write_bytes(content[:padding] + b"%08d" % number + content[padding + 8:])


def rows(url, query):
    """All rows of a query, as tuples."""
    import sqlalchemy
    engine = sqlalchemy.create_engine(url)
    try:
        with engine.begin() as connection:
            return [tuple(row) for row in connection.execute(sqlalchemy.text(query))]
    finally:
        engine.dispose()


def statuses(url):
    return dict(rows(url, "SELECT status, count(*) FROM drives GROUP BY status"))


def require_whole(url):
    """Every drive has its struts once, and nothing is left of a drive that is not there."""
    assert rows(url, "SELECT key FROM drives GROUP BY key HAVING count(*) > 1") == []
    assert rows(url, "SELECT drive_id, strut FROM struts GROUP BY drive_id, strut HAVING count(*) > 1") == []
    for table in ("struts", "events", "findings"):
        assert rows(url, f"SELECT id FROM {table} WHERE drive_id NOT IN (SELECT id FROM drives)") == []
    assert rows(url, "SELECT id FROM drives WHERE status = 'ok' AND id NOT IN (SELECT drive_id FROM struts)") == []


def make_schema_1(url):
    """A database as the fleet had it at schema 1, with two drives of one strut by the estimators of then."""
    import sqlalchemy
    from sqlalchemy import Boolean, Column, Float, ForeignKey, Integer, String, Text
    from suspension_health_monitor.fleet import database
    engine = database.connect(url, create=True)
    its = sqlalchemy.MetaData()
    sqlalchemy.Table("drives", its, Column("id", Integer, primary_key=True))  # of which the next one refers to the number
    struts = sqlalchemy.Table(
        "struts", its, Column("id", Integer, primary_key=True),
        Column("drive_id", Integer, ForeignKey("drives.id"), nullable=False, index=True),
        Column("strut", Text, nullable=False), Column("estimator", String(2)), Column("damping_to_mass", Float),
        Column("damping_to_mass_stddev", Float), Column("stiffness_to_mass", Float),
        Column("stiffness_to_mass_stddev", Float), Column("damping_excitation", Float),
        Column("stiffness_excitation", Float), Column("offset", Float), Column("temperature", Float),
        Column("valid", Boolean, nullable=False), Column("reason", Text))
    with engine.begin() as connection:
        database.struts.drop(connection)
        struts.create(connection)
        connection.execute(database.schema.update().values(version=1))
        for number, (estimator, damping) in enumerate((("iv", 5.0), ("la", 4.0)), 1):
            connection.execute(database.drives.insert().values(
                key=f"old {number}", path=f"old_{number}.bag", vehicle="robot", start=1e9 + number, duration=60.0,
                status="ok", diagnosed=False, options="", scanned_at=1e9 + 100))
            connection.execute(struts.insert().values(
                drive_id=number, strut="left", estimator=estimator, damping_to_mass=damping, damping_to_mass_stddev=0.1,
                stiffness_to_mass=60.0, stiffness_to_mass_stddev=0.5, damping_excitation=7.0, stiffness_excitation=8.0,
                offset=0.01, valid=True))
    engine.dispose()


def require_migration(url):
    """A scan takes such a database over: old rows stay until they are replaced, new ones stand beside them."""
    from suspension_health_monitor.fleet import database
    from suspension_health_monitor.fleet.drive import OK, Drive
    for _ in range(2):
        engine = database.connect(url, create=True)
    assert rows(url, "SELECT version FROM fleet_schema") == [(2,)]
    strut = dict(strut="left", estimator="estimate", damping_to_mass=3.0, damping_to_mass_stddev=0.1,
                 stiffness_to_mass=60.0, stiffness_to_mass_stddev=0.5, offset=0.0, temperature=None, valid=True, reason=None)
    drive = Drive(OK, start=1e9 + 9, duration=60.0, struts=[strut])
    assert not database.write(engine, database.Bag("old 1", "old_1.bag", "robot"), drive), "it is known"
    assert database.write(engine, database.Bag("new", "new.bag", "robot"), drive)
    (history,) = database.histories(engine)
    assert history.damping_to_mass.tolist() == [5.0, 4.0, 3.0] and history.former.tolist() == [True, True, False]
    assert rows(url, "SELECT estimator, damping_excitation FROM struts ORDER BY id") == [
        ("iv", 7.0), ("la", 7.0), ("estimate", None)]
    assert database.write(engine, database.Bag("old 1", "old_1.bag", "robot"), drive, again=True)
    assert database.write(engine, database.Bag("old 2", "old_2.bag", "robot"), drive, again=True)
    (history,) = database.histories(engine)
    assert history.damping_to_mass.tolist() == [3.0, 3.0, 3.0] and history.former is None
    engine.dispose()


def write_program(path, lines):
    """A program instead of suspension_bag; $1 is the command, $2 the bag."""
    path.write_text("#!/bin/sh\n" + lines + '\nexec "$REAL" "$@"\n')
    path.chmod(0o755)
    return path


def session(number):
    """The processes of a session that run."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it has ended
            state, _, _, its_session = (folder / "stat").read_text().rpartition(")")[2].split()[:4]
            if int(its_session) == number and state != "Z":
                found.append(folder.name)
    return found


def is_zombie(process_id):
    return "\nState:\tZ" in pathlib.Path(f"/proc/{process_id}/status").read_text()
