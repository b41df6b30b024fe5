"""The fleet's database: what every bag has said, one transaction for each. Any database that SQLAlchemy reaches.

doc/fleet.md has a line for every column. Queries are plain SQL, which SQLAlchemy 1.3 to 2 take alike.
"""
import collections
import contextlib
import dataclasses
import logging
import re
import time
from typing import Optional

import numpy as np
from sqlalchemy import (Boolean, Column, Float, ForeignKey, Integer, MetaData, String, Table, Text, create_engine,
                        inspect, text)
from sqlalchemy.exc import ArgumentError, IntegrityError, NoSuchModuleError, SQLAlchemyError

from . import wording
from .drive import CRASHED, ESTIMATOR, OK, UNREAD, UNREADABLE
from .errors import FleetError, UsageError, naming
from .history import Event, Finding, StrutHistory

SCHEMA_VERSION = 2
READABLE = (1, SCHEMA_VERSION)
# A computer without a clock begins at 1970 or where its maker did, ROS is of 2007; simulated time begins at 0. What begins
# before 1 January 2000 [s since 1970], or after it was scanned, is no date, or of a clock of its own.
EARLIEST = 946684800.0
_HAS_DATE = "drives.start BETWEEN :earliest AND drives.scanned_at"
LOCK_TIMEOUT = 60  # [s] that a client waits while others write into the same SQLite file


class Time(Float):
    """[s since 1970]"""


# It would print how it closes a connection when Ctrl-C or SIGTERM comes in between; errors are raised besides.
logging.getLogger("sqlalchemy.pool").setLevel(logging.CRITICAL)

metadata = MetaData()
schema = Table("fleet_schema", metadata, Column("version", Integer, primary_key=True, autoincrement=False))
drives = Table(
    "drives", metadata, Column("id", Integer, primary_key=True),
    Column("key", String(64), nullable=False, unique=True), Column("path", Text, nullable=False),
    Column("vehicle", Text, index=True), Column("start", Time), Column("duration", Float),
    Column("status", String(16), nullable=False), Column("reason", Text), Column("diagnosed", Boolean, nullable=False),
    Column("options", String(64), nullable=False), Column("scanned_at", Time, nullable=False))


def _of_drive():
    return Column("drive_id", Integer, ForeignKey("drives.id"), nullable=False, index=True)


struts = Table(
    "struts", metadata, Column("id", Integer, primary_key=True), _of_drive(), Column("strut", Text, nullable=False),
    Column("estimator", String(16)), Column("damping_to_mass", Float), Column("damping_to_mass_stddev", Float),
    Column("stiffness_to_mass", Float), Column("stiffness_to_mass_stddev", Float), Column("offset", Float),
    Column("temperature", Float),
    Column("valid", Boolean, nullable=False), Column("reason", Text))
events = Table(
    "events", metadata, Column("id", Integer, primary_key=True), _of_drive(), Column("strut", Text, nullable=False),
    Column("time", Time, nullable=False), Column("level", String(8), nullable=False),
    Column("message", Text, nullable=False))
findings = Table(
    "findings", metadata, Column("id", Integer, primary_key=True), _of_drive(), Column("strut", Text, nullable=False),
    Column("verdict", Text, nullable=False), Column("effects", Text, nullable=False), Column("page", Text))


def connect(url, create=False):
    """An engine of a database that has our tables.

    :param create: make the tables, and a SQLite file, that are not there yet; those of an older schema become ours.
    :raises FleetError: no such database, or one of a newer schema. UsageError: no URL.
    """
    try:
        sqlite = url.startswith("sqlite:")
        engine = create_engine(url, **({"connect_args": {"timeout": LOCK_TIMEOUT}} if sqlite else {}))
    except (ArgumentError, NoSuchModuleError, ValueError) as error:
        without_password = re.sub(r":[^:@/]*@", ":***@", url)
        raise UsageError(f"--db {without_password}: {error}; must be a URL such as sqlite:///fleet.db or "
                         "postgresql://user@host/fleet") from error
    with in_words(engine):
        if create:
            _make_tables(engine)
        version = _version(engine)
        if create and version == 1:
            version = _migrate(engine)
    if version is None:
        raise FleetError(f"{shown(engine)} has no fleet in it: `suspension_fleet scan` makes one")
    if version not in READABLE:
        raise FleetError(f"{shown(engine)} has schema version {version}, this program knows {SCHEMA_VERSION}: "
                         "use the suspension_fleet that has written it, or a newer one")
    return engine


