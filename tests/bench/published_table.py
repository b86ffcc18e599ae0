#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Prints published values of samplers beside those measured by the program (Markdown).

Usage: published_table.py STIPPLE [--sets R] [SAMPLER...]

STIPPLE is the program, such as build/release/src/stipple. Each sampler makes R sets (default 10,
seeds 1, 2, ...) of points of the unit torus; without names, all samplers do. Ours are means over
the sets, with the standard error of the last digit in brackets.

    minimum     smallest distance of two points, over that of hexagons (relative radius)
    mean        distance to the nearest neighbour, the same
    bond order  mean over points of |sum_j exp(6 i theta_j)| / k, of k Voronoi neighbours
    coverage    of the torus by disks that touch the nearest points: pi / 4 minimum^2 n
    area        variance of the Voronoi cells' areas over their squared mean
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

THESIS = "Schlömer, table 4.1"
FPO = "Schlömer, Heck, Deussen 2011, figure 1"

SOURCES = (
    "P. J. Clark, F. C. Evans, Ecology 35 (1954) 445-453, doi:10.2307/1931034.",
    "J. Feder, J. Theor. Biol. 87 (1980) 237-254.",
    "F. Járai-Szabó, Z. Néda, On the size-distribution of Poisson Voronoi cells, "
    "arXiv:cond-mat/0406116: a Gamma law of shape and rate 7/2, fitted.",
    "T. Schlömer, Non-Periodic Corner Tilings in Computer Graphics, dissertation, Universität "
    "Konstanz. Number of points, iterations and neighbours that a bond has are not said where the "
    "table could be read; the minimum of random points is that of 4096.",
    "T. Schlömer, D. Heck, O. Deussen, High Performance Graphics (2011) 135-142, "
    "doi:10.1145/2018323.2018345. One set of 1024 points.",
)

# Words after `generate`, the count, and published values: (measure, value, source).
SAMPLERS = {
    "random": (
        "random",
        4096,
        (
            ("minimum", "0.010", THESIS),
            ("mean", "0.464", THESIS),
            ("mean", "0.4653", "Clark, Evans 1954: 1 / (2 √n)"),
            ("bond order", "0.365", THESIS),
            ("area", "0.286", "Járai-Szabó, Néda 2004"),
        ),
    ),
    "jittered": (
        "jittered",
        4096,
        (
            ("minimum", "0.049", THESIS),
            ("mean", "0.586", THESIS),
            ("bond order", "0.363", THESIS),
        ),
    ),
    # The published minimum, 0.75 sqrt(2 / (sqrt(3) n)), is the radius: all else is a prediction.
    "dart-throwing": (
        "dart-throwing --radius 0.01259254 --misses 1000000000",
        4096,
        (
            ("minimum", "0.750", THESIS),
            ("mean", "0.805", THESIS),
            ("bond order", "0.367", THESIS),
        ),
    ),
    "poisson-disk": (
        "poisson-disk",
        4096,
        (("coverage", "0.547", "Feder 1980: random sequential adsorption"),),
    ),
    "best-candidate": (
        "best-candidate --candidates 100",
        4096,
        (
            ("minimum", "0.751", THESIS),
            ("mean", "0.839", THESIS),
            ("bond order", "0.396", THESIS),
        ),
    ),
    "capacity-constrained": (
        "capacity-constrained",
        4096,
        (
            ("minimum", "0.764", THESIS),
            ("mean", "0.891", THESIS),
            ("bond order", "0.519", THESIS),
        ),
    ),
    "lloyd": (
        "lloyd --iterations 300",
        4096,
        (
            ("minimum", "0.795", THESIS),
            ("mean", "0.939", THESIS),
            ("bond order", "0.804", THESIS),
        ),
    ),
    "farthest-point": (
        "farthest-point --iterations 63",
        1024,
        (
            ("minimum", "0.925", FPO),
            ("mean", "0.932", FPO),
        ),
    ),
}


def fail(message):
    sys.exit(f"published_table.py: {message}")


def stipple(program, *words):
    """Output of the program."""
    try:
        done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    except OSError as error:
        fail(f"{program}: {error.strerror}")
    if done.returncode != 0:
        fail(done.stderr.strip())
    return done.stdout


def measures(program, words, count, sets, folder):
    """Mean and standard error of every measure."""
    file = str(Path(folder) / "points.npy")
    make = ("generate", *words.split(), "-n", str(count), "-m", str(sets), "-s", "1")
    stipple(program, *make, "-f", "npy", "-o", file)

    def analyze(analyzer):
        report = json.loads(
            stipple(program, "analyze", analyzer, file, "--average", "--format", "json")
        )
        return report["results"], report["standard_error"]

    near, near_error = analyze("nearest-neighbor")
    cells, cells_error = analyze("voronoi")
    hexagons = math.sqrt(2 / (math.sqrt(3) * count))
    radius, radius_error = near["relative_radius"], near_error["relative_radius"]
    packed = math.pi / math.sqrt(12)  # hexagons' coverage
    return {
        "minimum": (radius, radius_error),
        "mean": (near["mean"] / hexagons, near_error["mean"] / hexagons),
        "coverage": (packed * radius**2, 2 * packed * radius * radius_error),
        "bond order": (cells["bond_order"]["local"], cells_error["bond_order"]["local"]),
        "area": (cells["area"]["capacity_error"], cells_error["area"]["capacity_error"]),
    }


def number(value, error):
    """0.7771(6): the error in units of the last digit."""
    digits = 4 if error == 0 else min(4, max(0, -math.floor(math.log10(error))))
    return f"{value:.{digits}f}({math.ceil(error * 10**digits - 1e-9)})"


def print_table(heads, rows):
    widths = [max(map(len, column)) for column in zip(heads, *rows)]
    for line in (heads, ["-" * w for w in widths], *rows):
        print("|" + "|".join(f" {c:<{w}} " for c, w in zip(line, widths)) + "|", flush=True)


def arguments(words):
    """The program, the samplers, and how many sets."""
    sets = 10
    rest = []
    words = iter(words)
    for word in words:
        if word == "--sets":
            text = next(words, "")
            sets = int(text) if text.isdigit() else 0
        else:
            rest.append(word)
    if not rest or any(word.startswith("-") for word in rest) or sets < 2:
        sys.exit(__doc__.split("\n\n")[1])
    for name in rest[1:]:
        if name not in SAMPLERS:
            fail(f"no value is known of {name}; there are {', '.join(SAMPLERS)}")
    return rest[0], rest[1:] or list(SAMPLERS), sets


def main():
    program, names, sets = arguments(sys.argv[1:])
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            words, count, printed = SAMPLERS[name]
            ours = measures(program, words, count, sets, folder)
            for measure, value, where in printed:
                rows.append(
                    (f"`{words} -n {count}`", measure, value, number(*ours[measure]), where)
                )
    print_table(("sampler", "measure", "published", "ours", "where"), rows)
    print()
    print("\n".join(f"- {source}" for source in SOURCES))


if __name__ == "__main__":
    main()
