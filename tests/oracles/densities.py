"""Densities by formula, and kernel discrepancies on a domain, against integrals by SciPy and the definitions."""
import math
import random
import tempfile

import numpy
from scipy import integrate, stats

LAWS = {"normal": stats.norm(), "exponential": stats.expon(), "gumbel": stats.gumbel_r(), "uniform:low=-1,high=3": stats.uniform(-1, 4),
        "student-t:degrees=3": stats.t(3), "beta:a=2,b=5": stats.beta(2, 5)}
FALLING = {"gaussian": lambda t: numpy.exp(-t * t / 2), "0.5": lambda t: numpy.exp(-t),
           "1.5": lambda t: (1 + math.sqrt(3) * t) * numpy.exp(-math.sqrt(3) * t),
           "2.5": lambda t: (1 + math.sqrt(5) * t + 5 / 3 * t * t) * numpy.exp(-math.sqrt(5) * t)}


def check_kernel_discrepancy(cases):
    """kernel-discrepancy of warped points, by SciPy's distributions and integrals."""
    nodes, weights = numpy.polynomial.legendre.leggauss(1500)
    shares, weights = (nodes + 1) / 2, weights / 2
    for spec, law in LAWS.items():
        y = law.ppf(shares)
        x = numpy.array(cases.points("generate", "random", "-n", 40, "-d", 1, "-w", spec))[:, 0]
        text = "\n".join(map(repr, map(float, x))) + "\n"
        for kernel, k in FALLING.items():
            for h in (0.3, 3.0):
                options = ["--kernel", "gaussian"] if kernel == "gaussian" else ["--kernel", "matern", "--smoothness", kernel]
                ours = cases.results("kernel-discrepancy", "--domain", spec, *options, "--bandwidth", h, "-", text=text)
                means = numpy.array([numpy.sum(weights * k(abs(one - y) / h)) for one in x])
                total = numpy.sum(weights * numpy.array([numpy.sum(weights * k(abs(one - y) / h)) for one in y]))
                pairs = numpy.mean(k(abs(x[:, None] - x[None, :]) / h))
                cases.compare(f"{spec} {kernel} h = {h}", ours["squared"], total - 2 * means.mean() + pairs,
                              3e-4 if kernel == "0.5" else 1e-4, 1e-6)  # the kink at 0 costs the sums 1e-4


def check_median_bandwidth(cases):
    """The median distance of two points."""
    for n, m, d in ((1, 1, 1), (2, 1, 2), (2, 2, 1), (5, 4, 3), (40, 41, 2)):
        draws = random.Random(n * 100 + m)
        rows = [[draws.random() for _ in range(d)] for _ in range(n + m)]
        lines = [" ".join(map(repr, row)) + "\n" for row in rows]
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.writelines(lines[n:])
            file.flush()
            ours = cases.results("kernel-discrepancy", "--kernel", "gaussian", "--target", file.name, "-", text="".join(lines[:n]))
        right = numpy.median([math.dist(a, b) for i, a in enumerate(rows) for b in rows[:i]])
        cases.compare(f"{n} and {m} points", ours["bandwidth"], right, 1e-14)


def share(cases, density, inside, n=1 << 16):
    """Fraction of points inside; None if the density is rejected as too narrow for a table."""
    warp = f"expression-2d:density=[{density}],tolerance=0.002"
    out = cases.run("generate", "sobol", "-n", n, "-d", 2, "-w", warp, "-f", "txt", ok=(0, 5))
    rows = [[float(word) for word in line.split()] for line in out.splitlines()]
    return sum(inside(x, y) for x, y in rows) / n if rows else None


def check_narrow_features(cases):
    """Disks of 1/256, lines and rings, by their areas."""
    draws = random.Random(3)
    for _ in range(12):
        r = 0.5 / 256 * draws.uniform(1, 4)
        x, y = draws.uniform(0.02, 0.98), draws.uniform(0.02, 0.98)
        area = math.pi * r * r
        found = share(cases, f"(x-{x})^2+(y-{y})^2<{r}^2?{1 / area}:1", lambda a, b: math.hypot(a - x, b - y) < r)
        cases.compare(f"a disk of {r:.4g} at {x:.4f}, {y:.4f}", found, 1 / (2 - area), 0, 0.004 if r > 0.003 else 0.015)
    for _ in range(4):
        at, half = draws.uniform(0.1, 0.9), 10 ** draws.uniform(-4, -2.5)
        for name, place in (("x", 0), ("y", 1)):
            found = share(cases, f"abs({name}-{at})<{half}?{0.5 / half}:1", lambda *p: abs(p[place] - at) < half)
            what = f"a line {2 * half:.3g} wide at {name} = {at:.4f}"
            if found is None:
                cases.expect(what, half < 0.5 / 256, "refused")
            else:
                cases.compare(what, found, 1 / (2 - 2 * half), 0, 0.004)


def check_smooth_densities(cases):
    """Means of smooth formulas, by SciPy's cubature."""
    for formula, f in {"1+x*y": lambda x, y: 1 + x * y, "exp(-50*((x-0.3)^2+(y-0.6)^2))":
                       lambda x, y: math.exp(-50 * ((x - 0.3) ** 2 + (y - 0.6) ** 2)),
                       "2+sin(9*x)*cos(7*y)": lambda x, y: 2 + math.sin(9 * x) * math.cos(7 * y)}.items():
        rows = numpy.array(cases.points("generate", "sobol", "-n", 1 << 16, "-d", 2, "-w", f"expression-2d:density=[{formula}]"))
        whole = integrate.dblquad(lambda y, x: f(x, y), 0, 1, 0, 1)[0]
        for name, place in (("x", 0), ("y", 1)):
            right = integrate.dblquad(lambda y, x: f(x, y) * (x, y)[place], 0, 1, 0, 1)[0] / whole
            cases.compare(f"mean {name} of {formula}", rows[:, place].mean(), right, 0, 1e-3)
