"""How long a part lasts, if it wears: a posterior, as draws."""
import dataclasses

import numpy as np

from . import student_t
from .grid import LEFT_OUT, close_in
from .history import MONTH, YEAR
from .segments import LEAST_SCATTER, MOST_SCATTER, Layout, design, lay_out, precision, scales, scatter_grid, years

# A part that wears lasts between a month and the life of a vehicle, on no scale in between rather than on another.
SHORTEST_LIFE, LONGEST_LIFE = MONTH / YEAR, 25.0  # [years] until the threshold
BENT = 0.1  # share of wear that is not linear; with more of it the intervals of linear wear hold more than they say
POWER_STDDEV = 0.35  # of its logarithm: wear that goes with time to the power of 0.5 to 2, where it is not linear
_POINTS = (14, 9)  # of life and scatter
_POINTS_BENT = (12, 7, 7)  # of life, scatter and power
_DRAWS = 2000  # of each kind: a quantile of 5 % is then known to 0.5 %
KINDS = ("healthy", "falls", "rises")


@dataclasses.dataclass(frozen=True)
class Posterior:
    """What the drives leave open, as draws; of the time since the last change."""
    probability: dict  # of KINDS
    kind: np.ndarray  # (S,) index into KINDS; as many draws of each
    weight: np.ndarray  # (S,) of a draw
    life: np.ndarray  # (S,) [years] until the threshold is worn; infinite for the healthy
    power: np.ndarray  # (S,) of time with which wear goes
    coefficients: np.ndarray  # (S, p) as in `layout`, the last slope 0
    layout: Layout
    lengths: np.ndarray  # (segments,) what a slope's coefficient is multiplied by at its segment's end
    threshold: float

    def change(self, elapsed):
        """(S,) what the value has changed by after so many years."""
        return change_of_logarithm(self.kind, self.worn(elapsed))

    def worn(self, elapsed):
        """(S,) what is lost of the part that wears."""
        return worn(self.threshold, self.life, self.power, elapsed)


def worn(threshold, life, power, elapsed):
    """Share of the new part's number that is lost."""
    return threshold * (elapsed / life) ** power


def change_of_logarithm(kind, share):
    """It falls with the wear of the ratio's numerator, and rises with that of its denominator."""
    change = np.log1p(-np.minimum(share, 1 - 1e-9))
    return np.where(kind == 1, change, np.where(kind == 2, -change, 0.0))


def posterior(series, starts, season, threshold, bent=False, seed=0):
    """Healthy, falling and rising after the last change have 1/2, 1/4 and 1/4 before the drives are looked at.

    :param bent: look at wear that is not linear, too.
    """
    layout, _, _ = lay_out(series, starts, season)
    matrix, prior = design(series, layout), precision(series, layout, season)
    lengths = matrix[-1, 1:1 + len(starts)]
    kept = np.arange(len(prior)) != layout.slope(len(starts) - 1)
    matrix, prior = matrix[:, kept], prior[kept]
    found = [[(0.0, scatter_grid(series, matrix, prior))],
             *([_of_wear(kind, False, series, starts, matrix, prior, threshold)] for kind in (1, 2))]
    if bent:
        likely = _evidence(found)
        for kind in (1, 2):
            if likely[kind] > likely.max() - LEFT_OUT:
                found[kind].append(_of_wear(kind, True, series, starts, matrix, prior, threshold))
    evidence = _evidence(found)
    weight = np.exp(evidence - evidence.max()) * [0.5, 0.25, 0.25]
    probability = weight / weight.sum()
    random = np.random.default_rng(seed)
    life, power, some = (np.concatenate(each) for each in zip(*(_draw(each, random) for each in found)))
    coefficients = np.zeros((len(life), len(kept)))
    coefficients[:, kept] = some
    return Posterior(dict(zip(KINDS, probability)), np.repeat(range(len(KINDS)), _DRAWS),
                     np.repeat(probability / _DRAWS, _DRAWS), life, power, coefficients, layout, lengths, threshold)


def _evidence(found):
    """Of every kind."""
    return np.array([np.logaddexp.reduce([share + grid.log_integral for share, (grid, _) in models])
                     for models in found])


def _of_wear(kind, bent, series, starts, matrix, prior, threshold):
    """(logarithm of the prior's constant factor, (grid, fits)) of linear or bent wear."""
    elapsed = np.maximum(years(series) - years(series)[starts[-1]], 0)

    def evaluate(centres):
        powers = np.exp(centres[:, 2:]) if bent else 1.0
        offsets = change_of_logarithm(kind, worn(threshold, np.exp(centres[:, :1]), powers, elapsed[None, :]))
        fits = student_t.fit(series.value, offsets, scales(series, centres[:, 1]), matrix, prior)
        return fits.log_evidence - 0.5 * (centres[:, 2:] ** 2).sum(axis=1) / POWER_STDDEV ** 2, fits
    lower, upper = [[np.log(each) for each in limits] for limits in (
        (SHORTEST_LIFE, LEAST_SCATTER), (LONGEST_LIFE, MOST_SCATTER))]
    constant = -np.log(upper[0] - lower[0])
    if not bent:
        return constant + np.log1p(-BENT), close_in(evaluate, lower, upper, _POINTS)
    return constant + np.log(BENT) - 0.5 * np.log(2 * np.pi * POWER_STDDEV ** 2), close_in(
        evaluate, [*lower, -3 * POWER_STDDEV], [*upper, 3 * POWER_STDDEV], _POINTS_BENT)


def _draw(found, random):
    """Lives, powers and coefficients, of models with their evidence."""
    evidence = np.array([share + grid.log_integral for share, (grid, _) in found])
    share = np.exp(evidence - np.logaddexp.reduce(evidence))
    counts = random.multinomial(_DRAWS, share / share.sum())
    parts = []
    for count, (_, (grid, fits)) in zip(counts, found):
        density = np.exp(grid.log_density - grid.log_density.max())
        cells = random.choice(len(density), size=count, p=density / density.sum())
        place = grid.centres[cells] + grid.widths * (random.random((count, len(grid.widths))) - 0.5)
        normal = random.standard_normal((count, fits.coefficients.shape[1]))
        root = np.linalg.cholesky(fits.covariance)[cells]
        parts.append((np.exp(place[:, 0]) if len(grid.widths) > 1 else np.full(count, np.inf),
                      np.exp(place[:, 2]) if len(grid.widths) > 2 else np.ones(count),
                      fits.coefficients[cells] + np.einsum("spq,sq->sp", root, normal)))
    return [np.concatenate(each) for each in zip(*parts)]
