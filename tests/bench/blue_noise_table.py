#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Prints a table that judges every blue-noise generator by the same measures (Markdown).

Usage: blue_noise_table.py STIPPLE [--sets R] [--count N] [GENERATOR...]

STIPPLE is the program, such as build/release/src/stipple. Each generator makes R sets (default 10,
seeds 1, 2, ...) of N points (default 4096) of the unit torus. Numbers are means over the sets, with
the standard error of the last digit in brackets.

    minimum, mean   distance to the nearest neighbour, over that of hexagons
    coverage        radius of the largest empty circle, over that of hexagons
    D*              star discrepancy, in thousandths
    bonds           mean over points of |sum_j exp(6 i theta_j)| / k, of k Delaunay neighbours
    low power       mean power of 0 < |f| < sqrt(n) / 4, half the Nyquist frequency of a grid
    peak            largest radial power, and its frequency over sqrt(n)
    Nyquist         effective Nyquist frequency over that of a grid, sqrt(n) / 2
    oscillation     of the radial power, times 10 (Heck, Schloemer, Deussen 2013)
    anisotropy      of the mean power over all sets, in dB, without what the slope of the radial
                    power makes of it inside a ring: the mean, and the largest of bands of eight
                    rings, but for the first. White noise has -10 log10(R), a band within 0.5 dB
    seconds         processor time for one set, on one core
"""

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

REFERENCES = ("random", "jittered")
# From the simplest to the most expensive.
BLUE_NOISE = (
    "dart-throwing",
    "best-candidate",
    "poisson-disk",
    "sample-elimination",
    "void-and-cluster",
    "lloyd",
    "farthest-point",
    "capacity-constrained",
    "gaussian-blue-noise",
    "tiled",
)
BAND = 8  # rings

COLUMNS = (
    "generator",
    "minimum",
    "mean",
    "coverage",
    "D* / 10⁻³",
    "bonds",
    "low power",
    "peak",
    "at",
    "Nyquist",
    "oscillation",
    "anisotropy",
    "largest",
    "seconds",
)

# Published values, relative to hexagons or a grid as in the table.
PUBLISHED = (
    (
        "random",
        "minimum 0.009, mean 0.469 (one set, n = 1024)",
        "Schlömer, Heck, Deussen 2011, figure 1, first picture",
    ),
    (
        "random",
        "mean 0.4653: a Poisson process has 1 / (2 √n)",
        "Clark, Evans 1954",
    ),
    (
        "poisson-disk",
        "minimum 0.7767: endless darts come to cover 0.547 by disks, n r² = 0.6966",
        "Feder 1980",
    ),
    (
        "poisson-disk",
        "minimum in 0.65 ... 0.85, for Poisson-disk sets of use",
        "Lagae, Dutré 2008",
    ),
    (
        "poisson-disk",
        "coverage at most √3 × minimum, since no empty circle has the radius r",
        "by definition",
    ),
    (
        "farthest-point",
        "minimum 0.925, mean 0.932 (one set, n = 1024, 63 iterations)",
        "Schlömer, Heck, Deussen 2011, figure 1, last picture",
    ),
)


def fail(message):
    sys.exit(f"blue_noise_table.py: {message}")


def stipple(program, *words):
    """Output of the program, and its processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    except OSError as error:
        fail(f"{program}: {error.strerror}")
    if done.returncode != 0:
        fail(done.stderr.strip())
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.stdout, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


# ---------------------------------------------------------------- measures


def number(value, error=None, digits=None):
    """0.7769(3): the error is in units of the last digit; without an error, this many digits."""
    if not error:
        return f"{value:.{digits or 3}f}"
    digits = max(0, int(np.ceil(-np.log10(error * 1.05))))
    return f"{value:.{digits}f}({round(error * 10**digits)})"


def scientific(value, error):
    """1.9e-4 if plain notation would be long."""
    return number(value, error) if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")


def decibels(ratio):
    return 10 * np.log10(max(ratio, 1e-10))


