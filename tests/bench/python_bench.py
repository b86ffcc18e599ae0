#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Processor times of the Python module on one thread, of SciPy, and of the same in-memory calls of the C++
library: medians of alternating runs, and medians of the runs' ratios. `SciPy` is SciPy's time relative to
the module's, `library` the module's time relative to the library's.

    cmake --build build/release -t stipple_library_call
    PYTHONPATH=build/release/python tests/bench/python_bench.py build/release/tests/bench [RUNS]
"""

import statistics
import subprocess
import sys
import time
from pathlib import Path

from scipy.stats import qmc

import stipple

x = stipple.generate("sobol", 2000, 5, scramble="owen")
# Name, arguments of stipple_library_call, SciPy's call. A count of 0 is the generator's own.
TASKS = [
    ("Sobol', Owen-scrambled, 2^20 x 4", ["sobol:scramble=owen", 2**20, 4],
     lambda: qmc.Sobol(4, seed=1).random(2**20)),
    ("Sobol', plain, 2^20 x 4", ["sobol", 2**20, 4],
     lambda: qmc.Sobol(4, scramble=False).random(2**20)),
    ("Halton, plain, 10^6 x 4", ["halton", 10**6, 4],
     lambda: qmc.Halton(4, scramble=False).random(10**6)),
    ("Latin hypercube, 10^6 x 4", ["latin-hypercube", 10**6, 4],
     lambda: qmc.LatinHypercube(4, seed=1).random(10**6)),
    ("centered L2 discrepancy, 2000 x 5", ["sobol:scramble=owen", 2000, 5, "l2-discrepancy:kind=centered"],
     lambda: qmc.discrepancy(x, method="CD", workers=1)),
    ("wrap-around L2 discrepancy, 2000 x 5", ["sobol:scramble=owen", 2000, 5, "l2-discrepancy:kind=wraparound"],
     lambda: qmc.discrepancy(x, method="WD", workers=1)),
    ("star discrepancy, 4096 x 2", ["sobol:scramble=owen", 4096, 2, "star-discrepancy"], None),
    ("Poisson disk, radius .02 in the square", ["poisson-disk:radius=0.02", 0, 2],
     lambda: qmc.PoissonDisk(2, radius=0.02, seed=1).fill_space()),
    ("a call: Halton, 10 x 2", ["halton", 10, 2],
     lambda: qmc.Halton(2, scramble=False).random(10)),
]


def seconds(call, calls=10):
    """Smallest processor time of ten calls, like that of stipple_library_call."""
    times = []
    for _ in range(calls):
        began = time.process_time()
        call()
        times.append(time.process_time() - began)
    return min(times)


def module_call(generator, n, d, analyzer=None):
    if analyzer is None:
        return lambda: stipple.generate(generator, n or None, d, threads=1)
    points = stipple.generate(generator, n, d)
    return lambda: stipple.analyze(analyzer, points, threads=1)


program = Path(sys.argv[1]) / "stipple_library_call"
runs = int(sys.argv[2]) if len(sys.argv) > 2 else 5
print(f"{'task':42} {'module/s':>10} {'SciPy':>8} {'library':>8}")
for name, words, scipy in TASKS:
    ours = module_call(*words)
    times = []
    for _ in range(runs):
        library = subprocess.run([program, *map(str, words)], capture_output=True, check=True)
        times.append((seconds(ours), seconds(scipy, 1) if scipy else float("nan"), float(library.stdout)))
    median = statistics.median
    print(f"{name:42} {median(a for a, _, _ in times):10.6f} {median(b / a for a, b, _ in times):8.1f} "
          f"{median(a / c for a, _, c in times):8.2f}")
