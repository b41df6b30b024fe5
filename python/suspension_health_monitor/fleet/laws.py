"""What a part may do from one change to the next: it stays, it settles, or it goes on. Which of them the drives bear out."""
import dataclasses
from typing import Callable, Optional

import numpy as np
from scipy.special import ndtr, ndtri

from .view import MODES, Regression, walk

STAYS, SETTLES, FALLS, RISES = KINDS = ("stays", "settles", "falls", "rises")
_LEAST = 1e-300  # probability: no less is a number
DRAWS = 2000  # of each set: a quantile of 5 % is then known to 0.5 %


@dataclasses.dataclass(frozen=True)
class Law:
    """value = level - amount * shape(share of the history's span)."""
    weight: float  # before the drives are looked at
    shape: Optional[Callable] = None  # 0 at 0 and 1 at 1
    power: Optional[float] = None  # of one that goes on: shape(x) = x^power


def _settles(time):
    return lambda share: np.expm1(-share / time) / np.expm1(-1 / time)


def _stops(end):
    return lambda share: np.minimum(share / end, 1.0)


def _breaks(begin):
    return lambda share: np.where(share < begin, 0.0, 1.0)


# What ends in some part of the history: it runs in or saturates, stops, or breaks at once. Early breaks are changes.
_ENDS = (*map(_settles, (0.04, 0.08, 0.15, 0.3, 0.5)), *map(_stops, (0.15, 0.3, 0.45, 0.6, 0.75)),
         *map(_breaks, (0.5, 0.65, 0.8, 0.9, 0.95)))
# Powers of time by which wear goes on: evenly in half of the cases, else faster and faster or slower and slower.
_GOES_ON = {0.75: 0.12, 1.0: 0.5, 1.5: 0.2, 2.0: 0.18}
# One strut of two stays as it is. What ends is as frequent as what goes on.
LAWS = (Law(0.5), *(Law(0.25 / len(_ENDS), shape) for shape in _ENDS),
        *(Law(0.25 * share, lambda x, power=power: x ** power, power) for power, share in _GOES_ON.items()))


@dataclasses.dataclass(frozen=True)
class Draws:
    """Ways that a part may have taken and may take, as numbers of its view."""
    law: np.ndarray  # (S,) index into LAWS
    level: np.ndarray  # (S,) at the first drive
    amount: np.ndarray  # (S,)
    modes: np.ndarray  # (S, MODES) of the walk
    size: np.ndarray  # (S,) of the walk
    ahead: np.ndarray  # (S,) standard normal: where the walk goes after the last drive

    def path(self, share):
        """(S,) at this share of the span."""
        return self.level - self.amount * self._shape(share) + self._walk(np.full(len(self.level), share))

    def without_rise(self):
        """What rises is the other part's wear, since no part gets better."""
        return dataclasses.replace(self, amount=np.maximum(self.amount, 0.0))

    def when(self, limit):
        """(S,) the share of the span at which a path that goes on comes down to a limit (S,)."""
        share = np.ones(len(limit))
        for _ in range(2):  # how far a walk gets depends on how long it takes
            left = np.maximum(self.level + self._walk(np.maximum(share, 1.0)) - limit, 0.0)
            with np.errstate(over="ignore"):  # as good as never
                share = (left / self.amount) ** (1 / _POWERS[self.law])
        return share

    def rate(self, share):
        """(S,) at which it falls there, by the span; of those that go on."""
        return self.amount * _POWERS[self.law] * share ** (_POWERS[self.law] - 1)

    def _walk(self, share):
        known = np.einsum("sm,sm->s", self.modes, walk(np.minimum(share, 1.0)))
        return known + self.size * self.ahead * np.sqrt(np.maximum(share - 1.0, 0.0))

    def _shape(self, share):
        return np.array([0.0 if each.shape is None else each.shape(share) for each in LAWS])[self.law]


_POWERS = np.array([each.power or 1.0 for each in LAWS])


