"""The fleet's database: one transaction for each bag, whoever else writes; and what histories are made of."""
import re
import sqlite3
import threading
import time

import numpy as np
import pytest

import fleet
from suspension_health_monitor.fleet import database, wording
from suspension_health_monitor.fleet.drive import CRASHED, OK, POOR, UNREAD, UNREADABLE, Drive
from suspension_health_monitor.fleet.errors import FleetError, UsageError


def estimate(strut, damping, valid=True):
    return dict(strut=strut, estimator="estimate", damping_to_mass=damping, damping_to_mass_stddev=0.1,
                stiffness_to_mass=60.0, stiffness_to_mass_stddev=0.5, offset=0.01, temperature=None, valid=valid,
                reason=None if valid else "parked")


def bag(key, path="a.bag", **more):
    return database.Bag(key, path, "robot", **more)


def drive(start, damping, valid=True):
    return Drive(
        OK, start=start, duration=120.0, struts=[estimate("left", damping, valid), estimate("right", 5.0)],
        events=[dict(strut="left", time=start + 7, level="WARN", message="damping low")],
        findings=[dict(strut="left", verdict="effect_found", effects="bump_stop coulomb_friction", page=None)])


@pytest.fixture
def engine(tmp_path):
    return database.connect(f"sqlite:///{tmp_path / 'fleet.db'}", create=True)


def rows(engine, table):
    with engine.begin() as connection:
        return connection.execute(database.text(f"SELECT count(*) FROM {table}")).fetchone()[0]


def count_all(engine):
    return {table.name: rows(engine, table.name) for table in database.metadata.sorted_tables}


def test_a_bag_is_written_once(engine):
    assert not database.is_known(engine, bag("k"))
    assert database.write(engine, bag("k"), drive(0.0, 4.0))
    assert database.is_known(engine, bag("k"))
    before = count_all(engine)
    assert before == {"fleet_schema": 1, "drives": 1, "struts": 2, "events": 1, "findings": 1}
    assert not database.write(engine, bag("k", "b.bag"), drive(0.0, 3.0)), "known by content, whatever its name"
    assert count_all(engine) == before


def test_what_is_known_is_replaced_if_asked(engine):
    database.write(engine, bag("k"), drive(0.0, 4.0))
    database.write(engine, bag("other", "c.bag"), drive(9.0, 4.0))
    assert database.write(engine, bag("k", "b.bag"), Drive(UNREADABLE, "cut off"), again=True)
    assert count_all(engine) == {"fleet_schema": 1, "drives": 2, "struts": 2, "events": 1, "findings": 1}
    assert database.counts(engine) == {"ok": 1, "unreadable": 1}


@pytest.mark.parametrize("status", [CRASHED, UNREAD])
def test_a_reading_that_failed_takes_no_good_result_away(engine, status):
    failed = Drive(status, "was ended by SIGKILL")
    database.write(engine, bag("k"), drive(0.0, 4.0))
    before = count_all(engine)
    assert not database.write(engine, bag("k"), failed, again=True)
    assert not database.write(engine, bag("k", diagnose=True), failed)
    assert count_all(engine) == before and database.counts(engine) == {"ok": 1}
    database.write(engine, bag("k"), Drive(POOR, "parked"), again=True)
    assert database.write(engine, bag("k"), failed, again=True), "of a drive that tells of no strut"
    assert database.counts(engine) == {status: 1}


def test_a_lost_worker_says_nothing_about_the_bag(engine):
    assert database.write(engine, bag("k"), Drive(UNREAD, "its worker ended"))
    assert not database.is_known(engine, bag("k"))
    assert database.write(engine, bag("k"), drive(0.0, 4.0))
    assert database.counts(engine) == {"ok": 1}


def test_all_of_a_bag_or_nothing(engine):
    broken = Drive(OK, start=0.0, struts=[estimate("left", 4.0)],
                            events=[dict(strut="left", time=None, level="OK", message="no time")])
    with pytest.raises(Exception, match="events.time"):
        database.write(engine, bag("k"), broken)
    assert count_all(engine) == {"fleet_schema": 1, "drives": 0, "struts": 0, "events": 0, "findings": 0}


