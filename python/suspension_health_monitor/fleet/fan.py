"""The trend of a strut as a band over time, past and to come."""
import numpy as np

from .history import YEAR
from .prognosis import PARTS, SIGN, quantiles

_POINTS = 25
_MOST_AHEAD = 5.0  # [years] of a picture


def shown_part(prognosis):
    return prognosis.dated or PARTS[0]


def levels(prognosis):
    """log(b1/b0) at the begin of every segment, a row of draws each, without the season."""
    draws, layout = prognosis.draws, prognosis.draws.layout
    level, found = draws.coefficients[:, 0], []
    for segment, length in enumerate(draws.lengths):
        if segment:
            level = level + draws.coefficients[:, layout.step(segment)]
        found.append(level)
        level = level + draws.coefficients[:, layout.slope(segment)] * length
    return np.array(found)


def new_level(prognosis):
    """log(b1/b0) of the part when it was new: what the picture counts from."""
    begins = [prognosis.first, *(change.time for change in prognosis.changes)]
    segment = begins.index(prognosis.wear[shown_part(prognosis)].since)
    return float(np.average(levels(prognosis)[segment], weights=prognosis.draws.weight))


def fan(prognosis):
    """(times [s since 1970], quantiles (3, T) of the part over the new one, trend alone) since the last change."""
    draws, sign = prognosis.draws, SIGN[shown_part(prognosis)]
    begin = prognosis.changes[-1].time if prognosis.changes else prognosis.first
    times = np.linspace(begin, _end(prognosis, begin), _POINTS)
    start = levels(prognosis)[-1] - new_level(prognosis)
    found = [quantiles(np.exp(sign * (start + draws.change((time - begin) / YEAR))),
                       draws.weight, prognosis.options) for time in times]
    return times, np.array(found).T


def _end(prognosis, begin):
    """Where the date is past, half as far ahead as the drives reach back otherwise."""
    ahead = 0.5 * (prognosis.last - begin)
    if prognosis.dated:
        ahead = max(ahead, 1.1 * (prognosis.wear[prognosis.dated].date[2] - prognosis.last))
    return prognosis.last + min(max(ahead, YEAR / 12), _MOST_AHEAD * YEAR)


def earlier(prognosis):
    """[(begin, end, share at begin, share at end)] of the trends before the last change, in the mean."""
    sign, new, draws = SIGN[shown_part(prognosis)], new_level(prognosis), prognosis.draws
    begins = [prognosis.first, *(change.time for change in prognosis.changes)]
    found = []
    for segment, change in enumerate(prognosis.changes):
        first = levels(prognosis)[segment]
        last = first + draws.coefficients[:, draws.layout.slope(segment)] * draws.lengths[segment]
        shares = [float(np.exp(sign * (np.average(each, weights=draws.weight) - new))) for each in (first, last)]
        found.append((begins[segment], change.before, *shares))
    return found
