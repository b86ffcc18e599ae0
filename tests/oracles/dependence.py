"""Correlations of parameters, by SciPy's distributions and integrals of NumPy."""
import itertools
import json
import pathlib
import re
import subprocess
import tempfile

import numpy as np
from scipy import optimize, stats
from scipy.stats import norm

NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


class Steps:
    """A discrete parameter: its outcomes and probabilities, or the mean ranks of these."""

    def __init__(self, keys, values, p, ranks=False):
        self.keys, self.values, p = keys, np.asarray(values, float), np.asarray(p, float) / np.sum(p)
        ends = np.cumsum(p)
        numbers = ends - p / 2 if ranks else self.values
        self.at, self.size = norm.ppf(ends[:-1]), np.diff(numbers)
        self.deviation = np.sqrt(p @ (numbers - p @ numbers) ** 2)
        self.numbers, self.ends = numbers, ends

    def of_score(self, z):
        return self.values[np.searchsorted(self.at, z)]

    def x(self, z):
        return self.numbers[np.searchsorted(self.at, z)]

    def near_step(self, z):
        return np.min(np.abs(self.at[:, None] - z), axis=0) < 1e-6


class Smooth:
    """A continuous parameter, by its numbers as a function of their normal scores."""

    def __init__(self, keys, of_score, x=None):
        self.keys, self.of_score, self.x = keys, of_score, x or of_score
        z = np.arange(-37 * 64, 37 * 64 + 1) / 64
        w = norm.pdf(z) / 64
        self.mean = w @ self.x(z)
        self.deviation = np.sqrt(w @ (self.x(z) - self.mean) ** 2)

    def near_step(self, z):
        return np.zeros(len(z), bool)


def levels(values, p, ranks=False):
    return Steps({"levels": list(values), "probabilities": list(p)}, values, p, ranks)


def integers(n, ranks=False):
    return Steps({"integers": [1, n]}, range(1, n + 1), np.ones(n), ranks)


def student_4(z):
    """Student's quantile for 4 degrees of freedom, in closed form (W. T. Shaw 2006)."""
    p = norm.cdf(-np.abs(z))
    root = np.sqrt(4 * p * (1 - p))
    return np.sign(z) * 2 * np.sqrt(np.maximum(np.cos(np.arccos(root) / 3) / root - 1, 0))


def families(ranks):
    uniform = norm.cdf if ranks else None
    made = {
        "bit": levels([0, 1], [1, 1], ranks),
        "rare": levels([0, 1], [9, 1], ranks),
        "levels": levels([0, 1, 5], [2, 5, 3], ranks),
        "integers": integers(8, ranks),
        "normal": Smooth({"distribution": "normal"}, lambda z: z, uniform),
        "uniform": Smooth({"range": [2, 5]}, lambda z: 2 + 3 * norm.cdf(z), uniform),
    }
    if not ranks:
        made |= {
            "lognormal": Smooth({"distribution": "lognormal", "sigma": 2}, lambda z: np.exp(2 * z)),
            "exponential": Smooth({"distribution": "exponential"}, lambda z: -norm.logsf(z)),
            "weibull": Smooth({"distribution": "weibull", "shape": 0.4}, lambda z: (-norm.logsf(z)) ** 2.5),
            "student": Smooth({"distribution": "student-t", "degrees": 4}, student_4),
        }
    return made


def excess(h, k, r):
    """Phi2(h, k; r) - Phi(h) Phi(k) for vectors h and k, by Plackett's integral over graded pieces."""
    k, end = (k, np.arcsin(r)) if r >= 0 else (-k, np.arcsin(-r))
    ends = [t for t in np.pi / 2 - np.pi / 2 * 0.5 ** np.arange(30) if t < end] + [end]
    total = np.zeros((len(h), len(k)))
    for low, high in zip(ends, ends[1:]):
        t = (low + high) / 2 + (high - low) / 2 * NODES[:, None, None]
        a, b = h[None, :, None], k[None, None, :]
        part = np.exp(-(a * a + b * b - 2 * a * b * np.sin(t)) / (2 * np.cos(t) ** 2))
        total += (high - low) / 2 * np.tensordot(WEIGHTS, part, 1)
    return np.sign(r) * total / (2 * np.pi)


def correlation(a, b, r):
    scale = a.deviation * b.deviation
    if isinstance(a, Steps) and isinstance(b, Steps):
        return a.size @ excess(a.at, b.at, r) @ b.size / scale
    if isinstance(a, Steps):
        a, b = b, a
    s = np.sqrt(1 - r * r)
    if isinstance(b, Steps):
        step = min(1 / 64, s / 8)
        z = np.arange(-14, 14, step)
        w = step * norm.pdf(z) * (a.x(z) - a.mean)
        return sum(size * (w @ norm.cdf((r * z - at) / s)) for at, size in zip(b.at, b.size)) / scale
    u = np.arange(-12 * 8, 12 * 8 + 1) / 8
    u, v = np.meshgrid(u, u)
    c, d = np.sqrt((1 + r) / 2), np.sqrt((1 - r) / 2)
    w = norm.pdf(u) * norm.pdf(v) / 64
    return np.sum(w * (a.x(c * u + d * v) - a.mean) * (b.x(c * u - d * v) - b.mean)) / scale


