#!/usr/bin/python3
"""How far rounding alone moves the paper's LS and LA estimates; doc/equations.md quotes what this prints.

The recursions (15)-(17) and (24)-(26) run in NumPy as in test/core/data/make_reference.py. First on the input stored
beside it, against the stored estimates; then on its drive of 120 s, against a run whose input differs by one unit in
the last place.
"""
import pathlib
import sys
from fractions import Fraction

import numpy as np

TEST_DATA = pathlib.Path(__file__).resolve().parents[1] / "test" / "core" / "data"
sys.path.insert(0, str(TEST_DATA))
sys.dont_write_bytecode = True
from make_reference import EPS, K0, L, LAMBDA, P0, T, drive, lif  # noqa: E402

FIRST_SENSITIVE_ROW = 1300  # at 27.2 s, as in test/core/paper_reference_test.cpp
NUM_SEEDS = 20
NOISE = 0.024  # standard deviation [m/s^2]
RELATIVE_DIVISORS = (0.05, 0.2)  # of the running mean |epsilon|
SPAN = 20.0  # [s] per column of the growth


def rounded_convolution(signal, taps):
    return np.convolve(signal, taps)


def exact_convolution(signal, taps):
    """Sums of products without error, each rounded once, at its end."""
    fractions = [np.array([Fraction(x) for x in values]) for values in (signal, taps)]
    return np.convolve(*fractions).astype(float)


def make_rows(y, w, convolve=rounded_convolution):
    """Columns psi, phi_1, phi_0 of equations (28) and (29), from sample 2 L on."""
    return np.column_stack([convolve(x, lif(2, r))[2 * L:len(x)] for x, r in ((y, 2), (w - y, 1), (w - y, 0))])


def update(theta, covariance, error, phi, divisor):
    """Equations (16)-(17) for divisor 1, (25)-(26) for divisor |epsilon|."""
    p_phi = covariance @ phi
    covariance = (covariance - np.outer(p_phi, p_phi) / (LAMBDA * divisor + phi @ p_phi)) / LAMBDA
    return theta + covariance @ phi * (error / divisor), covariance


def estimate(rows, relative_divisor=None):
    """Columns b1, b0 of LS, b1, b0 of LA. The paper's small divisor, or one relative to the mean |epsilon| of LA."""
    ls = la = (np.zeros(2), np.eye(2) * P0)
    weight = mean = 0.0
    result = []
    for k, (psi, *phi) in enumerate(rows):
        phi = np.array(phi)
        error = psi - phi @ la[0]
        weight = LAMBDA * weight + 1.0
        mean += (abs(error) - mean) / weight
        ls = update(*ls, psi - phi @ ls[0], phi, 1.0)
        if k < K0:
            la = ls if relative_divisor is None or k < K0 - 1 else (ls[0], ls[1] * mean)
        else:
            smallest = EPS if relative_divisor is None else relative_divisor * mean
            la = update(*la, error, phi, max(abs(error), smallest))
        result.append([*ls[0], *la[0]])
    return np.array(result)


def one_unit_away(signal, random):
    """Every number goes to the next double above or below."""
    return np.nextafter(signal, np.where(random.random(len(signal)) < 0.5, -np.inf, np.inf))


def show(name, values):
    cells = [value if isinstance(value, str) else f"{value:.1e}" for value in values]
    print(f"{name:46s}" + "".join(f"{cell:>13s}" for cell in cells))


def compare_with_reference():
    _, y, w = np.loadtxt(TEST_DATA / "input_paper.csv", delimiter=",", skiprows=1).T
    reference = np.loadtxt(TEST_DATA / "reference_paper.csv", delimiter=",", skiprows=1)[:, 4:]

    def change(rows):
        relative = np.abs(estimate(rows) / reference - 1.0)
        ls, la = relative[:, :2], relative[:, 2:]
        return ls.max(), la[:FIRST_SENSITIVE_ROW].max(), *la[FIRST_SENSITIVE_ROW:].max(axis=0)

    show("largest relative change of", ("LS", "LA < 27.2 s", "b1 of LA", "b0 of LA"))
    show("nothing changed", change(make_rows(y, w)))
    moved = []
    for seed in range(NUM_SEEDS):
        random = np.random.default_rng(seed)
        moved.append(change(make_rows(one_unit_away(y, random), one_unit_away(w, random))))
    for name, statistic in (("least", np.min), ("median", np.median), ("most", np.max)):
        show(f"input one unit off in the last place, {name}", statistic(moved, axis=0))
    show("rows from exact sums, rounded once", change(make_rows(y, w, exact_convolution)))
    show("9.81 added to the input and subtracted again", change(make_rows(y + 9.81 - 9.81, w + 9.81 - 9.81)))


def watch_growth():
    y, w = drive(120.0)
    random = np.random.default_rng(1)
    y, w = (x + random.uniform(-1.0, 1.0, len(x)) * NOISE * np.sqrt(3.0) for x in (y, w))
    rows, moved_rows = make_rows(y, w), make_rows(one_unit_away(y, random), one_unit_away(w, random))
    spans = np.array_split(np.arange(len(rows)), round(len(rows) * T / SPAN))
    show("largest relative change of LA, up to", [f"{(span[-1] + 2 * L) * T:.0f} s" for span in spans])
    for divisor in (None, *RELATIVE_DIVISORS):
        relative = np.abs(estimate(moved_rows, divisor) / estimate(rows, divisor) - 1.0)[:, 2:]
        show(f"eps_min = {EPS:g}" if divisor is None else f"eps_min = {divisor:g} mean |epsilon|",
             [relative[span].max() for span in spans])


if __name__ == "__main__":
    compare_with_reference()
    print()
    watch_growth()
