"""Arrays by name: keywords, and the columns of a DataFrame."""
import reprlib

import numpy as np

from ._arrays import as_array

_WAYS = [(stamps, "body", "wheel") for stamps in ("stamps", "time", "period")] + \
    [("stamps_body", "body", "stamps_wheel", "wheel")]
_ALLOWED = "stamps (or time, or period), body, wheel or stamps_body, body, stamps_wheel, wheel"

NAMES = {name for way in _WAYS for name in way} | {"stamps_road", "road", "across"}


def is_frame(given):
    """Whether it is a DataFrame: of pandas, or of whoever makes one alike."""
    return hasattr(given, "columns") and hasattr(given, "__getitem__")


def in_order(arrays, named):
    """Three arrays, or four with stamps of each sensor, from what was given in order, by name, or as a DataFrame."""
    if arrays and named:
        raise ValueError(f"{_listed(named)} are given by name and {_listed(arrays)} in order, must be all by name or "
                         "all in order")
    if len(arrays) == 1 and is_frame(arrays[0]):
        return _of_frame(arrays[0])
    if len(arrays) in (3, 4):
        return arrays
    return _by_name(named, f"given: {_listed(named or arrays)}; must be {_ALLOWED}")


def stacked(name, values, columns):
    """The columns of a DataFrame by their names, as one array; anything else as it is."""
    if not is_frame(values):
        return values
    if not set(columns) <= set(values.columns):
        raise ValueError(f"{name} has the columns {_listed(values.columns)}, must have {', '.join(columns)}")
    return np.column_stack([as_array(values[column]) for column in columns])


def _of_frame(frame):
    named = {name: frame[name] for way in _WAYS for name in way if name in frame.columns}
    index = getattr(frame, "index", None)
    if set(named) == {"body", "wheel"} and _is_time(index):
        named["stamps"] = index
    of_index = "" if getattr(index, "name", None) is None else f" and the index {index.name}"
    return _by_name(named, f"a DataFrame has the columns {_listed(frame.columns)}{of_index}, must have {_ALLOWED}; "
                           "rename columns, or give them one by one")


def _is_time(index):
    of_dates = getattr(getattr(index, "dtype", None), "kind", "") in ("m", "M")
    return of_dates or getattr(index, "name", None) in ("time", "stamps")


def _by_name(named, refusal):
    for way in _WAYS:
        if set(way) == set(named):
            return tuple(named[name] for name in way)
    raise ValueError(refusal)


def _listed(values):
    return ", ".join(values if all(isinstance(each, str) for each in values) else map(_said, values)) or "nothing"


def _said(value):
    shape = getattr(value, "shape", ())
    return f"{type(value).__name__} of shape {shape}" if shape else reprlib.repr(value)