def test_clients_at_once_write_every_bag_once(tmp_path):
    url = f"sqlite:///{tmp_path / 'fleet.db'}"
    written = []

    def client():
        engine = database.connect(url, create=True)
        written.extend(database.write(engine, bag(str(k), f"{k}.bag"), drive(float(k), 4.0)) for k in range(20))

    clients = [threading.Thread(target=client) for _ in range(3)]
    for each in clients:
        each.start()
    for each in clients:
        each.join()
    assert sorted(written) == [False] * 40 + [True] * 20
    assert count_all(database.connect(url)) == {"fleet_schema": 1, "drives": 20, "struts": 40, "events": 20,
                                                "findings": 20}


def test_a_client_that_was_faster_stays(engine, monkeypatch):
    """Both have seen that the bag is not known; what the other has written then is not touched."""
    database.write(engine, bag("k"), drive(0.0, 4.0))
    row, seen = database._row, [None]
    monkeypatch.setattr(database, "_row", lambda *arguments: seen.pop() if seen else row(*arguments))
    assert not database.write(engine, bag("k"), drive(0.0, 3.0))
    with engine.begin() as connection:
        found = connection.execute(database.text("SELECT damping_to_mass FROM struts ORDER BY strut")).fetchall()
    assert [value for value, in found] == [4.0, 5.0]


def test_a_newer_schema_is_refused(tmp_path):
    url = f"sqlite:///{tmp_path / 'fleet.db'}"
    database.connect(url, create=True)
    with sqlite3.connect(tmp_path / "fleet.db") as connection:
        connection.execute("UPDATE fleet_schema SET version = 3")
    for create in (False, True):
        with pytest.raises(FleetError, match="fleet.db has schema version 3, this program knows 2"):
            database.connect(url, create)


def test_a_database_of_schema_1_is_migrated_in_place(tmp_path):
    url = f"sqlite:///{tmp_path / 'fleet.db'}"
    fleet.make_schema_1(url)
    (history,) = database.histories(database.connect(url))
    assert history.damping_to_mass.tolist() == [5.0, 4.0] and history.former is None, "may be read as it is"
    assert fleet.rows(url, "SELECT version FROM fleet_schema") == [(1,)]
    fleet.require_migration(url)


def test_what_is_no_fleet_is_refused(tmp_path):
    with pytest.raises(FleetError, match="No such file"):
        database.connect(f"sqlite:///{tmp_path / 'none.db'}")
    assert not (tmp_path / "none.db").exists()
    (tmp_path / "text.db").write_text("no database\n" * 100)
    for create in (False, True):
        with pytest.raises(FleetError, match="text.db.*not a database"):
            database.connect(f"sqlite:///{tmp_path / 'text.db'}", create)
    for table in ("other", "fleet_schema"):  # of which the second is what a scan begins with
        sqlite3.connect(tmp_path / f"{table}.db").execute(f"CREATE TABLE {table} (version INTEGER)")
        with pytest.raises(FleetError, match="suspension_fleet scan"):
            database.connect(f"sqlite:///{tmp_path / table}.db")
    for url in ("fleet.db", "nosuch://host/fleet"):
        with pytest.raises(UsageError, match="sqlite:///fleet.db"):
            database.connect(url)


@pytest.mark.parametrize("table", ["drives", "struts", "findings"])
def test_a_database_that_lacks_a_table_is_refused(engine, table):
    with engine.begin() as connection:
        connection.execute(database.text(f"DROP TABLE {table}"))
    with pytest.raises(FleetError, match=f"fleet.db.*no such table: {table}"):
        database.histories(engine)


@pytest.mark.parametrize("column, value, words", [
    ("drives.vehicle", b"\xff", "must be text"), ("drives.start", "2026-01-05", "must be seconds since 1970"),
    ("drives.start", 1e300, "must be seconds since 1970"), ("struts.damping_to_mass", "stiff", "must be a number"),
    ("struts.valid", "yes", "must be true or false"), ("events.time", None, "must be seconds since 1970"),
    ("events.message", None, "must be text"), ("findings.strut", None, "must be text")])
