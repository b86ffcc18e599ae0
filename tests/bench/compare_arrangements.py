#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Time and memory of the analyzers for points that are not random, relative to as many random points.

Usage: compare_arrangements.py PROGRAM [--count N] [--dimension D] [--limit SECONDS] [ANALYZER ...]

PROGRAM is a stipple; each analyzer (by default all) gets N points (10 000) of D coordinates (2) in eleven arrangements.
One row per analyzer: processor seconds and memory for random points, then for each arrangement the ratio of the
seconds. Ratios above ten are marked *, and runs that exceed the limit (60 processor seconds) read "over". Times below
0.05 s are counted as 0.05 s.
"""

import argparse
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile

import numpy

SHORTEST = 0.05
OPTIONS = {"integration": ["--expression", "x*y"]}


def arrangements(n, d):
    """Name and n x d array of each arrangement, all in the unit cube."""
    rng = numpy.random.default_rng(1)
    random = rng.random((n, d))
    index = numpy.arange(n)
    line = (index + 0.5) / n
    middle = numpy.full((n, d), 0.5)
    directions = rng.normal(size=(n, d))
    directions /= numpy.linalg.norm(directions, axis=1, keepdims=True)
    turn = 2 * numpy.pi * line
    circle = middle.copy()
    circle[:, :2] += 0.4 * numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])[:, :d]
    axis = middle.copy()
    axis[:, 0] = line
    cross = middle.copy()
    for k in range(d):
        cross[k::d, k] = line[k::d]
    centers = rng.random((10, d))
    side = int(numpy.ceil(n ** (1 / d)))
    return {
        "random": random,
        "same": numpy.tile(centers[0], (n, 1)),
        "two": centers[index % 2],
        "circle": circle,
        "sphere": 0.5 + 0.4 * directions,
        "diagonal": numpy.tile(line[:, None], (1, d)),
        "axis": axis,
        "cross": cross,
        "clusters": (centers[index % 10] + 1e-6 * rng.normal(size=(n, d))) % 1,
        "spread": 0.5 + 0.5 * 2.0 ** -rng.uniform(1, 50, (n, 1)) * directions,
        "repeated": random[index // 100],
        "lattice": numpy.column_stack([(index // side**k % side + 0.5) / side for k in range(d)]),
    }


def measure(program, analyzer, path, limit):
    """Processor seconds and MB of one run; None after the limit, or the exit code if it failed."""

    def limit_time():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))

    command = [program, "analyze", analyzer, path, "--threads", "1", *OPTIONS.get(analyzer, [])]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=limit_time)
    error = process.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(process.pid, 0)
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) in (signal.SIGXCPU, signal.SIGKILL):
        return None
    code = os.waitstatus_to_exitcode(status)
    return (usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, code, error.strip())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("analyzers", nargs="*")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--dimension", type=int, default=2)
    parser.add_argument("--limit", type=int, default=60)
    given = parser.parse_intermixed_args()
    names = given.analyzers or [
        unit["name"]
        for unit in json.loads(
            subprocess.run([given.program, "list", "analyzers", "--json"], capture_output=True, check=True).stdout
        )["analyzers"]
    ]
    slow = 0
    with tempfile.TemporaryDirectory() as folder:
        sets = arrangements(given.count, given.dimension)
        for name, points in sets.items():
            numpy.save(os.path.join(folder, name + ".npy"), points)
        print(f"{'analyzer':<18}{'s':>7}{'MB':>7}  " + "".join(f"{name:>10}" for name in list(sets)[1:]))
        for analyzer in names:
            base = measure(given.program, analyzer, os.path.join(folder, "random.npy"), given.limit)
            if base is None or base[2] != 0:
                print(f"{analyzer:<18} random points: {'over' if base is None else base[3]}")
                continue
            row = f"{analyzer:<18}{base[0]:>7.2f}{base[1]:>7.0f}  "
            for name in list(sets)[1:]:
                run = measure(given.program, analyzer, os.path.join(folder, name + ".npy"), given.limit)
                if run is None:
                    row += f"{'over*':>10}"
                    slow += 1
                elif run[2] not in (0, 1):
                    row += f"{'exit ' + str(run[2]):>10}"
                else:
                    times = max(run[0], SHORTEST) / max(base[0], SHORTEST)
                    much = times > 10 or run[1] > 10 * base[1]
                    slow += much
                    row += f"{times:>9.1f}" + ("*" if much else " ")
            print(row, flush=True)
    sys.exit(1 if slow else 0)


if __name__ == "__main__":
    main()
