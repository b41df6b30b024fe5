"""Instants as people have them: datetime objects and dates as text, with a time zone or in UTC."""
import datetime
import re

import numpy as np

_ISO = re.compile(r"(\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::\d\d(?:[.,]\d{1,9})?)?)?) ?(Z|[+-]\d\d(?::?\d\d)?)?")


def to_utc(name, values):
    """An array of texts or objects as datetime64, UTC. What names no zone is in UTC."""
    instants = [_instant(each) for each in values.flat]
    if None in instants:
        k = instants.index(None)
        raise ValueError(f"{name}[{k}] = {values.ravel().tolist()[k]!r}, must be a datetime, or a date as text such as "
                         "2026-05-01T12:00:00.25+02:00; numbers must be in an array of numbers")
    return np.array(instants, dtype="datetime64[ns]").reshape(values.shape)


def _instant(given):
    if isinstance(given, str):
        return instant_of_text(given.strip())
    if hasattr(given, "to_datetime64"):  # of pandas, which keeps nanoseconds
        return given.to_datetime64()
    if isinstance(given, datetime.datetime):
        utc = given if given.tzinfo is None else given.astimezone(datetime.timezone.utc).replace(tzinfo=None)
        return np.datetime64(utc, "ns")
    return None


def instant_of_text(text):
    """A datetime64; None: it is no date."""
    found = _ISO.fullmatch(text)
    try:
        return found and np.datetime64(found[1].replace(",", "."), "ns") - _offset(found[2])
    except ValueError:  # such as month 13
        return None


def _offset(zone):
    """What the clocks of a zone, such as +02:00, +0200 or +02, are ahead of UTC."""
    if zone in (None, "Z"):
        return np.timedelta64(0, "m")
    digits = zone[1:].replace(":", "")
    minutes = 60 * int(digits[:2]) + int(digits[2:] or 0)
    return np.timedelta64(-minutes if zone[0] == "-" else minutes, "m")
