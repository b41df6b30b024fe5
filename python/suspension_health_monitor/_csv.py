"""A drive from a CSV file. Only the csv module of Python is needed, and it reads every file alike."""
import csv
import itertools
import os
from decimal import Decimal
from typing import Optional, Union

import numpy as np

from ._instants import instant_of_text
from ._recording import Recording
from ._types import Path

_NANOSECONDS = {"s": 10**9, "ms": 10**6, "us": 10**3, "ns": 1}
_ACCELERATIONS = {"m/s^2": 1.0, "g": 9.80665}
_MOST = 2**63 - 1  # nanoseconds


def read_csv(path: Path, *, time: Union[str, int] = "time", body: Union[str, int] = "body",
             wheel: Union[str, int] = "wheel", time_wheel: Optional[Union[str, int]] = None, time_unit: str = "s",
             acceleration_unit: str = "m/s^2", delimiter: str = ",", decimal: str = ".") -> Recording:
    """A Recording from a CSV file, for all functions that take drives.

    :param time, body, wheel: columns, by their names in the header, or by number from 0. time holds numbers, or dates
        as of Recording. Lines before the header are skipped. An empty cell is no reading.
    :param time_wheel: the times of the wheel carrier's readings, if they are others.
    :param time_unit: of times that are numbers: "s", "ms", "us" or "ns".
    :param acceleration_unit: of body and wheel: "m/s^2", or "g", which is 9.80665 m/s^2.
    :param delimiter: between two cells.
    :param decimal: the decimal sign.
    :raises ValueError: naming file and line, or the argument.
    """
    scale = _one_of("time_unit", time_unit, _NANOSECONDS)
    factor = _one_of("acceleration_unit", acceleration_unit, _ACCELERATIONS)
    if not (isinstance(delimiter, str) and len(delimiter) == 1):
        raise ValueError(f"delimiter = {delimiter!r}, must be one character")
    columns = [time, body, time if time_wheel is None else time_wheel, wheel]
    for column in columns:
        if not (isinstance(column, str) or isinstance(column, int) and column >= 0):
            raise ValueError(f"a column is {column!r}, must be a name in the header, or a number from 0")
    lines = list(_lines(os.fspath(path), columns, delimiter, decimal))
    in_dates = lines and not _is_number(lines[0][1][0])
    to_time = _of_date if in_dates else lambda cell: _nanoseconds(cell, scale)
    arrays = []
    for k in (0, 2):
        cells = [(line, its[k], its[k + 1]) for line, its in lines if its[k + 1]]
        stamps = [_read(path, line, columns[k], time, to_time) for line, time, _ in cells]
        values = [_read(path, line, columns[k + 1], value, float) for line, _, value in cells]
        arrays += [np.array(stamps, dtype="datetime64[ns]"), factor * np.array(values, dtype=np.float64)]
    return Recording(*arrays)


def _one_of(name, given, known):
    if given not in known:
        raise ValueError(f"{name} = {given!r}, must be one of {', '.join(known)}")
    return known[given]


def _lines(path, columns, delimiter, decimal):
    """Of every line below the header: its number, and its cells of the columns."""
    try:
        with open(path, newline="", encoding="utf-8-sig", errors="replace") as file:
            reader = csv.reader(file, delimiter=delimiter)
            rows = ([cell.strip() for cell in row] for row in reader if any(map(str.strip, row)))
            places, rows = _below_header(path, rows, columns)
            for row in rows:
                cells = [row[place].replace(decimal, ".") if place < len(row) else "" for place in places]
                yield reader.line_num, cells
    except (OSError, csv.Error) as error:
        raise ValueError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error


def _below_header(path, rows, columns):
    """Where the columns are in a row, and the rows with readings."""
    names = {column for column in columns if isinstance(column, str)}
    first = next(rows, [])
    for row in itertools.chain([first], rows):
        header = [cell.lstrip("# ") for cell in row]
        places = [header.index(column) if column in names else column for column in columns if names <= set(header)]
        if places and max(places) < len(row):
            return places, rows if names or not any(map(_is_number, row)) else itertools.chain([row], rows)
    wanted = ", ".join(map(str, dict.fromkeys(columns)))
    raise ValueError(f"{path} has no line with the columns {wanted}; its first line is {', '.join(first)!r:.200} "
                     "(time=, body=, wheel= and delimiter= name what a file has)")


def _is_number(cell):
    try:
        return float(cell) is not None
    except ValueError:
        return False


def _read(path, line, column, cell, convert):
    try:
        return convert(cell)
    except (ValueError, ArithmeticError):
        or_date = "" if convert is float else " or, in all lines, a date such as 2026-05-01T12:00:00.25+02:00"
        raise ValueError(f"{path}, line {line}: {column} = {cell!r}, must be a number{or_date}") from None


def _nanoseconds(cell, scale):
    whole = int((Decimal(cell) * scale).to_integral_value())
    if abs(whole) > _MOST:
        raise ValueError
    return whole


def _of_date(cell):
    instant = instant_of_text(cell)
    if instant is None:
        raise ValueError
    return instant.astype(np.int64)
