#!/usr/bin/python3
"""Reference of the block estimator's equations, from NumPy alone, for test/core/block_reference_test.cpp.

Written from the equations in internal/blocks/*.h, on whole spectra: no half blocks, no sums of bands that are expanded,
no recurrences. Ten struts, 50 to 500 Hz, some of them on uneven stamps of two clocks, with offset, drift, delay,
Coulomb's friction and noise. Readings are whole mm/s^2, stamps whole microseconds, so that what is stored is exact.
Writes into ../data:
  block_drives.csv     drive, T [s], longest sampling time [s], period of body and wheel [us] (0: stamps are stored),
                       theta that everything is linearised at (b1, b0, tau, r, gamma, f)
  block_readings.csv   drive, kind (0 body, 1 wheel [mm/s^2]; 2, 3 their stamps' differences, the first from 0 [us]), values
  block_reference.csv  drive, kind, index, values; the kinds as in KINDS below
"""
import numpy as np

# drive: T, rates of body and wheel, uneven, seconds, b1, b0, friction, delay, offset and drift of the wheel, noise of both
DRIVES = [
    (2.0, 100, 100, False, 20, 4.2, 52.0, 0.0, 0.0, 0.0, 0.0, 0.03, 0.03),
    (2.0, 50, 50, False, 20, 6.0, 63.3, 0.15, 0.002, 0.5, 0.0, 0.05, 0.02),
    (2.0, 200, 200, False, 16, 5.5, 90.0, 0.0, -0.003, -1.0, 0.02, 0.02, 0.2),
    (1.0, 500, 500, False, 8, 9.0, 190.0, 0.3, 0.001, 0.2, 0.0, 0.1, 0.1),
    (4.0, 64, 64, False, 20, 1.5, 13.8, 0.05, 0.004, 0.0, -0.01, 0.02, 0.02),
    (2.0, 125, 80, True, 20, 3.0, 40.0, 0.1, 0.003, 0.3, 0.0, 0.03, 0.03),
    (2.0, 90, 160, True, 18, 7.0, 75.0, 0.0, -0.002, 2.0, 0.03, 0.3, 0.01),
    (1.0, 250, 400, True, 8, 12.0, 320.0, 0.5, 0.0005, 0.0, 0.0, 0.05, 0.05),
    (2.0, 60, 60, True, 20, 4.0, 35.0, 0.2, 0.006, -0.4, 0.0, 0.02, 0.1),
    (2.0, 150, 75, True, 16, 2.5, 60.0, 0.0, 0.0, 9.0, 0.0, 0.5, 0.5),
]
KINDS = {"wheel": 0, "force": 1, "body0": 2, "body1": 3, "body2": 4,            # spectra, real parts, then imaginary ones; index: block
         "information": 5, "score": 6, "moments": 7, "powers": 8,               # sums of a band, by rows; index: band of block SUMMED
         "theta": 9, "covariance": 10, "noise": 11, "rest": 12,                 # of the newest 3, 8, all blocks; index: blocks
         "usual": 13, "theta_usual": 14, "covariance_usual": 15, "rest_usual": 16}  # of all with a usual spectrum
SPECTRA, SUMMED = (1, 4), 3  # blocks
PRIOR_MEAN, PRIOR_SD = np.array([0, 0, 0, 0.5, 0, 0]), np.array([np.inf, np.inf, 0.005, 0.29, 0.1, 0.3])
FIRST, LAST = 2, 40


# -- Struts ------------------------------------------------------------------------------------------------------------

def simulate(drive, rng):
    _, rate_y, rate_x, uneven, seconds, b1, b0, f, tau, offset, drift, noise_y, noise_x = drive
    lines = np.arange(0.37, 0.35 * min(rate_y, rate_x, 80), 0.37)
    amplitude = 3.0 * np.sqrt(2.0 / lines.size) * rng.rayleigh(np.sqrt(0.5), lines.size)
    phase = rng.uniform(0, 2 * np.pi, lines.size)
    wheel = lambda t: np.cos(2 * np.pi * np.outer(t, lines) + phase) @ amplitude
    h = 1 / 4000.0
    fine = np.arange(0, seconds + h, h)
    w = wheel(fine)
    body = np.zeros_like(w)
    d = v = 0.0
    for k in range(fine.size):
        linear = b1 * v + b0 * d
        body[k] = linear + min(max(w[k] - linear + v / h, -f), f)
        v += h * (w[k] - body[k])
        d += h * v
    def stamps(rate, begin):
        if not uneven: return (np.arange(int(seconds * rate)) * round(1e6 / rate)).astype(int)
        t = begin + np.cumsum(rng.uniform(0.4, 1.6, int(seconds * rate * 1.1)) * 1e6 / rate)
        return np.round(t[t < seconds * 1e6 - 1e4]).astype(int)
    ty, tx = stamps(rate_y, -1e6 / rate_y * 0.3), stamps(rate_x, 700.0)
    y = 9.81 + np.interp(ty * 1e-6, fine, body) + noise_y * rng.standard_normal(ty.size)
    x = wheel(tx * 1e-6 - tau) + offset + drift * tx * 1e-6 + noise_x * rng.standard_normal(tx.size)
    return ty, np.round(1000 * y).astype(int), tx, np.round(1000 * x).astype(int)