def of_spectrum(report, count):
    """Cells of the table for the mean power over all sets."""
    results, errors = report["results"], report["standard_error"]
    radial = {key: np.array(curve) for key, curve in results["radial"].items()}
    frequency, power, cells = radial["frequency"], radial["power"], radial["cells"]
    error = np.array(errors["radial"]["power"])
    low = frequency < np.sqrt(count) / 4
    low_power = np.average(power[low], weights=cells[low])
    low_error = np.sqrt(((error * cells)[low] ** 2).sum()) / cells[low].sum()
    top = power.argmax()
    slope = np.gradient(np.log(np.maximum(power, 1e-300)))
    uneven = (10 ** (radial["anisotropy_db"] / 10) - slope**2 / 12) * cells  # 12: rings are 1 wide
    starts = np.arange(BAND, len(cells), BAND)  # fewer rings have too few frequencies
    bands = np.add.reduceat(uneven, starts) / np.add.reduceat(cells, starts)
    regular = results["regular_nyquist"]
    return [
        scientific(low_power, low_error),
        number(power[top], error[top]),
        f"{frequency[top] / np.sqrt(count):.2f}",
        # Of the mean power: no errors are known.
        f"{results['effective_nyquist'] / regular:.2f}",
        f"{results['oscillation']:.1f}",
        f"{decibels(uneven[BAND:].sum() / cells[BAND:].sum()):.1f}",
        f"{decibels(bands.max()):.1f}",
    ]


def row(program, name, count, sets, folder):
    """One line of the table."""
    generator, *options = name.split()
    file = str(Path(folder) / "points.npy")
    make = ("generate", generator, "-n", str(count), "-m", str(sets), "-s", "1", *options)
    _, seconds = stipple(program, *make, "-f", "npy", "--threads", "1", "-o", file)

    def analyze(analyzer):
        words = ("analyze", analyzer, file, "--average", "--format", "json")
        return json.loads(stipple(program, *words)[0])

    def value(report, key, scale=1.0):
        error = report["standard_error"][key] * scale
        return number(report["results"][key] * scale, error)

    hexagons = np.sqrt(2 / (np.sqrt(3) * count))  # distance of neighbours
    near, star = analyze("nearest-neighbor"), analyze("star-discrepancy")
    cells = analyze("voronoi")
    order = {key: cells[key]["bond_order"] for key in ("results", "standard_error")}
    return [
        name,
        value(near, "relative_radius"),
        value(near, "mean", 1 / hexagons),
        value(analyze("coverage"), "radius", np.sqrt(3) / hexagons),
        value(star, "value", 1000),
        value(order, "local"),
        *of_spectrum(analyze("periodogram"), count),
        number(seconds / sets, digits=2),
    ]


def print_table(heads, rows):
    widths = [max(map(len, column)) for column in zip(heads, *rows)]
    for line in (heads, ["-" * w for w in widths], *rows):
        print("|" + "|".join(f" {c:<{w}} " for c, w in zip(line, widths)) + "|", flush=True)


def registered(program):
    listed = json.loads(stipple(program, "list", "generators", "--json")[0])
    return {unit["name"] for unit in listed["generators"]}


def arguments(words):
    """The program, and options with their values; the rest are generators."""
    chosen = {"--sets": 10, "--count": 4096}
    rest = []
    words = iter(words)
    for word in words:
        if word in chosen:
            chosen[word] = int(next(words, "0"))
        else:
            rest.append(word)
    if not rest or rest[0].startswith("-") or min(chosen.values()) < 2:
        sys.exit(__doc__.split("\n\n")[1])
    return rest[0], rest[1:], chosen["--count"], chosen["--sets"]


def main():
    program, names, count, sets = arguments(sys.argv[1:])
    if not names:
        known = registered(program)
        names = [name for name in REFERENCES + BLUE_NOISE if name in known]
    with tempfile.TemporaryDirectory() as folder:
        rows = [row(program, name, count, sets, folder) for name in names]
    print_table(COLUMNS, rows)
    print()
    print_table(("generator", "published", "where"), PUBLISHED)


if __name__ == "__main__":
    main()
