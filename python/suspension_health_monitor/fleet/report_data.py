"""What the report's page is made of, small enough for a fleet: some 8 bytes for each drive of a strut."""
import base64
import os
import urllib.parse

import numpy as np

from . import wording
from .history import series
from .wording import plain

LOGARITHM_STEP = 1e-4  # of log b1 and log b0
STDDEV_LEAST, STDDEV_STEP = 1e-3, 1 / 32  # stddev = LEAST exp(STEP code), code a byte: 0.1 % to 290 %, to 3 %
_NEWEST = 20  # events and findings of a strut that the page has; the database has all


def page_data(fleet, folder):
    """Of [(StrutHistory, Prognosis or None)], in this order; folder: of the page, which links are relative to."""
    return {"logarithm_step": LOGARITHM_STEP, "stddev_least": STDDEV_LEAST, "stddev_step": STDDEV_STEP,
            "struts": [_strut(*pair, folder) for pair in fleet]}


def _strut(history, prognosis, folder):
    found = {
        "vehicle": plain(history.vehicle), "strut": plain(history.strut),
        "events": [[round(each.time), each.level, plain(each.message)] for each in history.events[-_NEWEST:]],
        "findings": [[round(each.time), each.verdict, " ".join(each.effects), _link(each.page, folder)]
                     for each in history.findings[-_NEWEST:]],
        "left_out": max(0, len(history.events) - _NEWEST) + max(0, len(history.findings) - _NEWEST),
        "outlook": wording.of_strut(history, prognosis)}
    if prognosis is None:
        return found
    trend, worn = prognosis.trend, prognosis.wear[prognosis.trend.part]
    return {**found, **_drives(history), "part": trend.part, "due": bool(prognosis.dated or prognosis.reached),
            "change": round(-100 * worn.loss[1], 1), "worn": wording.span(worn),
            "threshold": prognosis.options.threshold, "new": round(trend.new, 5),
            "remarks": [wording.change(each) for each in prognosis.changes],
            "effects": [wording.effect(each) for each in prognosis.effects],
            "changes": [[round(each.before), round(each.time)] for each in prognosis.changes],
            "fan": {"from": round(trend.times[0]), "to": round(trend.times[-1]),
                    "shares": [[round(1000 * float(share)) for share in row] for row in trend.shares]},
            "earlier": [[round(begin), round(end), round(first, 3), round(last, 3)]
                        for begin, end, first, last in trend.earlier]}


def _link(page, folder):
    """Quoted, so that no path can be anything but one."""
    return page and urllib.parse.quote(os.path.relpath(page, folder))


def _drives(history):
    """Times in 65535ths of their span, logarithms about the first one, standard deviations by their logarithm."""
    _, damping, stiffness = series(history)
    first, span = damping.time[0], max(damping.time[-1] - damping.time[0], 1.0)
    codes = [np.rint((damping.time - first) / span * 65535).astype("<u2")]
    for each in (damping, stiffness):
        codes.append(np.clip(np.rint((each.value - each.value[0]) / LOGARITHM_STEP), -32767, 32767).astype("<i2"))
    for each in (damping, stiffness):
        codes.append(np.clip(np.rint(np.log(each.stddev / STDDEV_LEAST) / STDDEV_STEP), 0, 255).astype("u1"))
    return {"from": round(float(first)), "span": round(float(span)), "count": len(damping.time),
            "first": [round(float(each.value[0]), 5) for each in (damping, stiffness)],
            "drives": base64.b64encode(b"".join(each.tobytes() for each in codes)).decode()}
