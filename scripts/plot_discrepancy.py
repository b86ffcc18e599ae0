#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws discrepancy against the number of points, log-log, a curve for each generator.

Reads reports of `stipple analyze` (JSON, also many end to end, or CSV). A curve's name is the part
of the measured file's name before the number: halton_1024.csv belongs to 'halton'. Several values
at one n are drawn as their mean with its standard error.
"""

import re

import numpy as np

import stipple_io as io

EXAMPLES = """\
  for n in 64 256 1024 4096; do stipple generate halton -n $n -o halton_$n.csv; done
  stipple analyze star-discrepancy halton_*.csv | plot_discrepancy.py -o discrepancy.png
  plot_discrepancy.py halton.json random.json --label Halton --label random -o discrepancy.svg
"""

NAMES = {
    "star-discrepancy": ("Star discrepancy", "star discrepancy D*"),
    "l2-discrepancy": ("L2 discrepancy", "L2 discrepancy"),
}
NAMELESS = "standard input"
# What ends a file's stem and is not the generator: _1024, -n1024, _2^10, _64k, _s3, _seed7, _set0.
SUFFIX = re.compile(r"(?:[_.-](?:n|s|seed|set)?\d+(?:\^\d+)?[kM]?)+$")


def arguments():
    parser = io.Parser(__doc__, EXAMPLES, inputs="*")
    parser.add_argument(
        "--label",
        metavar="NAME",
        action="append",
        help="name of a curve; once, or once for each FILE (default: from the measured files)",
    )
    parser.add_argument("--key", help="which result (default: value, else the first KIND.value)")
    return checked(parser.parse_args())


def checked(options):
    """The options, if there are as many labels as files or one, and one standard input."""
    if options.label and len(options.label) not in (1, len(options.input)):
        labels, files = len(options.label), len(options.input)
        raise io.usage_error(f"--label: {labels} for {files} files; give one, or one for each")
    if options.input.count("-") > 1:
        raise io.usage_error("'-': standard input can be read only once")
    return options


def label_of(source):
    """'halton' from 'sets/halton_1024.csv'; of a mean over files, from the first."""
    if source == "-":
        return NAMELESS
    stem = source.partition(", ")[0].rpartition("/")[2]
    stem = re.sub(r"\.[A-Za-z]\w*$", "", stem)
    return SUFFIX.sub("", stem) or stem


def read_all(options, analyzer=None):
    """Pairs of a label and a report, in the order of the files; of studies, only that analyzer's."""
    pairs = []
    for k, path in enumerate(options.input):
        labels = options.label or []
        given = labels[min(k, len(labels) - 1)] if labels else None
        for report in io.read_reports(path):
            label = given or (report.source if report.study else label_of(report.source))
            if analyzer is None or not report.study or report.analyzer == analyzer:
                pairs.append((label, report))
    if not pairs:
        raise io.input_error(f"{io.name_of(options.input[0])}: the study does not measure {analyzer}")
    analyzers = list(dict.fromkeys(report.analyzer for _, report in pairs))
    if len(analyzers) > 1:
        raise io.input_error(f"reports of {' and '.join(analyzers)}; expected one analyzer's")
    return pairs


def key_for(report):
    """The key to draw, where none is given."""
    if report.value("value") is not None:
        return "value"
    for kind in report.results:
        key = kind if kind.endswith(".value") else f"{kind}.value"
        if report.value(key) is not None:
            return key
    raise io.input_error(f"{io.name_of(report.file)}: has no 'value'; name one with --key")


def curves_of(pairs, key):
    """label -> (n, mean, standard error), by n; the error is 0 where there is but one value."""
    values = {}
    for label, report in pairs:
        value = report.value(key)
        where = f"{io.name_of(report.file)}: {report.source}, n = {report.count}"
        if value is None:
            raise io.input_error(f"{where}: has no number '{key}'")
        if value <= 0 or report.count < 1:
            raise io.input_error(f"{where}: {key} is {value:g}; expected more than 0")
        error = report.value(key, errors=True) or 0.0
        values.setdefault(label, {}).setdefault(report.count, []).append((value, error))
    return {label: curve_of(by_count) for label, by_count in values.items()}