def end_of(a, b, sign):
    """Mean over z between all steps, for one normal score z and sign z."""
    ends = [np.arange(-37, 37.01, 0.25)]
    ends += [side * x.at for x, side in ((a, 1), (b, sign)) if isinstance(x, Steps)]
    ends = np.unique(np.concatenate(ends))
    low, high = ends[:-1, None], ends[1:, None]
    z = (low + high) / 2 + (high - low) / 2 * NODES
    w = (high - low) / 2 * WEIGHTS * norm.pdf(z)
    x, y = a.x(z), b.x(sign * z)
    return (np.sum(w * x * y) - np.sum(w * x) * np.sum(w * y)) / (a.deviation * b.deviation)


def parameters(folder, a, b, kind, r, more=None):
    text = {"parameters": [{"name": "a"} | a.keys, {"name": "b"} | b.keys],
            "correlation": {kind: [["a", "b", r]]} | (more or {})}
    path = pathlib.Path(folder) / "p.json"
    path.write_text(json.dumps(text))
    return path


def compare_points(cases, kind, ranks):
    made = families(ranks)
    cube = np.array(cases.points("generate", "random", "-n", 400, "-d", 2))
    z, y = norm.ppf(cube).T
    names = list(made)
    with tempfile.TemporaryDirectory() as folder:
        for first, second in itertools.combinations_with_replacement(names, 2):
            a, b = made[first], made[second]
            if ranks and isinstance(a, Smooth) and isinstance(b, Smooth):
                continue
            low, high = end_of(a, b, -1), end_of(a, b, 1)
            for share in (0.05, 0.9):
                r = float(low + share * (high - low))
                if abs(r) < 1e-3:
                    continue
                score = optimize.brentq(lambda x: correlation(a, b, x) - r, -0.99999, 0.99999, xtol=1e-10)
                file = parameters(folder, a, b, kind, r)
                ours = np.array(cases.points("generate", "random", "-n", 400, "--parameters", file))
                of_b = score * z + np.sqrt(1 - score * score) * y
                right = b.of_score(of_b)
                wrong = np.abs(ours[:, 1] - right) > 2e-5 * (1 + np.abs(right)) * (1 + np.abs(of_b))
                wrong &= ~b.near_step(of_b)
                cases.expect(f"{kind} {r:.6f} of {first} and {second}, scores {score:.9f}", not wrong.any(),
                             f"{wrong.sum()} of 400 points differ")


def check_linear(cases):
    """Points with a linear correlation are those of the scores that have it"""
    compare_points(cases, "pearson", False)


def check_spearman(cases):
    """Points with a rank correlation of mean ranks are those of the scores that have it"""
    compare_points(cases, "spearman", True)


def check_ends(cases):
    """What two parameters cannot have is refused with the range that they can"""
    for kind, ranks in (("pearson", False), ("spearman", True)):
        made = families(ranks)
        with tempfile.TemporaryDirectory() as folder:
            for (first, a), (second, b) in itertools.combinations_with_replacement(made.items(), 2):
                low, high = end_of(a, b, -1), end_of(a, b, 1)
                asked = high + (1 - high) / 2 if high < 0.9999 else low - (1 + low) / 2
                if abs(asked) > 0.9999 or (ranks and isinstance(a, Smooth) and isinstance(b, Smooth)):
                    continue
                file = parameters(folder, a, b, kind, asked)
                done = subprocess.run([cases.program, "generate", "sobol", "-n", "4", "--parameters", file],
                                      capture_output=True, text=True)
                said = re.search(r"correlations in \[(\S+), (\S+)\]", done.stderr)
                cases.expect(f"{kind} of {first}, {second} refused", said is not None, done.stderr)
                if said:
                    cases.compare(f"{kind}, low end of {first}, {second}", said[1], low, 0, 2e-6)
                    cases.compare(f"{kind}, high end of {first}, {second}", said[2], high, 0, 2e-6)


def check_reordering(cases):
    """Iman and Conover's reordering reaches the rank correlations of ties, or says what it reached"""
    made = families(True)
    more = {"reordering": "iman-conover"}
    with tempfile.TemporaryDirectory() as folder:
        for (first, a), (second, b) in itertools.combinations_with_replacement(made.items(), 2):
            for n, share in ((20, 0.7), (200, 0.1), (2000, 0.95)):
                low, high = end_of(a, b, -1), end_of(a, b, 1)
                r = float(low + share * (high - low))
                file = parameters(folder, a, b, "spearman", r, more)
                done = subprocess.run([cases.program, "generate", "latin-hypercube", "-n", str(n), "-f", "txt",
                                       "--parameters", file], capture_output=True, text=True)
                rows = np.array([[float(x) for x in line.split()] for line in done.stdout.splitlines()
                                 if not line.startswith("#")])
                reached = stats.spearmanr(rows[:, 0], rows[:, 1]).statistic
                said = re.search(r"points is (\S+);", done.stderr)
                what = f"{first} and {second}, {r:.4f} in {n} points"
                if said:
                    cases.compare(f"{what}: the number that is told", said[1], reached, 0, 1e-4)
                    cases.expect(f"{what}: near for many points", n < 200 or abs(reached - r) < 0.03, reached)
                else:
                    cases.compare(what, reached, r, 0, 0.0101)
