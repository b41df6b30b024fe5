"""Integrals of peaked densities over a box, by a grid that closes in on the peak."""
import numpy as np

LEFT_OUT = 12.0  # what is that many nats below the peak is not looked at: exp(-12) of it
_MOST_ROUNDS = 8


class Grid:
    """Equal cells of a box, with the logarithm of the density at their centres."""

    def __init__(self, centres, widths, log_density):
        self.centres = centres  # (C, d)
        self.widths = widths  # (d,)
        self.log_density = log_density  # (C,)

    @property
    def log_integral(self):
        return np.logaddexp.reduce(self.log_density) + np.log(self.widths).sum()


def close_in(evaluate, lower, upper, points, rounds=_MOST_ROUNDS):
    """:param evaluate: log density (C,), and whatever else it finds, at the centres (C, d).
    :returns: the grid, and what else was found there.
    """
    lower, upper = np.array(lower, dtype=float), np.array(upper, dtype=float)
    least, most = lower.copy(), upper.copy()
    for _ in range(rounds):
        widths = (upper - lower) / points
        axes = [low + width * (0.5 + np.arange(count)) for low, width, count in zip(lower, widths, points)]
        centres = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(points))
        log_density, found = evaluate(centres)
        inside = centres[log_density > log_density.max() - LEFT_OUT]
        before = upper - lower
        lower = np.maximum(least, inside.min(axis=0) - 1.5 * widths)
        upper = np.minimum(most, inside.max(axis=0) + 1.5 * widths)
        if np.all(upper - lower > 0.7 * before):
            break
    return Grid(centres, widths, log_density), found
