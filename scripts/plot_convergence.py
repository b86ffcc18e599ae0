#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the result of an analyzer over the number of points, log-log, a curve for each generator.

    PYTHONPATH=build/release/python scripts/plot_convergence.py -o star.svg star-discrepancy random halton
    ... -n 64 256 1024 4096 -m 16 -o error.png integration:integrand=zone-plate random sobol:scramble=owen

Curves are means over seeds with 95 % confidence intervals; for errors root mean squares, with
intervals that assume independent normal errors. The slope is that of a straight line fitted to
the curve by least squares.
"""

import argparse

import numpy as np
from scipy.stats import chi2

import figures
import stipple


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("analyzer")
    parser.add_argument("generators", nargs="+")
    parser.add_argument("-n", type=int, nargs="+", default=[16, 64, 256, 1024], help="numbers of points")
    parser.add_argument("-d", type=int, default=2, help="dimension")
    parser.add_argument("-m", "--seeds", type=int, default=5)
    parser.add_argument("--key", help="the result to draw (default: the first error or value)")
    parser.add_argument("-o", "--output", required=True, help="a .png, .svg or .pdf file")
    options = parser.parse_args()
    if not options.output.endswith(tuple(figures.METADATA)):
        parser.error(f"-o: '{options.output}' does not end in .png, .svg or .pdf")
    return parser, options


def size(mean):
    return mean.rms if mean.key.endswith("error") else mean.mean


def curve(means):
    """Numbers of points, their values, and the ends of the intervals."""
    n, mean, low, high, rms, sets = np.array(
        [(m.count, m.mean, m.low, m.high, m.rms, m.sets) for m in means], dtype=float).T
    if not means[0].key.endswith("error"):
        return n, mean, low, high
    # sets x rms^2 / truth^2 is chi-square.
    return n, rms, *(rms * np.sqrt(sets / chi2.ppf(p, sets)) for p in (0.975, 0.025))


def draw(axes, generators, means):
    for name, marker in zip(generators, "os^DvPX" * len(generators)):
        n, value, low, high = curve([m for m in means if m.generator == name])
        slope, start = np.polyfit(np.log(n), np.log(value), 1) if len(n) > 1 else (np.nan, np.nan)
        [points] = axes.plot(n, value, marker, markersize=4.5, label=f"{name}, $n^{{{slope:.2f}}}$")
        axes.plot(n, np.exp(start) * n**slope, color=points.get_color(), linewidth=1)
        axes.fill_between(n, np.maximum(low, value / 100), high, color=points.get_color(), alpha=0.15,
                          linewidth=0)
    axes.set(xscale="log", yscale="log", xlabel="number of points n")
    axes.grid(True, which="major", color="0.9", linewidth=0.6)
    axes.legend()


def main():
    parser, options = arguments()
    try:
        study = stipple.study(options.generators, options.analyzer, n=options.n, d=options.d,
                              seeds=options.seeds)
    except stipple.Error as error:
        parser.error(error)
    keys = list(dict.fromkeys(row.key for row in study if row.value is not None))
    key = options.key or next((k for k in keys if k.split(".")[-1] in ("error", "value")), keys[0])
    means = [mean for mean in study.means() if mean.key == key]
    if not means or not all(size(mean) > 0 for mean in means):
        parser.error(f"--key: no numbers above 0 are '{key}'; the results are {', '.join(keys)}")
    figure, axes = figures.plt.subplots(figsize=(4.8, 3.8))
    draw(axes, options.generators, means)
    axes.set_ylabel(("RMS " if key.endswith("error") else "") + key)
    axes.set_title(f"{options.analyzer} of {options.seeds} sets, {options.d}-D")
    figures.save(figure, options.output)


if __name__ == "__main__":
    main()