@contextlib.contextmanager
def in_words(engine):
    """:raises FleetError: of what the database itself says, without SQLAlchemy's frame around it."""
    try:
        yield
    except SQLAlchemyError as error:
        raise FleetError(f"{shown(engine)}: {' '.join(str(getattr(error, 'orig', None) or error).split())}") from error


def shown(engine):
    """Its URL without the password."""
    return repr(engine.url)


def _version(engine):
    """Of its schema; None where that has not been made, or not to the end."""
    if engine.url.drivername.startswith("sqlite") and engine.url.database not in (None, "", ":memory:"):
        with naming(engine.url.database):
            open(engine.url.database, "rb").close()  # to connect would make an empty file
    inspector = inspect(engine)
    if not (inspector if hasattr(inspector, "has_table") else engine).has_table(schema.name):
        return None
    with engine.begin() as connection:
        return connection.execute(text("SELECT max(version) FROM fleet_schema")).fetchone()[0]


def _make_tables(engine):
    """Clients may do so at once, and SQLite has no transactions around tables: who fails finds one more table than before."""
    for _ in metadata.tables:
        with contextlib.suppress(SQLAlchemyError):
            return _try_to_make_tables(engine)
    _try_to_make_tables(engine)


def _try_to_make_tables(engine):
    with engine.begin() as connection:
        schema.create(connection, checkfirst=True)
        if connection.execute(text("SELECT version FROM fleet_schema")).fetchone() is None:
            metadata.create_all(connection)
            connection.execute(schema.insert().values(version=SCHEMA_VERSION))


def _migrate(engine):
    """From schema 1: its rows stay, and so do the columns of the former estimators, which stay empty from now on. Clients
    may do so at once. SQLite stores any length in any column."""
    with engine.begin() as connection:
        if engine.dialect.name != "sqlite":
            connection.execute(text(f"ALTER TABLE struts ALTER COLUMN estimator TYPE {struts.c.estimator.type}"))
        connection.execute(schema.update().values(version=SCHEMA_VERSION))
    return SCHEMA_VERSION


@dataclasses.dataclass(frozen=True)
class Bag:
    """A bag, and how it is to be read."""
    key: str                # of its content
    path: str
    vehicle: Optional[str]  # None: its path does not say
    options: str = ""       # a hash of all of them
    diagnose: bool = False


def is_known(engine, bag):
    """Whether the database has what reading a bag would tell. One that failed may not fail with other options."""
    with engine.begin() as connection:
        return _answers(_row(connection, bag), bag)


def _row(connection, bag):
    return connection.execute(text("SELECT id, status, diagnosed, options, scanned_at FROM drives WHERE key = :key"),
                              {"key": bag.key}).fetchone()


def _answers(row, bag):
    if row is None or row[1] == UNREAD:
        return False
    _, status, diagnosed, options, _ = row
    return bool(diagnosed) or not bag.diagnose if status == OK else options == bag.options


def write(engine, bag, drive, again=False):
    """Writes all rows of a bag, or none; instead of those of the same bag, or of another one at its path that was none.

    :param again: also if the bag is known.
    :returns: False if the rows that are there stay: another client was faster, or the bag was ok, against which a
        process or a worker that is lost says nothing.
    """
    row = dict(key=bag.key, path=bag.path, vehicle=bag.vehicle, start=drive.start, duration=drive.duration,
               status=drive.status, reason=drive.reason, diagnosed=drive.diagnosed, options=bag.options,
               scanned_at=time.time())
    try:
        with engine.begin() as connection:
            before = _row(connection, bag)
            good = before is not None and before[1] == OK
            if not again and _answers(before, bag) or good and drive.status in (CRASHED, UNREAD):
                return False
            _forget(connection, bag, before)
            if before is not None:
                row["scanned_at"] = before[4]  # what a scan has read was driven before
            (drive_id,) = connection.execute(drives.insert().values(**row)).inserted_primary_key
            for table, rows in ((struts, drive.struts), (events, drive.events), (findings, drive.findings)):
                if rows:
                    connection.execute(table.insert(), [dict(each, drive_id=drive_id) for each in rows])
    except IntegrityError:
        if not is_known(engine, bag):
            raise
        return False
    return True


def _forget(connection, bag, before):
    """Of the same bag only what has been seen: what another client writes meanwhile stays, and is in the way of ours."""
    ids = [row[0] for row in connection.execute(
        text("SELECT id FROM drives WHERE path = :path AND key <> :key AND "
             f"status IN ('{UNREADABLE}', '{CRASHED}', '{UNREAD}')"), {"path": bag.path, "key": bag.key})]
    for drive_id in ids + ([before[0]] if before else []):
        for table in (struts, events, findings):
            connection.execute(table.delete().where(table.c.drive_id == drive_id))
        connection.execute(drives.delete().where(drives.c.id == drive_id))


