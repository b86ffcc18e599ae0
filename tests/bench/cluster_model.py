#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Cost of an analysis or a study on many machines: the model behind `stipple help cluster`.

    time(K) = start + counting in + handing over
    counting in   = ceil(grains / K) * grain * cost of a point       (the slowest rank's share)
    handing over  = ceil(log2 K) * (latency + state / bandwidth + state * cost of adding a byte)
    efficiency    = time(1) / (K * time(K))

The cost per point is measured on one core of this machine with --measure; otherwise it is from the
table below, for one core at 2.1 to 3.5 GHz. Points in files add the time for reading: bytes over
the file system's bandwidth, which all ranks share.

    cluster_model.py [--points 1e12] [--ranks 1024] [--measure [STIPPLE]]
"""
import argparse
import json
import math
import subprocess
import time

LATENCY = 5e-6  # seconds a message
BANDWIDTH = 2e9  # bytes a second between two ranks
ADDING = 0.5e-9  # seconds a byte that is added to what a rank has
START = 3.0  # seconds until 1024 processes have found each other
FILES = 100e9  # bytes a second that the file system gives all ranks

BATCH = 1 << 17  # points in the plane that an accumulator is given at a time

# analyzer: options; seconds per generated point; points per grain; bytes that a rank sends
MEASURED = {"chi-square": 31e-9, "moments": 30e-9, "periodogram": 100e-9}


def grid_side(max_frequency):
    """Cells per side of the periodogram's grid: about twice the frequencies -F..F."""
    return 1 << math.ceil(math.log2(4 * max_frequency))


def analyses(points):
    cells = 2 * min(points, 2**28) ** 0.4
    levels = math.log2(max(points / BATCH, 2))
    side = grid_side(1024)
    grain = min(max(2 ** math.ceil(math.log2(side * side)), 2**21), 2**26)
    return {
        "chi-square": (BATCH, 8 * cells, 8 * cells + 16 * 2 * BATCH),
        # Sums and their carries of 6 powers of 2 axes and 4 products, of the points and of the
        # cube, for each binary place of the number of batches.
        "moments": (BATCH, 2 * 2 * 8 * 16 * levels, 2 * 2 * 8 * 16 * levels + 16 * 2 * BATCH),
        "periodogram": (grain, 16 * side * side, (8 + 16 + 16) * side * side + 2 * 16 * (1 << 22)),
    }


def measure(program):
    found = {}
    for name in MEASURED:
        points = 20_000_000
        call = [program, "analyze", name, "--generate", "random", "-n", str(points), "--threads", "1"]
        began = time.process_time(), time.monotonic()
        subprocess.run(call, check=True, stdout=subprocess.DEVNULL)
        found[name] = (time.monotonic() - began[1]) / points
    return found


def model(points, ranks, seconds_of):
    rows = []
    for name, (grain, state, memory) in analyses(points).items():
        grains = math.ceil(points / grain)
        one = points * seconds_of[name]
        count = math.ceil(grains / ranks) * grain * seconds_of[name]
        steps = math.ceil(math.log2(ranks)) if ranks > 1 else 0
        merge = steps * (LATENCY + state / BANDWIDTH + state * ADDING)
        total = count + merge + (START if ranks > 1 else 0)
        files = max(count, 16 * points / FILES) + merge + START
        rows.append({
            "analyzer": name,
            "one_core_hours": one / 3600,
            "seconds": total,
            "merge_seconds": merge,
            "efficiency": one / (ranks * total),
            "efficiency_without_start": one / (ranks * (count + merge)),
            "seconds_from_npy_files": files,
            "bytes_sent_a_rank": state,
            "bytes_into_rank_0": steps * state,
            "memory_a_rank": memory,
        })
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=float, default=1e12)
    parser.add_argument("--ranks", type=int, default=1024)
    parser.add_argument("--measure", nargs="?", const="stipple", metavar="STIPPLE")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    seconds_of = measure(arguments.measure) if arguments.measure else MEASURED
    rows = model(int(arguments.points), arguments.ranks, seconds_of)
    if arguments.json:
        print(json.dumps(rows, indent=2))
        return
    print(f"{arguments.points:g} points in the plane, made by 'random', on {arguments.ranks} ranks")
    print(f"{'analyzer':<12} {'1 core':>8} {'seconds':>8} {'merge':>8} {'effic.':>7} {'sent':>9} "
          f"{'memory':>9} {'from npy':>9}")
    for row in rows:
        print(f"{row['analyzer']:<12} {row['one_core_hours']:6.1f} h {row['seconds']:8.1f} "
              f"{row['merge_seconds']:8.3f} {100 * row['efficiency']:6.1f}% "
              f"{row['bytes_sent_a_rank'] / 2**20:5.2f} MiB {row['memory_a_rank'] / 2**20:5.0f} MiB "
              f"{row['seconds_from_npy_files']:7.0f} s")


if __name__ == "__main__":
    main()
