#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the error of integrals against the number of points, log-log, a curve for each generator.

Reads reports of `stipple analyze integration` (JSON, also many end to end, or CSV), or the table of a
study (CSV). A curve's name is the generator of a study, or the part of the measured file's name
before the number: sobol_1024.csv belongs to 'sobol'. What
is drawn at n is the root mean square of the errors of all sets of n points. A curve's slope is that
of the straight line fitted to it by least squares, with its standard error. Its band holds the true
RMS error at each n with probability 0.95, where errors of sets are independent and normal.
"""

import numpy as np

import stipple_io as io
from plot_discrepancy import checked, read_all, scale_counts

EXAMPLES = """\
  for n in 64 256 1024 4096; do for g in random 'sobol --scramble owen'; do
    stipple generate $g -n $n -m 16 -o ${g%% *}_$n.npy; done; done
  stipple analyze integration --integrand zone-plate *_*.npy | plot_convergence.py -o error.png
  plot_convergence.py sobol.json random.json --label "Sobol'" --label random -o error.svg
"""

SURE = 0.95


def arguments():
    parser = io.Parser(__doc__.replace("%", "%%"), EXAMPLES, inputs="*")
    parser.add_argument(
        "--label",
        metavar="NAME",
        action="append",
        help="name of a curve; once, or once for each FILE (default: from the measured files)",
    )
    parser.add_argument(
        "--integrand", metavar="NAME", help="which integral (default: the only one, or the first)"
    )
    return checked(parser.parse_args())


def reports_of(options):
    """Pairs of a label and a report of integration, in the order of the files."""
    pairs = read_all(options, "integration")
    for _, report in pairs:
        if report.analyzer != "integration":
            name = io.name_of(report.file)
            raise io.input_error(f"{name}: reports {report.analyzer}; expected integration")
    return pairs


def integrands_of(report):
    """Names of integrals whose error is known; keys are nested in JSON, dotted in CSV."""
    names = dict.fromkeys(key.partition(".")[0] for key in report.results)
    return [name for name in names if report.value(f"{name}.error") is not None]


def mean_square(report, integrand):
    """The mean square error that a report tells, and over how many sets."""
    whole = report.value(f"{integrand}.rms_error")
    if whole is not None:
        return whole**2, report.sets
    error = report.value(f"{integrand}.error")
    if error is None:
        where = f"{io.name_of(report.file)}: {report.source}, n = {report.count}"
        raise io.input_error(f"{where}: has no error of '{integrand}'")
    return error**2, 1


def curves_of(pairs, integrand):
    """label -> (n, RMS error, sets), by n."""
    found = {}
    for label, report in pairs:
        found.setdefault(label, {}).setdefault(report.count, []).append(
            mean_square(report, integrand)
        )
    curves = {}
    for label, by_count in found.items():
        counts = sorted(by_count)
        tables = [np.array(by_count[n], dtype=float) for n in counts]
        sets = np.array([table[:, 1].sum() for table in tables])
        squares = np.array([(table[:, 0] * table[:, 1]).sum() for table in tables]) / sets
        curves[label] = np.array(counts, dtype=float), np.sqrt(squares), sets
    if not any((error > 0).any() for _, error, _ in curves.values()):
        raise io.input_error(f"'{integrand}': all errors are 0; there is nothing to draw")
    return curves


# ---------------------------------------------------------------- statistics


def band(error, sets):
    """Ends of the interval for the true RMS error: sets x error^2 / truth^2 is chi-square."""
    from scipy.stats import chi2

    low = error * np.sqrt(sets / chi2.ppf((1 + SURE) / 2, sets))
    return low, error * np.sqrt(sets / chi2.ppf((1 - SURE) / 2, sets))


def fit(n, error):
    """The line of log error against log n, and its slope in words with its standard error."""
    if len(n) < 2:
        return None, ""
    if len(n) == 2:
        line = np.polyfit(np.log(n), np.log(error), 1)
        return line, f", $n^{{{line[0]:.2f}}}$"
    line, covariance = np.polyfit(np.log(n), np.log(error), 1, cov="unscaled")
    rest = np.log(error) - np.polyval(line, np.log(n))
    wide = np.sqrt(covariance[0, 0] * (rest @ rest) / (len(n) - 2))
    return line, f", $n^{{{line[0]:.2f} \\pm {wide:.2f}}}$"


# ---------------------------------------------------------------- drawing


def draw_curve(axes, k, label, curve):
    n, error, sets = curve
    shown = error > 0
    n, error, sets = n[shown], error[shown], sets[shown]
    colour = io.COLOURS[k % len(io.COLOURS)]
    line, slope = fit(n, error)
    axes.plot(
        n,
        error,
        color=colour,
        marker=io.MARKERS[k % len(io.MARKERS)],
        linestyle="none",
        markersize=4.5,
        label=io.plain(label) + slope,
    )
    if line is not None:
        axes.plot(n, np.exp(np.polyval(line, np.log(n))), color=colour, linewidth=1)
    if (sets > 1).all():
        axes.fill_between(n, *band(error, sets), color=colour, alpha=0.15, linewidth=0)


def draw(curves, integrand):
    plt = io.canvas()
    figure, axes = plt.subplots(figsize=(4.8, 3.8))
    axes.set_yscale("log")
    scale_counts(plt, axes, np.concatenate([n for n, _, _ in curves.values()]))
    drawn = [label for label in curves if (curves[label][1] > 0).any()]
    for k, label in enumerate(drawn):
        draw_curve(axes, k, label, curves[label])
    sets = {int(m) for label in drawn for m in curves[label][2]}
    of_sets = f" of {min(sets)} sets" if len(sets) == 1 and min(sets) > 1 else ""
    axes.set_xlabel("number of points n")
    axes.set_ylabel(("RMS error" if max(sets) > 1 else "error") + of_sets)
    axes.grid(True, which="major", color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    handles, names = axes.get_legend_handles_labels()
    by_size = sorted(range(len(drawn)), key=lambda k: -curves[drawn[k]][1][-1])
    axes.legend([handles[k] for k in by_size], [names[k] for k in by_size])
    axes.set_title(f"Integration of {io.plain(integrand)}")
    return figure, axes


def main():
    options = arguments()
    target, kind = io.target_of(options, options.input[0] if len(options.input) == 1 else None)
    pairs = reports_of(options)
    known = integrands_of(pairs[0][1])
    if options.integrand is None and not known:
        raise io.input_error(f"{io.name_of(pairs[0][1].file)}: has no error of any integrand")
    integrand = options.integrand or known[0]
    figure, axes = draw(curves_of(pairs, integrand), integrand)
    if options.title is not None:
        axes.set_title(io.plain(options.title))
    io.write_bytes(target, io.render(figure, kind))


if __name__ == "__main__":
    io.run(main)
