#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws data/blue_noise.png: every blue-noise generator, with the program on the PATH.

For each the points of one set, the power spectrum, which is the mean of several larger sets, and
its radial mean. Grey is P / (1 + P): white noise is middle grey. A spectrum reaches up to the
frequency 3/2 sqrt(n) on each axis.
"""

import json
import tempfile
from pathlib import Path

import numpy as np

import stipple_io as io
from overview import stipple

EXAMPLES = """\
  PATH=build/release/src:$PATH scripts/plot_blue_noise.py
  scripts/plot_blue_noise.py lloyd 'lloyd --iterations 500' -o lloyd.png
"""

IN_A_ROW = 5
DOTS_PER_INCH = 100
GREYS = 24  # noise is large in a file: few shades do
GAP, TITLE, CURVE = 0.12, 0.3, 0.5  # inches


def arguments():
    parser = io.Parser(__doc__, EXAMPLES, inputs=None, default="data/blue_noise.png")
    parser.add_argument(
        "generators", nargs="*", metavar="GENERATOR", help="with options (default: all)"
    )
    parser.add_argument("--count", type=int, default=1024, metavar="N", help="points to draw")
    parser.add_argument(
        "--spectrum-count", type=int, default=4096, metavar="N", help="points of a spectrum's sets"
    )
    parser.add_argument("--sets", type=int, default=10, metavar="R", help="sets of a spectrum")
    parser.set_defaults(output=str(Path(__file__).resolve().parent.parent / "data/blue_noise.png"))
    return parser.parse_args()


def registered(folder):
    """Those of BLUE_NOISE that the program has."""
    listed = json.loads(stipple(folder, "list", "generators", "--json"))["generators"]
    known = {unit["name"] for unit in listed}
    return [name for name in io.BLUE_NOISE if name in known]


def measure(folder, name, options, frequency):
    """Points, 2-D power and radial power of a generator."""
    make = ("generate", *name.split())
    stipple(folder, *make, "-n", str(options.count), "-o", "points.npy")
    sets = ("-n", str(options.spectrum_count), "-m", str(options.sets))
    stipple(folder, *make, *sets, "-o", "sets.npy")
    judge = ("--average", "--max-frequency", str(frequency), "--grid", "power.npy")
    report = json.loads(stipple(folder, "analyze", "periodogram", "sets.npy", *judge))
    points, power = (np.load(Path(folder) / file) for file in ("points.npy", "power.npy"))
    return points, power, report["results"]["radial"]


# ---------------------------------------------------------------- drawing


def draw_points(axes, points, name):
    axes.scatter(*points.T, s=2200 / len(points), linewidths=0, color="black")
    axes.set_xlim(0, 1)
    axes.set_ylim(0, 1)
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(True)
        spine.set_color("0.7")
    axes.set_title(io.plain(name), fontsize=9, pad=3)


def draw_spectrum(axes, power):
    middle = len(power) // 2
    power[middle, middle] = 0  # f = 0 has n, and tells nothing
    grey = np.round(power / (1 + power) * (GREYS - 1)) / (GREYS - 1)
    axes.imshow(grey, cmap="gray", vmin=0, vmax=1, origin="lower", interpolation="nearest")
    axes.set_axis_off()


def draw_radial(axes, radial):
    axes.axhline(1, color=io.GREY, linewidth=0.7, linestyle=(0, (5, 3)))
    axes.plot(radial["frequency"], radial["power"], color=io.COLOURS[0], linewidth=0.9)
    axes.set_xlim(0, radial["frequency"][-1])
    axes.set_ylim(0, 5)
    axes.set_xticks([])
    axes.set_yticks([0, 1, 5], labels=["", "", ""])
    axes.tick_params(length=2)


def draw(measured, side):
    """A column of three panels for each; the side of a panel, in inches, is a pixel a frequency."""
    plt = io.canvas()
    across = min(IN_A_ROW, len(measured))
    down = -(-len(measured) // across)
    block = TITLE + 2 * side + CURVE + 2 * GAP
    width, height = across * (side + GAP), down * block
    figure = plt.figure(figsize=(width, height))
    for at, (name, (points, power, radial)) in enumerate(measured.items()):
        left = (at % across) * (side + GAP)
        top = height - (at // across) * block - TITLE

        def panel(below, tall):
            place = (left / width, (top - below - tall) / height, side / width, tall / height)
            return figure.add_axes(place)

        draw_points(panel(0, side), points, name)
        draw_spectrum(panel(side + GAP / 2, side), power)
        draw_radial(panel(2 * side + GAP, CURVE), radial)
    return figure


def main():
    options = arguments()
    for word in ("count", "spectrum_count", "sets"):
        if getattr(options, word) < 1:
            raise io.usage_error(f"--{word.replace('_', '-')}: {getattr(options, word)} is below 1")
    target, kind = io.target_of(options, None)
    frequency = max(16, round(1.5 * options.spectrum_count**0.5))
    with tempfile.TemporaryDirectory() as folder:
        names = options.generators or registered(folder)
        measured = {name: measure(folder, name, options, frequency) for name in names}
    side = max(1.9, (2 * frequency + 1) / DOTS_PER_INCH)
    io.write_bytes(target, io.render(draw(measured, side), kind, DOTS_PER_INCH))


if __name__ == "__main__":
    io.run(main)