def curve_of(by_count):
    counts = sorted(by_count)
    means, errors = [], []
    for n in counts:
        found = np.array(by_count[n])
        means.append(found[:, 0].mean())
        several = len(found) > 1
        errors.append(found[:, 0].std(ddof=1) / np.sqrt(len(found)) if several else found[0, 1])
    return np.array(counts, dtype=float), np.array(means), np.array(errors)


# ---------------------------------------------------------------- drawing


def draw_slopes(axes, curves):
    """n^-1/2 above all data and n^-1 below, as far as the data go."""
    counts = np.concatenate([n for n, _, _ in curves.values()])
    values = np.concatenate([mean for _, mean, _ in curves.values()])
    span = np.array([counts.min(), counts.max()])
    if span[0] == span[1]:
        span = span * [0.5, 2]
    for power, factor, word in ((-0.5, 1.3, r"$n^{-1/2}$"), (-1, 1 / 1.3, r"$n^{-1}$")):
        edge = np.max if power == -0.5 else np.min
        line = factor * edge(values / counts**power) * span**power
        axes.plot(span, line, color=io.GREY, linewidth=0.9, linestyle=(0, (5, 3)), zorder=1)
        axes.annotate(
            word,
            (span[1], line[1]),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            color=io.GREY,
        )


def scale_counts(plt, axes, counts):
    """A logarithmic axis; where all counts are powers of two, its ticks are some of them."""
    counts = np.unique(counts)
    if not all(n == 2 ** round(np.log2(n)) for n in counts):
        axes.set_xscale("log")
        return
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_locator(plt.FixedLocator(counts[:: -(-len(counts) // 8)]))
    axes.xaxis.set_minor_locator(plt.NullLocator())
    if counts.max() < 1e5:
        axes.xaxis.set_major_formatter(lambda n, _: f"{n:g}")


def draw(curves, ylabel):
    plt = io.canvas()
    figure, axes = plt.subplots(figsize=(4.8, 3.8))
    axes.set_yscale("log")
    scale_counts(plt, axes, np.concatenate([n for n, _, _ in curves.values()]))
    by_size = sorted(curves, key=lambda label: -curves[label][1][-1])
    for k, label in enumerate(curves):
        n, mean, error = curves[label]
        axes.errorbar(
            n,
            mean,
            yerr=error if error.any() else None,
            color=io.COLOURS[k % len(io.COLOURS)],
            marker=io.MARKERS[k % len(io.MARKERS)],
            linestyle="-" if k < len(io.COLOURS) else ":",
            markersize=4.5,
            capsize=2,
            elinewidth=0.9,
            label=io.plain(label),
        )
    draw_slopes(axes, curves)
    axes.set_xlabel("number of points n")
    axes.set_ylabel(ylabel)
    axes.grid(True, which="major", color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    barred = any(error.any() for _, _, error in curves.values())
    handles = dict(zip(curves, axes.get_legend_handles_labels()[0]))
    axes.legend(
        [handles[label] for label in by_size],
        [io.plain(label) for label in by_size],
        title="mean ± standard error" if barred else None,
        title_fontsize=8.5,
    )
    return figure, axes


def main():
    options = arguments()
    target, kind = io.target_of(options, options.input[0] if len(options.input) == 1 else None)
    pairs = read_all(options)
    key = options.key or key_for(pairs[0][1])
    curves = curves_of(pairs, key)
    words, name = NAMES.get(pairs[0][1].analyzer, [io.plain(pairs[0][1].analyzer)] * 2)
    what = "" if key == "value" else f", {io.plain(key.removesuffix('.value'))}"
    figure, axes = draw(curves, name + what)
    # A single curve is named in the title; the name of standard input says nothing.
    label = next(iter(curves))
    of = f" of {io.plain(label)}" if len(curves) == 1 and label != NAMELESS else ""
    axes.set_title(words + what + of if options.title is None else io.plain(options.title))
    io.write_bytes(target, io.render(figure, kind))


if __name__ == "__main__":
    io.run(main)
