"""From what is like an array to an array of what the compiled part reads: numbers, and stamps in nanoseconds."""
import numpy as np

from ._instants import to_utc

_SHORTEST, _LONGEST = 1e-5, 10.0  # [s], as sample_period
_FARTHEST = 4e9  # [s], 126 years: the difference of two fits into nanoseconds
_FASTEST, _FEWEST = 1e-4, 10  # [s]: microseconds at 10 Hz and more are closer than that as nanoseconds; stamps to tell


def as_array(values):
    """A NumPy array. Of a Series or an Index of pandas: NaN where a number is missing; instants with a zone in UTC."""
    dtype = getattr(values, "dtype", None)
    kind = getattr(dtype, "kind", "O")
    if dtype is None or isinstance(dtype, np.dtype) or kind not in "fiuM":
        return np.asarray(values)
    if kind == "M":
        return np.asarray(values, dtype="datetime64[ns]")
    if kind == "f" or values.isna().any():
        return values.to_numpy(np.float64, na_value=np.nan)
    return values.to_numpy(np.int64)


def to_readings(name, values, shape=None):
    """An array of doubles; shape: that it must have, None: any length of one dimension."""
    array = as_array(values)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name} is of type {array.dtype}, must be real numbers")
    wanted = shape or ("n",)
    fits = array.ndim == len(wanted) and all(w == "n" or w == size for w, size in zip(wanted, array.shape))
    if not fits:
        words = ", ".join(map(str, wanted)) + ("," if len(wanted) == 1 else "")
        raise ValueError(f"{name} has the shape {array.shape}, must be ({words})")
    if array.shape[0] == 0:
        raise ValueError(f"{name} is empty, must hold readings")
    return np.array(array, dtype=np.float64, order="C")


def to_stamps_of(name, stamps, of, values):
    """The stamps of values; of a number, which is a period, they come evenly."""
    array = as_array(stamps)
    if array.ndim == 0 and array.dtype.kind in "fiu":
        return _evenly(name, float(array), len(values))
    return check_lengths(name, to_stamps(name, array), of, values)


def check_lengths(name, stamps, of, values):
    if len(stamps) != len(values):
        raise ValueError(f"{name} has {len(stamps)} and {of} {len(values)} entries, must be as many")
    return stamps


def _evenly(name, period, count):
    if not _SHORTEST <= period <= _LONGEST:
        raise ValueError(f"{name} = {period:.9g} [s], must be a period in [{_SHORTEST:g}, {_LONGEST:g}] or an array")
    return np.round(np.arange(count) * (1e9 * period)).astype(np.int64)


def to_stamps(name, stamps):
    """Whole nanoseconds, rising."""
    given = as_array(stamps)
    array = _as_numbers(name, given)
    whole = array.dtype.kind in "iu"
    seconds = to_readings(name, array)
    bad = ~np.isfinite(seconds) | (np.abs(seconds) > (1e9 if whole else 1.0) * _FARTHEST)
    if bad.any():
        raise ValueError(f"{name}[{bad.argmax()}] = {seconds[bad.argmax()]:.9g}, must be finite seconds below "
                         f"{_FARTHEST:g}; whole numbers are nanoseconds")
    nanoseconds = array.astype(np.int64) if whole else np.round(seconds * 1e9).astype(np.int64)
    back = np.diff(nanoseconds) < 0
    if back.any():
        k = int(back.argmax()) + 1
        raise ValueError(f"{name} go back at {k}: {1e-9 * nanoseconds[k]:.9f} after {1e-9 * nanoseconds[k - 1]:.9f} "
                         "[s], must rise; give what is before and after as two recordings")
    if given.dtype.kind in "iu":
        _require_nanoseconds(name, nanoseconds)
    return np.ascontiguousarray(nanoseconds)


def _as_numbers(name, array):
    """Of dates and spans of time the whole nanoseconds; numbers as they are."""
    if array.dtype.kind in "OU":
        array = to_utc(name, array)
    if array.dtype.kind not in "mM":
        return array
    if np.isnat(array).any():
        raise ValueError(f"{name}[{np.isnat(array).argmax()}] = NaT, must be a time")
    return array.astype(array.dtype.kind + "8[ns]").astype(np.int64)


def _require_nanoseconds(name, nanoseconds):
    """Whole numbers of another unit come faster than any sensor."""
    spacing = 1e-9 * np.median(np.diff(nanoseconds)) if len(nanoseconds) >= _FEWEST else 0.0
    if 0.0 < spacing < _FASTEST:
        raise ValueError(f"{name} are whole numbers, which are nanoseconds: one every {spacing:.3g} s, must be "
                         f"{_FASTEST:g} s or more apart; other units are to be given in seconds, as floats")
