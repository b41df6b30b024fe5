"""How fast a part wears, if it does: a posterior over rates, of draws."""
import dataclasses

import numpy as np

from . import student_t
from .grid import close_in
from .history import MONTH, YEAR
from .segments import LEAST_SCATTER, MOST_SCATTER, Layout, design, lay_out, precision, scales, scatter_grid, years

# A part wears so that it lasts between a month and the life of a vehicle, on no scale in between rather than on another.
SHORTEST_LIFE, LONGEST_LIFE = MONTH / YEAR, 25.0  # [years] until the threshold
_POINTS = (14, 9)  # of rate and scatter
_DRAWS = 2000  # of each kind: a quantile of 5 % is then known to 0.5 %
KINDS = ("healthy", "falls", "rises")


@dataclasses.dataclass(frozen=True)
class Posterior:
    """What the drives leave open, as draws; a rate is that since the last change, of the part's number there."""
    probability: dict  # of KINDS
    kind: np.ndarray  # (S,) index into KINDS; as many draws of each
    weight: np.ndarray  # (S,) of a draw
    rate: np.ndarray  # (S,) [1/year], positive whether it falls or rises
    coefficients: np.ndarray  # (S, p) as in `layout`, the last slope 0
    scatter: np.ndarray  # (S,) between drives
    layout: Layout
    lengths: np.ndarray  # (segments,) what a slope's coefficient is multiplied by at its segment's end


def change_of_logarithm(kind, rate, elapsed):
    """What the value has changed by since the part was new; rate times elapsed is the worn share of it.

    Wear is linear in time: the worn part's number is (1 - rate elapsed) of the new one's. It falls with the numerator's wear,
    and rises with the denominator's.
    """
    worn = np.log1p(-np.minimum(rate * elapsed, 1 - 1e-9))
    return np.where(kind == 1, worn, np.where(kind == 2, -worn, 0.0))


def posterior(series, starts, season, threshold, seed=0):
    """Healthy, falling and rising after the last change have 1/2, 1/4 and 1/4 before the drives are looked at."""
    layout, _, _ = lay_out(series, starts, season)
    matrix, prior = design(series, layout), precision(layout, season)
    lengths = matrix[-1, 1:1 + len(starts)]
    kept = np.arange(layout.size) != layout.slope(len(starts) - 1)
    matrix, prior = matrix[:, kept], prior[kept]
    elapsed = np.maximum(years(series) - years(series)[starts[-1]], 0)
    most = min(threshold / SHORTEST_LIFE, 0.999 / max(elapsed[-1], 1e-9))
    grids = {0: scatter_grid(series, matrix, prior)}
    for kind in (1, 2):
        def evaluate(centres, kind=kind):
            offsets = change_of_logarithm(kind, np.exp(centres[:, :1]), elapsed[None, :])
            fits = student_t.fit(series.value, offsets, scales(series, centres[:, 1]), matrix, prior)
            return fits.log_evidence, fits
        grids[kind] = close_in(evaluate, [np.log(threshold / LONGEST_LIFE), np.log(LEAST_SCATTER)],
                               [np.log(most), np.log(MOST_SCATTER)], _POINTS)
    prior_width = np.log(LONGEST_LIFE / SHORTEST_LIFE)
    evidence = np.array([grid.log_integral for grid, _ in grids.values()]) - [0, np.log(prior_width), np.log(prior_width)]
    weight = np.exp(evidence - evidence.max()) * [0.5, 0.25, 0.25]
    probability = weight / weight.sum()
    random = np.random.default_rng(seed)
    drawn = [_draw(grid, fits, kind > 0, random) for kind, (grid, fits) in grids.items()]
    rate, scatter, some = (np.concatenate(each) for each in zip(*drawn))
    coefficients = np.zeros((len(rate), layout.size))
    coefficients[:, kept] = some
    return Posterior(dict(zip(KINDS, probability)), np.repeat(range(len(KINDS)), _DRAWS),
                     np.repeat(probability / _DRAWS, _DRAWS), rate, coefficients, scatter, layout, lengths)


def _draw(grid, fits, wears, random):
    """Rates, scatters and coefficients."""
    share = np.exp(grid.log_density - grid.log_density.max())
    cells = random.choice(len(share), size=_DRAWS, p=share / share.sum())
    place = grid.centres[cells] + grid.widths * (random.random((_DRAWS, len(grid.widths))) - 0.5)
    normal = random.standard_normal((_DRAWS, fits.coefficients.shape[1]))
    root = np.linalg.cholesky(fits.covariance)[cells]
    return (np.exp(place[:, 0]) if wears else np.zeros(_DRAWS), np.exp(place[:, -1]),
            fits.coefficients[cells] + np.einsum("spq,sq->sp", root, normal))