@dataclasses.dataclass(frozen=True)
class Posterior:
    """What the drives leave open."""
    probability: dict  # of KINDS
    falling: Draws  # of those laws by which the part goes on to fall
    other: Draws  # of all others, as many

    @property
    def weight(self):
        """(2 S,) of the falling draws, then of the others."""
        falls = self.probability[FALLS]
        return np.repeat([falls, 1 - falls], DRAWS) / DRAWS


def posterior(view, most, seed=0):
    """Every law predicts each drive from the drives before it; the product of these densities is its evidence.

    :param most: standard deviation of what is lost within a history.
    """
    regression = Regression(view)
    grid, _ = regression.fit([view.share], [most])
    regression = regression.narrowed(grid)
    fitted = [_fit(law, view, regression, most) for law in LAWS]
    logs = np.log([law.weight for law in LAWS]) + [grid.log_integral for grid, _ in fitted]
    weight = np.exp(logs - np.logaddexp.reduce(logs))
    falls = np.array([0.0 if law.power is None else _share_that_falls(*each) for law, each in zip(LAWS, fitted)])
    probability = {
        STAYS: weight[0], SETTLES: sum(each for each, law in zip(weight, LAWS) if law.shape and not law.power),
        FALLS: weight @ falls, RISES: sum((1 - down) * each for down, each, law in zip(falls, weight, LAWS) if law.power)}
    random = np.random.default_rng(seed)
    return Posterior({kind: float(each) for kind, each in probability.items()},
                     _draw(weight * falls, fitted, 1, random), _draw(weight * (1 - falls), fitted, -1, random))


def _fit(law, view, regression, most):
    return regression.fit(*(([-law.shape(view.share)], [most]) if law.shape else ()))


def _cells(grid):
    density = np.exp(grid.log_density - grid.log_density.max())
    return density / density.sum()


def _share_that_falls(grid, fits):
    spread = np.sqrt(fits.covariance[:, 1, 1])
    return min(float(_cells(grid) @ ndtr(fits.coefficients[:, 1] / spread)), 1.0)


def _draw(weight, fitted, sign, random):
    """:param sign: of the amounts of laws that go on."""
    weight = weight + _LEAST  # what the drives rule out is drawn, too, and weighs nothing
    laws = np.sort(random.choice(len(LAWS), size=DRAWS, p=weight / weight.sum()))
    parts = [_draw_of(LAWS[law], *fitted[law], sign, np.count_nonzero(laws == law), random) for law in np.unique(laws)]
    return Draws(laws, *(np.concatenate(each) for each in zip(*parts)))


def _draw_of(law, grid, fits, sign, count, random):
    density = _cells(grid)
    if law.power:
        density = density * ndtr(sign * fits.coefficients[:, 1] / np.sqrt(fits.covariance[:, 1, 1])) + _LEAST
    cells = random.choice(len(density), size=count, p=density / density.sum())
    covariance, mean = fits.covariance[cells], fits.coefficients[cells]
    drawn = mean + np.einsum("spq,sq->sp", np.linalg.cholesky(fits.covariance)[cells],
                             random.standard_normal(mean.shape))
    if law.power:  # as if only what has the sign had been drawn
        spread = np.sqrt(covariance[:, 1, 1])
        low = sign * mean[:, 1] / spread  # of so many standard deviations 0 lies below the mean
        amount = mean[:, 1] - sign * spread * ndtri(np.maximum(ndtr(low) * (1 - random.random(count)), _LEAST))
        amount = sign * np.maximum(sign * amount, _LEAST)
        drawn += covariance[:, :, 1] * ((amount - drawn[:, 1]) / covariance[:, 1, 1])[:, None]
    amount = drawn[:, 1] if law.shape else np.zeros(count)
    return drawn[:, 0], amount, drawn[:, -MODES:], np.exp(grid.centres[cells, 1]), random.standard_normal(count)