def friction_direction(t, w, T, b1, b0, f):
    """d'' = w'' - b1 d' - b0 d - f direction, implicit: the direction in [-1, 1] that the step's end needs."""
    longest, memory = T / 4096, 2 * T
    mean, variance, d, v, out = w[0], 0.0, 0.0, 0.0, np.zeros(t.size)
    for i in range(1, t.size):
        spacing = t[i] - t[i - 1]
        mean += spacing / memory * (w[i] - mean)
        variance += spacing / memory * ((w[i] - mean) ** 2 - variance)
        limit = max(f, 0.002 * np.sqrt(variance))
        n = int(np.ceil(spacing / longest))
        h = spacing / n
        for j in range(1, n + 1):
            # (1 + h b1 + h^2 b0) v+ = v + h (drive - b0 d - limit direction)
            drive = w[i - 1] + (w[i] - w[i - 1]) * j / n - mean
            push = v + h * (drive - b0 * d)
            direction = min(max(push / (h * limit), -1.0), 1.0)
            v = (push - h * limit * direction) / (1 + h * b1 + h * h * b0)
            d += h * v
        out[i] = direction
    return out


# -- Spectra -----------------------------------------------------------------------------------------------------------

def with_lost(t, x, T):
    """Where a spacing is 2, 3 or 4 usual ones, readings are interpolated by the cubic through the two on either side. Usual is the
    mean of the 32 spacings before, as long as there is no gap; two other spacings must have been."""
    times, values, mean, count = [t[0]], [x[0]], 0.0, 0
    for i in range(1, t.size):
        spacing = t[i] - t[i - 1]
        parts = int(np.floor(spacing / mean + 0.5)) if count > 1 else 1
        if spacing > T / 32:
            count, parts = 0, 1
        else:
            count = min(count + 1, 32)
            mean += (spacing - mean) / count
        if 2 <= parts <= 4 and i + 1 < t.size and 2 * min(t[i - 1] - t[i - 2], t[i + 1] - t[i]) > spacing / parts:
            u = (t[i - 2:i + 2] - t[i - 1]) / spacing
            cubic = np.linalg.solve(np.vander(u), x[i - 2:i + 2])
            for part in np.arange(1, parts) / parts:
                times.append(t[i - 1] + part * spacing)
                values.append(np.polyval(cubic, part))
        times.append(t[i])
        values.append(x[i])
    return np.array(times), np.array(values)


def integrals(t, x, a, T, omega):
    """U_k: (x - x_0) e^(-j w (t - a)) by straight lines between readings, integrated over [a, a + T]."""
    left, right = t[:-1], t[1:]
    p, q, s = np.clip(left, a, a + T), np.clip(right, a, a + T), right - left
    weight = np.zeros(t.size)
    weight[:-1] += ((right - p) ** 2 - (right - q) ** 2) / (2 * s)
    weight[1:] += ((q - left) ** 2 - (p - left) ** 2) / (2 * s)
    used = weight != 0
    return np.exp(-1j * np.outer(omega, t[used] - a)) @ (weight[used] * (x[used] - x[0]))


def modulated(p, U, s, tau=0.0):
    q = s ** p * U * np.exp(s * tau)
    return 0.5 * q[1:-1] - 0.25 * (q[:-2] + q[2:])


def noise_bands(size):
    edges = [0]
    while edges[-1] < size:
        at = edges[-1]
        to = max(at + 5, int(np.ceil(1.25 * (FIRST + at) - 1e-12)) - FIRST)
        edges.append(size if size - to < 5 else to)
    return [slice(a, b) for a, b in zip(edges[:-1], edges[1:])]


# -- Equations of one block --------------------------------------------------------------------------------------------

