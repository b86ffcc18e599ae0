#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws a power spectrum: radial power, anisotropy and, with --grid, the power in the plane.

Reads the report of `stipple analyze periodogram` (JSON or CSV). Dashed lines are what white noise
has: power 1, and anisotropy -10 log10(sets) dB for a mean of so many sets. The grey band holds 95 %
of the ring means of white noise.
"""

import numpy as np

import stipple_io as io

EXAMPLES = """\
  stipple generate halton -n 4096 | stipple analyze periodogram | plot_spectrum.py -o halton.png
  stipple generate poisson-disk -n 4096 -m 10 |
      stipple analyze periodogram --average --grid power.npy -o spectrum.json
  plot_spectrum.py spectrum.json --grid power.npy -o spectrum.pdf
"""

LOG_ABOVE = 12  # radial power; a higher peak gets a logarithmic axis
LOG_FLOOR = 1e-4  # of that axis: what is lower, as between a grid's peaks, is rounding
EQUAL_POWERS = -100  # dB of a ring of equal powers
DASHES = (0, (5, 3))


def arguments():
    parser = io.Parser(__doc__, EXAMPLES)
    parser.add_argument("--grid", metavar="FILE.npy", help="2-D power, from the analyzer's --grid")
    parser.add_argument(
        "--sets", type=int, metavar="R", help="sets averaged (default: what the report says)"
    )
    parser.add_argument("--set", type=int, metavar="K", help="which of several reports, from 0")
    return parser.parse_args()


def chosen_report(options):
    """The one report to draw."""
    reports = io.read_reports(options.input)
    name = io.name_of(options.input)
    if options.set is not None and not 0 <= options.set < len(reports):
        raise io.usage_error(f"--set: {options.set} is outside 0..{len(reports) - 1}")
    if options.set is None and len(reports) > 1:
        raise io.input_error(
            f"{name}: holds {len(reports)} reports; analyze with --average, or pick one by --set"
        )
    report = reports[options.set or 0]
    if report.analyzer != "periodogram":
        raise io.input_error(f"{name}: is of {report.analyzer}; expected a report of periodogram")
    return report


def curves(report, name):
    """Frequency, power, anisotropy and cells of the rings."""
    keys = ("frequency", "power", "anisotropy_db", "cells")
    found = [report.curve(f"radial.{key}") for key in keys]
    for key, curve in zip(keys, found):
        if curve is None or len(curve) == 0 or len(curve) != len(found[0]):
            raise io.input_error(f"{name}: has no whole curve radial.{key}")
    if not (np.isfinite(found[0]).all() and np.isfinite(found[1]).any()):
        raise io.input_error(f"{name}: has gaps in radial.frequency or no radial.power")
    return found


def read_grid(path):
    """The 2-D power, without f = 0, and its largest frequency."""
    power = io.read_npy(io.read_bytes(path), io.name_of(path))
    if power.ndim != 2 or power.shape[0] != power.shape[1] or power.shape[0] % 2 == 0:
        raise io.input_error(f"{path}: has shape {power.shape}; expected (2F + 1, 2F + 1)")
    if not np.isfinite(power).all() or power.min() < 0:
        raise io.input_error(f"{path}: holds a power that is negative or not finite")
    last = power.shape[0] // 2
    power[last, last] = np.nan
    return power, last


def white_noise_band(cells, sets):
    """2.5 and 97.5 % points of the mean power of a ring.

    Half of a ring's frequencies are free (P(-f) = P(f)) and each power is nearly exponential, so
    the mean is chi-square with as many degrees of freedom as cells x sets, over that number; points
    by Wilson and Hilferty's cube (1931).
    """
    spread = 2 / (9 * np.maximum(cells * sets, 1))
    return [(1 - spread + z * np.sqrt(spread)).clip(0) ** 3 for z in (-1.96, 1.96)]


def title_of(report, sets):
    """'Power spectrum of halton.csv, n = 1024, mean of 10 sets'."""
    source = "" if report.source == "-" else f" of {report.source.rpartition('/')[2]}"
    mean = f", mean of {sets} sets" if sets > 1 else ""
    which = f", set {report.number}" if report.number is not None else ""
    return f"Power spectrum{source}, n = {report.count}{mean}{which}"


# ---------------------------------------------------------------- drawing


def draw_grid(plt, figure, axes, power, last):
    """Grey is P / (1 + P), so white noise is middle grey and no peak is cut off."""
    edge = last + 0.5
    image = axes.imshow(
        np.ma.masked_invalid(power / (1 + power)),
        cmap=plt.get_cmap("gray").with_extremes(bad="black"),
        vmin=0,
        vmax=1,
        origin="lower",
        extent=(-edge, edge, -edge, edge),
        interpolation="nearest" if last < 300 else "antialiased",
    )
    axes.set_xlabel("frequency $f_x$")
    axes.set_ylabel("frequency $f_y$", labelpad=0)
    axes.xaxis.set_major_locator(plt.MaxNLocator(4, integer=True))
    axes.yaxis.set_major_locator(plt.MaxNLocator(4, integer=True))
    bar = figure.colorbar(image, cax=axes.inset_axes([1.04, 0, 0.045, 1]))
    bar.set_ticks([0, 0.2, 0.5, 0.8, 1], labels=["0", "1/4", "1", "4", "∞"])
    bar.ax.set_title("power", fontsize=9)
    bar.outline.set_visible(False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(True)


def draw_power(axes, frequency, power, cells, sets, error):
    low, high = white_noise_band(cells, sets)
    axes.fill_between(frequency, low, high, color="0.88", linewidth=0, label="white noise, 95 %")
    axes.axhline(1, color=io.GREY, linestyle=DASHES, linewidth=0.9)
    axes.plot(frequency, power, color=io.COLOURS[0], label="mean over the ring")
    if error is not None and len(error) == len(power):
        axes.fill_between(
            frequency,
            power - error,
            power + error,
            color=io.COLOURS[5],
            alpha=0.6,
            linewidth=0,
            label="± standard error",
        )
    top = np.nanmax(power)
    if top > LOG_ABOVE:
        axes.set_yscale("log", nonpositive="clip")
        axes.set_ylim(max(0.7 * np.nanmin(power), LOG_FLOOR), 1.5 * top)
    else:
        axes.set_ylim(0, max(2, 1.3 * top))
    axes.set_ylabel("radial power")
    axes.legend(loc="best", handlelength=1.4, labelspacing=0.25)


def has_directions(anisotropy):
    """Whether some ring's powers differ: on a line they cannot, for f and -f have the same."""
    return np.nanmax(anisotropy, initial=EQUAL_POWERS) > EQUAL_POWERS


