#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Compares generators with SciPy's and NumPy's: whole arrays of 2^20 points, on one core; and L2
discrepancies of 16 384 points in five dimensions.

Usage: compare_scipy.py build/release/tests/bench/stipple_bench

Prints millions of points per second of both, or seconds per set, medians of several alternating
runs, and the ratio.
"""

import json
import os
import statistics
import subprocess
import sys
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy
from scipy.stats import qmc

COUNT = 2**20
ROUNDS = 5

PEERS = {
    "sobol/none": lambda d: qmc.Sobol(d, scramble=False).random(COUNT),
    # SciPy's scrambling is a random matrix and a digital shift, too.
    "sobol/matrix": lambda d: qmc.Sobol(d, scramble=True, seed=1).random(COUNT),
    "halton/none": lambda d: qmc.Halton(d, scramble=False).random(COUNT),
    "halton/permutation": lambda d: qmc.Halton(d, scramble=True, seed=1).random(COUNT),
    "latin-hypercube": lambda d: qmc.LatinHypercube(d, seed=1).random(COUNT),
    "random": lambda d: numpy.random.default_rng(1).random((COUNT, d)),
}


# Our benchmark, method of qmc.discrepancy.
DISCREPANCIES = {
    "l2_star": "L2-star",
    "l2_centered": "CD",
    "l2_wraparound": "WD",
    "l2_mixture": "MD",
}
DISCREPANCY_COUNT = 2**14
DISCREPANCY_DIMENSION = 5
DISCREPANCY_ROUNDS = 3


def seconds_of(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


def seconds_of_ours(bench, name, count):
    """Processor time for one set with this number of points, by the benchmark of that name."""
    report = subprocess.run(
        [bench, f"--benchmark_filter=^{name}$", "--benchmark_format=json",
         "--benchmark_min_time=0.2"],
        check=True, capture_output=True, text=True)
    run = json.loads(report.stdout)["benchmarks"][0]
    return count / run["items_per_second"]


def compare_discrepancies(bench):
    n, d = DISCREPANCY_COUNT, DISCREPANCY_DIMENSION
    points = qmc.Sobol(d, scramble=False).random(n)
    print(f"\n{'discrepancy':<22}{'d':>4}{'stipple':>10}{'peer':>10}{'ratio':>8}   seconds a set")
    for name, method in DISCREPANCIES.items():
        ours, theirs = [], []
        for _ in range(DISCREPANCY_ROUNDS):
            ours.append(seconds_of_ours(bench, f"{name}/{n}/{d}", n))
            theirs.append(seconds_of(lambda: qmc.discrepancy(points, method=method, workers=1)))
        mine, peer = statistics.median(ours), statistics.median(theirs)
        print(f"{method:<22}{d:>4}{mine:>10.4f}{peer:>10.3f}{peer / mine:>8.1f}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    print(f"{'set':<22}{'d':>4}{'stipple':>10}{'peer':>10}{'ratio':>8}   million points a second")
    for name in PEERS:
        for dimension in (2, 20):
            ours, theirs = [], []
            for _ in range(ROUNDS):
                ours.append(seconds_of_ours(sys.argv[1], f"array/{name}/{dimension}d", COUNT))
                theirs.append(seconds_of(lambda: PEERS[name](dimension)))
            rate = COUNT / statistics.median(ours) / 1e6
            peer = COUNT / statistics.median(theirs) / 1e6
            print(f"{name:<22}{dimension:>4}{rate:>10.1f}{peer:>10.2f}{rate / peer:>8.1f}")
    compare_discrepancies(sys.argv[1])


if __name__ == "__main__":
    main()