def counts(engine):
    """{status: how many drives}."""
    with engine.begin() as connection:
        return dict(map(tuple, connection.execute(text("SELECT status, count(*) FROM drives GROUP BY status"))))


# What is read: vehicle and strut, by which it is put together, the time that it is of, and the rest.
_ESTIMATES = (drives.c.vehicle, struts.c.strut, drives.c.start, struts.c.damping_to_mass,
              struts.c.damping_to_mass_stddev, struts.c.stiffness_to_mass, struts.c.stiffness_to_mass_stddev,
              struts.c.temperature, drives.c.path, struts.c.estimator, struts.c.valid)
_EVENTS = (drives.c.vehicle, events.c.strut, events.c.time, events.c.level, events.c.message, drives.c.path)
_FINDINGS = (drives.c.vehicle, findings.c.strut, drives.c.start, findings.c.verdict, findings.c.effects, drives.c.path,
             findings.c.page)


def _by_strut(connection, columns, with_dates, wrong_clocks):
    """{(vehicle, strut): the other columns of its rows, by time}.

    :param with_dates: the vehicles that have drives with dates: those without one are left out.
    :param wrong_clocks: {(vehicle, strut): set of the drives that are left out}, to which it adds.
    :raises FleetError: a value of another kind.
    """
    vehicle, strut, time, *_ = columns
    known = " AND ".join(f"{column} IS NOT NULL" for column in (vehicle, time) if column.nullable)
    query = (f"SELECT drives.id, drives.start, {_HAS_DATE}, {', '.join(map(str, columns))} FROM drives JOIN {strut.table} "
             f"ON {strut.table}.drive_id = drives.id WHERE {known} ORDER BY {time}, {strut.table}.id")
    rows = collections.defaultdict(list)
    for drive, start, has_date, *row in connection.execute(text(query), {"earliest": EARLIEST}):
        for column, value in zip((drives.c.start, *columns), (start, *row)):
            _require_kind(connection, drive, column, value)
        if start is None or has_date or row[0] not in with_dates:
            rows[tuple(row[:2])].append(row[2:])
        else:
            wrong_clocks[tuple(row[:2])].add(drive)
    return rows


_KINDS = {
    Time: (wording.is_date, "seconds since 1970"),
    Float: (lambda value: isinstance(value, (int, float)), "a number"),
    Boolean: (lambda value: value in (0, 1), "true or false"),
    String: (lambda value: isinstance(value, str), "text"),
    Text: (lambda value: isinstance(value, str), "text")}


def _require_kind(connection, drive, column, value):
    """SQLite takes any value in any column. :raises FleetError: one that is not of the column's kind."""
    is_of_kind, words = _KINDS[type(column.type)]
    if not (column.nullable if value is None else is_of_kind(value)):
        found = "null" if value is None else repr(value)[:60]
        raise FleetError(f"{shown(connection.engine)}: {column} of the drive with id {drive} is {found}, must be {words}")


def histories(engine):
    """A StrutHistory of every strut, by vehicle and name. Arrays have the drives whose estimate is valid; a finding's
    effects are a list of names. Drives of wrong clocks are counted only.

    :raises FleetError: the tables are not there, are others, or have values of other kinds.
    """
    wrong_clocks = collections.defaultdict(set)
    with in_words(engine), engine.begin() as connection:
        dated = text(f"SELECT DISTINCT vehicle FROM drives WHERE {_HAS_DATE}")
        with_dates = {vehicle for (vehicle,) in connection.execute(dated, {"earliest": EARLIEST})}
        estimates, happened, found = (_by_strut(connection, columns, with_dates, wrong_clocks)
                                      for columns in (_ESTIMATES, _EVENTS, _FINDINGS))
    result = []
    for vehicle, strut in sorted({*estimates, *happened, *found, *wrong_clocks}):
        rows = [row for row in estimates[vehicle, strut] if row[-1]]
        *numbers, warm = np.array([row[:6] for row in rows], dtype=float).reshape(len(rows), 6).T
        former = np.array([row[7] != ESTIMATOR for row in rows], dtype=bool)
        result.append(StrutHistory(vehicle, strut, *numbers, [row[6] for row in rows],
                                   [Event(*row) for row in happened[vehicle, strut]],
                                   [Finding(when, verdict, effects.split(), path, page)
                                    for when, verdict, effects, path, page in found[vehicle, strut]],
                                   len(wrong_clocks[vehicle, strut]), former if former.any() and not former.all() else None,
                                   warm if np.isfinite(warm).any() else None))
    return result
