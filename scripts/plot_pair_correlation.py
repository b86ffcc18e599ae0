#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws pair correlation: the density of pairs over their distance, one curve a report.

Reads reports of `stipple analyze pair-correlation` (JSON or CSV). The dashed line is what independent
points have: 1. Bands are standard errors of a mean over several sets.
"""

import numpy as np

import stipple_io as io

EXAMPLES = """\
  stipple generate poisson-disk -n 4096 | stipple analyze pair-correlation |
      plot_pair_correlation.py -o g.png
  plot_pair_correlation.py jittered.json poisson.json -o g.pdf
"""

DASHES = (0, (5, 3))


def arguments():
    parser = io.Parser(__doc__, EXAMPLES, inputs="*")
    parser.add_argument("--max-distance", type=float, metavar="X", help="of the axis, from 0")
    options = parser.parse_args()
    if options.max_distance is not None and not options.max_distance > 0:
        raise io.usage_error(f"--max-distance: {options.max_distance} is not above 0")
    return options


def curves(report, name):
    """Distance, density, and the density's standard error where there is one."""
    if report.analyzer != "pair-correlation":
        raise io.input_error(
            f"{name}: is of {report.analyzer}; expected a report of pair-correlation"
        )
    distance, density = report.curve("distance"), report.curve("density")
    if distance is None or density is None or len(distance) != len(density) or not len(distance):
        raise io.input_error(f"{name}: has no whole curves distance and density")
    error = report.curve("density", errors=True)
    return distance, density, error if error is not None and len(error) == len(density) else None


def label_of(report):
    """'halton.csv, set 3' or 'halton.csv, mean of 10 sets'."""
    name = "standard input" if report.source == "-" else report.source.rpartition("/")[2]
    if report.number is not None:
        name += f", set {report.number}"
    return name + (f", mean of {report.sets} sets" if report.sets > 1 else "")


def draw(reports, reach):
    plt = io.canvas()
    figure = plt.figure(figsize=(5.6, 3.6), layout="constrained")
    axes = figure.subplots()
    axes.axhline(1, color=io.GREY, linestyle=DASHES, linewidth=0.9, label="independent points")
    for k, (report, (distance, density, error)) in enumerate(reports):
        colour = io.COLOURS[k % len(io.COLOURS)]
        if error is not None:
            axes.fill_between(
                distance, density - error, density + error, color=colour, alpha=0.25, linewidth=0
            )
        axes.plot(distance, density, color=colour, label=io.plain(label_of(report)))
    longest = max(np.nanmax(distance) for _, (distance, _, _) in reports)
    axes.set_xlim(0, reach or longest)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("distance")
    axes.set_ylabel("pair correlation")
    axes.legend(loc="best", handlelength=2.0)
    return figure


def main():
    options = arguments()
    target, kind = io.target_of(options, options.input[0])
    reports = []
    for path in options.input:
        for report in io.read_reports(path):
            reports.append((report, curves(report, io.name_of(path))))
    figure = draw(reports, options.max_distance)
    title = "Pair correlation" if options.title is None else options.title
    figure.suptitle(io.plain(title), fontsize=10)
    io.write_bytes(target, io.render(figure, kind))


if __name__ == "__main__":
    io.run(main)