def test_values_of_another_kind_are_refused(engine, column, value, words):
    """As tables have them that others have made or filled."""
    database.write(engine, bag("k"), drive(0.0, 4.0))
    table, name = column.split(".")
    with engine.begin() as connection:
        connection.execute(database.text(f"ALTER TABLE {table} RENAME TO ours"))
        connection.execute(database.text(f"CREATE TABLE {table} AS SELECT * FROM ours"))
        connection.execute(database.text(f"UPDATE {table} SET {name} = :value"), {"value": value})
    found = "null" if value is None else re.escape(repr(value))
    with pytest.raises(FleetError, match=f"fleet.db: {column} of the drive with id 1 is {found}, {words}"):
        database.histories(engine)


def test_histories(engine):
    database.write(engine, bag("late", "late.bag"), drive(1e9 + 2000, 3.0))
    database.write(engine, bag("bad", "bad.bag"), Drive(UNREADABLE, "cut off"))
    database.write(engine, bag("early", "early.bag"), drive(1e9 + 1000, 4.0))
    database.write(engine, bag("parked", "parked.bag"), drive(1e9 + 1500, 9.0, valid=False))
    left, right = database.histories(engine)
    assert (left.vehicle, left.strut, right.strut) == ("robot", "left", "right")
    assert left.time.tolist() == [1e9 + 1000, 1e9 + 2000] and right.time.tolist() == [1e9 + 1000, 1e9 + 1500, 1e9 + 2000]
    assert left.damping_to_mass.tolist() == [4.0, 3.0] and left.damping_to_mass_stddev.tolist() == [0.1, 0.1]
    assert left.stiffness_to_mass.tolist() == [60.0, 60.0] and left.stiffness_to_mass_stddev.tolist() == [0.5, 0.5]
    assert left.path == ["early.bag", "late.bag"]
    assert [event.time for event in left.events] == [1e9 + 1007, 1e9 + 1507, 1e9 + 2007] and right.events == []
    assert (left.events[0].level, left.events[0].message, left.events[0].path) == ("WARN", "damping low", "early.bag")
    assert [finding.time for finding in left.findings] == [1e9 + 1000, 1e9 + 1500, 1e9 + 2000]
    assert (left.findings[0].verdict, left.findings[0].effects, left.findings[0].page) == (
        "effect_found", ["bump_stop", "coulomb_friction"], None)


def test_drives_of_wrong_clocks_are_counted_and_left_out(engine):
    for number, start in enumerate([0.0, database.EARLIEST - 1, database.EARLIEST, 1.7e9]):
        database.write(engine, bag(str(number), f"{number}.bag"), drive(start, 4.0))
    for history in database.histories(engine):
        assert history.time.tolist() == [database.EARLIEST, 1.7e9] and history.wrong_clocks == 2
        assert len(history.events) == len(history.findings) == (2 if history.strut == "left" else 0)
        assert wording.of_strut(history, None) == "no drive whose estimates are valid; 2 drives have a wrong clock"


def test_a_drive_stamped_after_its_scan_has_a_wrong_clock(engine):
    """And keeps it when it is scanned again, a year later."""
    now = time.time()
    for number, start in enumerate([1.7e9, now - 600, now + 3600]):
        database.write(engine, bag(str(number), f"{number}.bag"), drive(start, 4.0))
    with engine.begin() as connection:
        connection.execute(database.text("UPDATE drives SET start = start - 1e7, scanned_at = scanned_at - 1e7"))
    database.write(engine, bag("2", "2.bag"), drive(now - 1e7 + 3600, 4.0), again=True)
    for history in database.histories(engine):
        assert history.time == pytest.approx([1.69e9, now - 600 - 1e7]) and history.wrong_clocks == 1


def test_temperatures_go_with_the_drives(engine):
    warm = drive(1e9, 4.0)
    warm.struts[0]["temperature"] = 21.5
    database.write(engine, bag("warm", "warm.bag"), warm)
    database.write(engine, bag("later", "later.bag"), drive(1e9 + 9, 4.0))
    left, right = database.histories(engine)
    assert left.temperature[0] == 21.5 and np.isnan(left.temperature[1]) and right.temperature is None


def test_simulated_time_is_a_clock_of_its_own(engine):
    for start in (0.0, 7e5):
        database.write(engine, bag(str(start), f"{start}.bag"), drive(start, 4.0))
    for history in database.histories(engine):
        assert history.time.tolist() == [0.0, 7e5] and history.wrong_clocks == 0
