"""Vehicles whose folder has got another name: the struts of the new one go on where those of a vanished one ended."""
import collections
import dataclasses
import functools

import numpy as np
from scipy.linalg import helmert
from scipy.stats import chi2

from .errors import UsageError
from .history import series

_DRIVES = 10  # the last ones of the old name, the first ones of the new
# What the same vehicle's numbers may drift by meanwhile (weather, wear), of a logarithm; new parts differ by some 0.05.
_DRIFT = 0.02
# A vehicle is the same if its struts differ no more than those of one vehicle in 100 would, and another one if they differ
# more than those of one in 1000. In between, nobody knows.
_SAME, _OTHER = 0.01, 0.001


def joined(histories, told=()):
    """Histories of vehicles under their newest names.

    :param told: "NEW=OLD" of what the user knows; "NEW=": it is none of the others.
    :raises UsageError: names that are not there, or drive at the same time.
    """
    vehicles = collections.defaultdict(dict)
    for history in histories:
        vehicles[history.vehicle][history.strut] = history
    known = dict(_pair(each, vehicles) for each in told)
    timed = [name for name, struts in vehicles.items() if any(len(each.time) for each in struts.values())]
    for new in sorted(timed, key=lambda name: _span(vehicles[name])[0]):
        old, doubt = (known[new], ()) if new in known else _found(new, vehicles, known)
        if old:
            vehicles[new] = _one(vehicles[old], vehicles[new], old)
            del vehicles[old]
        elif doubt:
            vehicles[new] = {name: dataclasses.replace(each, perhaps=doubt) for name, each in vehicles[new].items()}
    return [vehicles[name][strut] for name in sorted(vehicles) for strut in sorted(vehicles[name])]


def _pair(text, vehicles):
    new, equals, old = text.partition("=")
    for name in (new, old):
        if not equals or name not in (*vehicles, *([""] if name is old else [])):
            raise UsageError(f"--renamed {text}, must be NEW=OLD, two vehicles of the database, or NEW= for one of its own")
    if old and not _follows(vehicles[new], vehicles[old]):
        raise UsageError(f"--renamed {text}: {new} has driven before the last drive of {old}, or has other struts")
    return new, old


def _span(struts):
    times = np.concatenate([each.time for each in struts.values()])
    return (times.min(), times.max()) if len(times) else (np.inf, -np.inf)


def _follows(new, old):
    return set(new) == set(old) and _span(old)[1] < _span(new)[0]


def _found(new, vehicles, known):
    """(the former name, or None; names between which the struts cannot tell)."""
    its = vehicles[new]
    others = {name: struts for name, struts in vehicles.items() if name != new and not _follows(struts, its)}
    alike = {name: _agreement(struts, its) for name, struts in others.items() if name not in known.values()}
    same = tuple(name for name, found in alike.items() if found >= _SAME and _follows(its, others[name]))
    if not same:
        return None, ()
    old = others[same[0]]
    rivals = [name for name, struts in others.items() if _follows(struts, old) and _agreement(old, struts) >= _OTHER]
    alone = [name for name, found in alike.items() if found >= _OTHER] == [*same] and len(same) == 1 and not rivals
    return (same[0], ()) if alone else (None, same)


def _agreement(old, new):
    """Probability that one vehicle's struts differ as much, 0 for one with other struts."""
    if set(old) != set(new):
        return 0.0
    (ending, its_stddev), (beginning, stddev) = _numbers(old), _numbers(new)
    if not len(ending) or not len(beginning):
        return 0.0
    parts = [(ending[-_DRIVES:], its_stddev), (beginning[:_DRIVES], stddev)]
    apart = np.concatenate([each - each.mean(axis=0) for each, _ in parts])
    scatter = (apart ** 2).sum(axis=0) / max(len(apart) - 2, 1)
    variance = sum(np.maximum(scatter, stated ** 2) / len(each) for each, stated in parts) + _DRIFT ** 2
    difference = parts[0][0].mean(axis=0) - parts[1][0].mean(axis=0)
    return float(chi2.sf((difference ** 2 / variance).sum(), len(difference)))


def _numbers(struts):
    """((N, 2 S) numbers of every drive that has all struts, their stated standard deviation).

    The logarithms of b1/b0 and b0 as mean over the struts and what tells these apart, so that the payload is in one only.
    """
    found = [series(struts[name])[::2] for name in sorted(struts)]
    shared = functools.reduce(np.intersect1d, [ratio.time for ratio, _ in found])
    at = [np.searchsorted(ratio.time, shared) for ratio, _ in found]
    rows = [np.array([each[kind].value[place] for each, place in zip(found, at)]) for kind in (0, 1)]
    stated = [np.array([each[kind].stddev[place] for each, place in zip(found, at)]) for kind in (0, 1)]
    turned = helmert(len(found), full=True)
    return (np.concatenate([turned @ each for each in rows]).T,
            np.repeat([np.sqrt((each ** 2).mean()) for each in stated] if len(shared) else [0.0, 0.0], len(found)))


def _one(old, new, name):
    """The struts of both, drive by drive. name: the old one's."""
    result = {}
    for strut, after in new.items():
        before = old[strut]
        counts = len(before.time), len(after.time)
        arrays = {field: np.concatenate([getattr(each, field) for each in (before, after)]) for field in (
            "time", "damping_to_mass", "damping_to_mass_stddev", "stiffness_to_mass", "stiffness_to_mass_stddev")}
        for field, missing in (("former", False), ("temperature", np.nan)):
            both = [getattr(each, field) for each in (before, after)]
            if any(each is not None for each in both):
                arrays[field] = np.concatenate([np.full(count, missing) if each is None else each
                                                for each, count in zip(both, counts)])
        lists = {field: [*getattr(before, field), *getattr(after, field)] for field in ("path", "events", "findings")}
        result[strut] = dataclasses.replace(
            after, **arrays, **lists, wrong_clocks=before.wrong_clocks + after.wrong_clocks,
            formerly=(*before.formerly, (name, _span(old)[1])))
    return result