class Block:
    def __init__(self, X, F, Y, end, s_all, theta):
        self.X, self.F, self.end = X, F, end
        self.Y = [modulated(p, Y, s_all) for p in range(3)]
        s = s_all[1:-1]
        b1, b0, tau, r, gamma, f = theta
        x = [(1 + gamma) * modulated(p, X, s_all, tau) for p in range(3)]
        force = modulated(2, F, s_all, tau)
        A, g = s * s + b1 * s + b0, b1 * s + b0
        G = g / A
        self.e = (self.Y[2] - b1 * (x[1] - self.Y[1]) - b0 * (x[0] - self.Y[0]) - f * force) / A
        g2, a2 = abs(g) ** 2, abs(A) ** 2
        rho = r * g2 / (r * g2 + (1 - r) * a2)
        rho_by_r = g2 * a2 / (r * g2 + (1 - r) * a2) ** 2
        self.W = x[0] + rho * self.e / G
        dG = [s * (A - g) / A ** 2, (A - g) / A ** 2]  # by b1, b0
        share = -rho_by_r / np.conj(G) * self.W
        self.Z = np.array([dG[0] * self.W, dG[1] * self.W, s * G * self.W, share, G * self.W / (1 + gamma), force / A])
        self.R = np.array([(x[1] - self.Y[1]) / A, (x[0] - self.Y[0]) / A, (b1 * x[2] + b0 * x[1]) / A, share,
                           (b1 * x[1] + b0 * x[0]) / A / (1 + gamma), force / A])
        self.rate = (x[1] - self.Y[1]) / s ** 2


def products(a, b): return np.real(np.conj(a) @ b.T)


def power(x): return float(np.sum(np.abs(x) ** 2))


# -- Window ------------------------------------------------------------------------------------------------------------

def window(blocks, bands, at, usual=None):
    sizes = np.array([b.stop - b.start for b in bands])
    P = np.diag(PRIOR_SD ** -2.0)
    not_r = np.array([1, 1, 1, 0, 1, 1.0])

    def powers(theta):
        return np.array([[power((k.e - (not_r * (theta - at)) @ k.R)[b]) for b in bands] for k in blocks]) / sizes

    def weigh(theta):
        w = np.ones(len(blocks)) if usual is None else np.minimum(1.0, 10.0 / (powers(theta) / usual).mean(1)) ** 2
        return w / w.max()

    def noise(theta, w):
        s2 = w @ powers(theta) / w.sum()
        s2 = s2 * (1 + 4 * 0.972 / (w.sum() * sizes))  # known by so few degrees of freedom
        wheel = w @ (np.array([[power(k.W[b]) for b in bands] for k in blocks]) / sizes) / w.sum()
        return w, s2, s2 / wheel

    def cells(w, s2, scale):
        for i, k in enumerate(blocks):
            for j, b in enumerate(bands):
                turn = np.array([1, 1, 1, scale[j], 1, 1])[:, None]
                yield i, j, w[i] / s2[j], turn * k.Z[:, b], turn * k.R[:, b], k.e[b]

    def normal(w, s2, scale):
        N, spread, right = P.copy(), np.zeros_like(P), P @ PRIOR_MEAN
        for _, _, weight, Z, R, e in cells(w, s2, scale):
            N += weight * products(Z, R)
            spread += weight * products(Z, Z)
            right = right + weight * products(Z, (at @ R + e)[None, :])[:, 0]
        return N, right, spread

    theta, w = at.copy(), np.ones(len(blocks))
    for _ in range(3):
        for _ in range(3):
            N, right, _ = normal(*noise(theta, w))
            new = np.linalg.solve(N, right)
            new[:2] = np.clip(new[:2], theta[:2] / 2, theta[:2] * 2)
            new[3] = np.clip(new[3], 0.02, 0.98)
            theta = new
        before, w = w, weigh(theta)
        if (before == w).all():
            break
    w, s2, scale = noise(theta, w)
    N, _, spread = normal(w, s2, scale)
    inverse = np.linalg.inv(N)
    B = len(blocks)
    correlation = 0.972 + 0.083 * (B - 1) / B
    covariance = inverse @ (correlation * spread + P) @ inverse.T
    scores = np.zeros((B, len(bands), 2))
    information = np.zeros((B, 2))
    for i, j, weight, Z, R, e in cells(w, s2, scale):
        scores[i, j] = (inverse @ (weight * products(Z, (e - (theta - at) @ R)[None, :])[:, 0]))[:2]
        information[i] += weight * np.diag(products(Z, R))[:2]
    lag = np.einsum("bji,bjk->ik", scores[1:], scores[:-1])
    scattered = np.einsum("bji,bjk->ik", scores, scores) + (lag + lag.T) / 2 + (inverse @ P @ inverse.T)[:2, :2]
    inflation = np.trace(np.linalg.solve(covariance[:2, :2], scattered)) / 2  # whatever it is: no least one
    linear = not_r * (theta - at)
    unexplained = sum(w[i] * power(k.e - linear @ k.R) for i, k in enumerate(blocks))
    explained = 1 - unexplained / sum(w[i] * power(k.Y[0]) for i, k in enumerate(blocks))
    rate = np.sqrt(2 * sum(w[i] * power(k.rate) for i, k in enumerate(blocks)) / w.sum() / 0.375)
    ages = np.array([blocks[-1].end - k.end for k in blocks])
    age = (information * ages[:, None]).sum(0) / information.sum(0)
    return theta, covariance * inflation, s2, explained, inflation, rate, age.max()


