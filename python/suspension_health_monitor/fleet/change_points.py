"""Drives at which a strut became another one: a repair, a swap, a fault, or wear that begins."""
import bisect

import numpy as np
from scipy.special import ndtri, stdtr

from . import student_t
from .segments import SLOPE_STDDEV, STEP_STDDEV, Layout, design, lay_out, precision, scales, scatter_grid, years

LEAST_DRIVES = 3  # of a segment: fewer may be single wrong drives
YEARS_OF_A_PART = 5.0
# The bound below over what is measured (benchmark/fleet_prognosis.py). By a change of measure false changes are A / R times
# as many as it allows, in the mean over struts that do change; and their R, the sum, is mostly far beyond A.
BOUND_OVER_MEASURED = 10.0
_CANDIDATES = 6  # that are looked at closely; the others count as nothing, which only makes a change harder to prove


def find(series, season, false_rate):
    """(first drives of all segments, [0, ...]; the drive of a change that is likely, but not proven, or None).

    A change at drive k is judged by its Bayes factor L_k, the evidence of a model with a step and another slope there
    over that of one without. Without a change the sum of L_k over all k has the expectation of their number, and first
    exceeds A after A drives in the mean at least (Shiryaev-Roberts; Pollak 1985), and after BOUND_OVER_MEASURED A as it
    turns out. So a false change in 1 / false_rate strut-years needs A = drives a year / false_rate over that. It is
    likely once it is more probable than none, if parts are renewed every YEARS_OF_A_PART.

    :param false_rate: [1/year]
    """
    starts = [0]
    time = years(series)
    while time[-1] > 0:
        factors = _bayes_factors(series, starts, season)
        if not factors:
            break
        drives, logarithms = np.array([*factors]), np.array([*factors.values()])
        best = int(drives[logarithms.argmax()])
        drives_a_year = len(time) / time[-1]
        if np.logaddexp.reduce(logarithms) < np.log(drives_a_year / false_rate / BOUND_OVER_MEASURED):
            expected = (time[drives] - time[drives - 1]) / YEARS_OF_A_PART
            return starts, best if np.sum(expected * np.exp(logarithms)) > 1 else None
        starts = sorted([*starts, best])
    return starts, None


def _bayes_factors(series, starts, season):
    """Logarithms, of the drives that look most like a change."""
    layout, grid, fits = lay_out(series, starts, season)
    without = grid.log_integral
    factors = {}
    for start in _likely(series, layout, season, grid, fits):
        place = bisect.bisect(starts, start)
        rates = [*layout.rates[:place], layout.rates[place - 1], *layout.rates[place:]]
        more = Layout([*starts[:place], start, *starts[place:]], rates)
        grid_with, _ = scatter_grid(series, design(series, more), precision(series, more, season))
        factors[start] = grid_with.log_integral - without
    return factors


def _likely(series, layout, season, grid, fits):
    """Drives by the score test of a step and a slope from there on, the best first.

    The residuals count by their normal scores: those of Student's t would fall again where three drives are far off.
    """
    best = grid.log_density.argmax()
    scale = scales(series, grid.centres[best])[0]
    matrix = design(series, layout)
    residual = series.value - matrix @ fits.coefficients[best]
    tail = stdtr(student_t.DEGREES_OF_FREEDOM, -np.abs(residual) / scale)
    score, weight = -np.sign(residual) * ndtri(tail) / scale, scale ** -2
    candidates = _allowed(len(scale), layout.starts)
    if not len(candidates):
        return []
    time = years(series)
    ends = np.array([*layout.starts[1:], len(scale)])[np.searchsorted(layout.starts, candidates, side="right") - 1]
    drives = np.arange(len(scale))
    step = (drives >= candidates[:, None]).astype(float)
    last = time[ends - 1][:, None]
    slope = np.clip(time, time[candidates][:, None], last) - time[candidates][:, None]
    added = np.stack([step, slope], axis=-1)  # (K, N, 2)
    crossed = np.einsum("np,n,knj->kpj", matrix, weight, added)
    own = np.einsum("kni,n,knj->kij", added, weight, added)
    prior = np.diag(precision(series, layout, season))
    known = np.linalg.inv((matrix.T * weight) @ matrix + prior)
    scores = np.einsum("n,knj->kj", score, added) - np.einsum("kpj,pq,q->kj", crossed, known, matrix.T @ score)
    information = own - np.einsum("kpi,pq,kqj->kij", crossed, known, crossed)
    information += np.diag([STEP_STDDEV ** -2, SLOPE_STDDEV ** -2])
    statistic = np.einsum("ki,kij,kj->k", scores, np.linalg.inv(information), scores)
    return candidates[np.argsort(-statistic)[:_CANDIDATES]]


def _allowed(count, starts):
    """Drives that leave LEAST_DRIVES to both sides within their segment."""
    ends = [*starts[1:], count]
    return np.concatenate([np.arange(begin + LEAST_DRIVES, end - LEAST_DRIVES + 1) for begin, end in zip(starts, ends)])
