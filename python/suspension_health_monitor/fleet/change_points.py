"""Drives at which a part became another one: a repair, a swap, a fault, or wear that begins."""
import numpy as np
from scipy.special import ndtri, stdtr

from . import student_t
from .history import MONTH, YEAR
from .view import MODES, Regression

LEAST_DRIVES = 3  # of a segment: fewer may be single wrong drives
YEARS_OF_A_PART = 5.0
# Standard deviations: a new damper in place of one 30 % down is a step of 0.3; 5 % a month is fast wear. They say only
# how large a change is worth looking for.
STEP_STDDEV = 0.3
SLOPE_STDDEV = 0.05 * YEAR / MONTH  # [1/year]
# The bound below over what is measured (benchmark/fleet_prognosis.py). By a change of measure false changes are A / R times
# as many as it allows, in the mean over struts that do change; and their R, the sum, is mostly far beyond A.
BOUND_OVER_MEASURED = 10.0
_CANDIDATES = 6  # that are looked at closely; the others count as nothing, which only makes a change harder to prove


def find(view, false_rate):
    """(first drives of all segments, [0, ...]; the drive of a change that is likely, but not proven, or None).

    A change at drive k is judged by its Bayes factor L_k, the evidence of a model with a step and another slope there
    over that of one without. Without a change the sum of L_k over all k has the expectation of their number, and first
    exceeds A after A drives in the mean at least (Shiryaev-Roberts; Pollak 1985), and after BOUND_OVER_MEASURED A as it
    turns out. So a false change in 1 / false_rate strut-years needs A = drives a year / false_rate over that. It is
    likely once it is more probable than none, if parts are renewed every YEARS_OF_A_PART. Where there is one, the drives
    before and after it are looked at again, by themselves.

    :param false_rate: [1/year]
    """
    years = (view.time[-1] - view.time[0]) / YEAR
    if not years:
        return [0], None
    return _within(view, 0, len(view.time), np.log(len(view.time) / years / false_rate / BOUND_OVER_MEASURED))


def _within(view, begin, end, bound):
    """As find, of the drives from begin to end."""
    drives, logarithms = _bayes_factors(view.between(begin, end))
    if not len(drives):
        return [begin], None
    if np.logaddexp.reduce(logarithms) < bound:
        time = view.time[begin:end] / YEAR
        expected = (time[drives] - time[drives - 1]) / YEARS_OF_A_PART
        likely = np.sum(expected * np.exp(logarithms)) > 1
        return [begin], begin + int(drives[logarithms.argmax()]) if likely else None
    best = begin + int(drives[logarithms.argmax()])
    before, _ = _within(view, begin, best, bound)
    after, likely = _within(view, best, end, bound)
    return before + after, likely


def _bayes_factors(view):
    """(the drives that look most like a change, logarithms of their factors)."""
    if len(view.time) < 2 * LEAST_DRIVES:
        return np.zeros(0, dtype=int), np.zeros(0)
    regression, slope = Regression(view), SLOPE_STDDEV * view.span / YEAR
    grid, fits = regression.fit(_trend(view), [slope, slope])
    drives = _likely(view, grid, fits, slope)
    regression = regression.narrowed(grid)
    without, _ = regression.fit(_trend(view), [slope, slope])
    return drives, np.array([with_change(view, regression, drive)[0].log_integral - without.log_integral
                             for drive in drives])


def _trend(view):
    """Columns of a trend that may bend, as that of wear which goes faster and faster: that is no change."""
    return [view.share, view.share ** 2]


def with_change(view, regression, drive):
    """(Grid, Fits) with a step and another slope from a drive on; the coefficients begin with level, trend, bend, step."""
    slope = SLOPE_STDDEV * view.span / YEAR
    return regression.fit([*_trend(view), *_columns(view, np.array([drive]))[0].T], [slope, slope, STEP_STDDEV, slope])


def _columns(view, drives):
    """(K, N, 2) step and further slope from each of the drives on."""
    after = np.arange(len(view.time)) >= drives[:, None]
    return np.stack([after.astype(float), after * (view.share - view.share[drives][:, None])], axis=-1)


def _likely(view, grid, fits, slope):
    """Drives by the score test of a step and a slope from there on, the best first.

    The residuals count by their normal scores: those of Student's t would fall again where three drives are far off.
    """
    best = grid.log_density.argmax()
    scatter, size = np.exp(grid.centres[best])
    scale = np.hypot(view.stddev, scatter)
    matrix = Regression(view).columns(_trend(view))
    residual = view.value - matrix @ fits.coefficients[best]
    tail = stdtr(student_t.DEGREES_OF_FREEDOM, -np.abs(residual) / scale)
    score, weight = -np.sign(residual) * ndtri(tail) / scale, scale ** -2
    candidates = np.arange(LEAST_DRIVES, len(scale) - LEAST_DRIVES + 1)
    added = _columns(view, candidates)
    crossed = np.einsum("np,n,knj->kpj", matrix, weight, added)
    own = np.einsum("kni,n,knj->kij", added, weight, added)
    prior = np.concatenate([[0.0, slope ** -2, slope ** -2], view.hidden_stddev ** -2, MODES * [size ** -2]])
    known = np.linalg.inv((matrix.T * weight) @ matrix + np.diag(prior))
    scores = np.einsum("n,knj->kj", score, added) - np.einsum("kpj,pq,q->kj", crossed, known, matrix.T @ score)
    information = own - np.einsum("kpi,pq,kqj->kij", crossed, known, crossed)
    information += np.diag([STEP_STDDEV ** -2, slope ** -2])
    statistic = np.einsum("ki,kij,kj->k", scores, np.linalg.inv(information), scores)
    return candidates[np.argsort(-statistic)[:_CANDIDATES]]