# -- Files -------------------------------------------------------------------------------------------------------------

def number(x): return "%.16g" % x


def main():
    rng = np.random.default_rng(20261126)
    drives, readings, reference = [], [], []
    for n, drive in enumerate(DRIVES):
        T, rate_y, rate_x, uneven, seconds, b1, b0, f, tau = drive[:9]
        ty, y, tx, x = simulate(drive, rng)
        period = max(np.diff(ty).mean(), np.diff(tx).mean()) * 1e-6
        period = float("%.6g" % period)
        theta = np.array([1.03 * b1, 0.96 * b0, tau + 0.0005, 0.4, 0.02, 0.9 * f])
        drives.append([n, T, period, 0 if uneven else round(1e6 / rate_y), 0 if uneven else round(1e6 / rate_x), *theta])
        readings += [[n, 0, *y], [n, 1, *x]]
        if uneven: readings += [[n, 2, *np.diff(ty, prepend=0)], [n, 3, *np.diff(tx, prepend=0)]]
        ty, tx, y, x = ty * 1e-6, tx * 1e-6, y * 1e-3, x * 1e-3
        last = min(LAST, int(np.floor(0.35 * T / period)))
        omega = 2 * np.pi * np.arange(FIRST - 1, last + 2) / T
        s = 1j * omega
        bands = noise_bands(last - FIRST + 1)
        direction = friction_direction(tx, x, T, theta[0], theta[1], theta[5])
        streams = [with_lost(t, v, T) for t, v in ((tx, x), (tx, direction), (ty, y))]
        blocks = []
        count = int(np.floor(2 * min(ty[-1], tx[-1]) / T)) - 1
        for b in range(count):
            a = b * T / 2
            U = [integrals(t, v, a, T, omega) for t, v in streams]
            blocks.append(Block(*U, a + T, s, theta))

        def keep(kind, index, values): reference.append([n, KINDS[kind], index, *np.ravel(values)])
        for b in SPECTRA:
            k = blocks[b]
            for kind, value in zip(("wheel", "force", "body0", "body1", "body2"), (k.X, k.F, *k.Y)):
                keep(kind, b, [value.real, value.imag])
        k = blocks[SUMMED]
        for j, b in enumerate(bands):
            Z, R, e = k.Z[:, b], k.R[:, b], k.e[None, b]
            both = np.vstack([R, e])
            keep("information", j, products(Z, R))
            keep("score", j, products(Z, e))
            keep("moments", j, products(both, both))
            keep("powers", j, [power(k.W[b]), power(k.Y[0][b]), power(k.rate[b])])
        for m in (3, 8, count):
            t, covariance, noise, *rest = window(blocks[-m:], bands, theta)
            for kind, value in zip(("theta", "covariance", "noise", "rest"), (t, covariance, noise, rest)):
                keep(kind, m, value)
        usual = 0.08 * noise
        t, covariance, _, *rest = window(blocks, bands, theta, usual)
        for kind, value in zip(("usual", "theta_usual", "covariance_usual", "rest_usual"), (usual, t, covariance, rest)):
            keep(kind, count, value)
        print(n, count, t / [b1, b0, 1, 1, 1, 1], rest)
    # A rate over blocks of length T is stored as the library has it, in m/s.
    lengths = {line[0]: line[1] for line in drives}
    for line in reference:
        if line[1] in (KINDS["rest"], KINDS["rest_usual"]): line[5] /= lengths[line[0]]
    for name, header, lines in (("drives", "drive,length,period,body_us,wheel_us,b1,b0,tau,r,gamma,f", drives),
                                ("readings", "drive,kind,values", readings),
                                ("reference", "drive,kind,index,values", reference)):
        with open(f"block_{name}.csv", "w") as file:
            file.write("\n".join([header] + [",".join(number(v) for v in line) for line in lines]) + "\n")


if __name__ == "__main__":
    main()
