#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Times of the Python module beside SciPy's, medians of runs in turn, with their ratio:

    PYTHONPATH=build/release/python tests/bench/python_bench.py [RUNS]
"""

import statistics
import sys
import time

from scipy.stats import qmc

import stipple

one = {"threads": 1}
x = stipple.generate("sobol", 2000, 5, scramble="owen", **one)
TASKS = [
    ("Sobol', Owen-scrambled, 2^20 x 4",
     lambda: stipple.generate("sobol", 2**20, 4, scramble="owen", **one),
     lambda: qmc.Sobol(4, seed=1).random(2**20)),
    ("Sobol', plain, 2^20 x 4",
     lambda: stipple.generate("sobol", 2**20, 4, **one),
     lambda: qmc.Sobol(4, scramble=False).random(2**20)),
    ("Halton, plain, 10^6 x 4",
     lambda: stipple.generate("halton", 10**6, 4, **one),
     lambda: qmc.Halton(4, scramble=False).random(10**6)),
    ("Latin hypercube, 10^6 x 4",
     lambda: stipple.generate("latin-hypercube", 10**6, 4, **one),
     lambda: qmc.LatinHypercube(4, seed=1).random(10**6)),
    ("centered L2 discrepancy, 2000 x 5",
     lambda: stipple.analyze("l2-discrepancy:kind=centered", x, **one),
     lambda: qmc.discrepancy(x, method="CD", workers=1)),
    ("Poisson disk, radius .02 in the square",
     lambda: stipple.generate("poisson-disk", radius=0.02, **one),
     lambda: qmc.PoissonDisk(2, radius=0.02, seed=1).fill_space()),
    ("a call: Halton, 10 x 2",
     lambda: stipple.generate("halton", 10, 2, **one),
     lambda: qmc.Halton(2, scramble=False).random(10)),
]


def seconds(call):
    began = time.perf_counter()
    call()
    return time.perf_counter() - began


runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
print(f"{'task':42} {'stipple':>10} {'SciPy':>10} {'ratio':>8}")
for name, ours, theirs in TASKS:
    times = [(seconds(ours), seconds(theirs)) for _ in range(runs)]
    a, b = (statistics.median(column) for column in zip(*times))
    print(f"{name:42} {a:10.6f} {b:10.6f} {b / a:8.1f}")