def draw_anisotropy(axes, frequency, anisotropy, sets):
    expected = -10 * np.log10(sets) + 0.0
    word = f"white noise: {expected:.3g} dB".replace("-", "\u2212")
    axes.axhline(expected, color=io.GREY, linestyle=DASHES, linewidth=0.9, label=word)
    axes.plot(frequency, anisotropy, color=io.COLOURS[1])
    # It must not flatten all others.
    usual = np.nanpercentile(anisotropy, [5, 100]) if np.isfinite(anisotropy).any() else [0, 0]
    axes.set_ylim(min(expected, usual[0]) - 5, max(expected, usual[1]) + 5)
    axes.set_ylabel("anisotropy [dB]")
    axes.legend(loc="best", handlelength=2.4)


def draw(report, rings, grid, sets):
    plt = io.canvas()
    frequency, power, anisotropy, cells = rings
    panels = 2 if has_directions(anisotropy) else 1
    if grid is None:
        figure = part = plt.figure(figsize=(4.8, 2.1 * panels), layout="constrained")
    else:
        figure = plt.figure(figsize=(7.8, 3.5), layout="constrained")
        left, part = figure.subfigures(1, 2, width_ratios=(1, 1.05))
        draw_grid(plt, left, left.subplots(), *grid)
    axes = part.subplots(panels, 1, sharex=True, squeeze=False)[:, 0]
    draw_power(axes[0], frequency, power, cells, sets, report.curve("radial.power", errors=True))
    if panels == 2:
        draw_anisotropy(axes[1], frequency, anisotropy, sets)
    axes[-1].set_xlabel("frequency |f| [cycles per unit length]")
    axes[-1].set_xlim(0, frequency[-1] + 0.5)
    return figure


def main():
    options = arguments()
    target, kind = io.target_of(options, options.input)
    if options.sets is not None and options.sets < 1:
        raise io.usage_error(f"--sets: {options.sets} is below 1")
    if options.grid == "-" and options.input == "-":
        raise io.usage_error("--grid: standard input is the report already")
    report = chosen_report(options)
    rings = curves(report, io.name_of(options.input))
    grid = read_grid(options.grid) if options.grid else None
    sets = options.sets or report.sets
    figure = draw(report, rings, grid, sets)
    title = title_of(report, sets) if options.title is None else options.title
    figure.suptitle(io.plain(title), fontsize=10)
    io.write_bytes(target, io.render(figure, kind))


if __name__ == "__main__":
    io.run(main)
