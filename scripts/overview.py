#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws data/overview.png: what stipple does, in one row, with the program on the PATH.

Halton points, the same points on a disk, their power spectrum and its radial mean; below, what the
analyzers say about them.
"""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import stipple_io as io

EXAMPLES = """\
  PATH=build/release/src:$PATH scripts/overview.py
  scripts/overview.py -o overview.pdf
"""

COUNT = 1024
FREQUENCY = 46  # 93 cells a side are three pixels each
DOTS_PER_INCH = 140


def stipple(folder, *words):
    """What the program prints; its own message is passed on when it fails."""
    try:
        done = subprocess.run(["stipple", *words], cwd=folder, capture_output=True, text=True)
    except OSError as error:
        raise io.file_error(f"stipple: {error.strerror}; put its folder on the PATH") from None
    if done.returncode != 0:
        raise io.file_error(f"'stipple {' '.join(words)}' failed: {done.stderr}")
    return done.stdout


def measure(folder):
    """Points, points on the disk, 2-D power, and the three reports."""
    stipple(folder, "generate", "halton", "-n", str(COUNT), "--start", "1", "-o", "halton.npy")
    stipple(folder, "warp", "disk", "halton.npy", "-o", "disk.npy")
    star = stipple(folder, "analyze", "star-discrepancy", "halton.npy")
    grid = ("--max-frequency", str(FREQUENCY), "--grid", "power.npy")
    spectrum = stipple(folder, "analyze", "periodogram", "halton.npy", *grid)
    chi = stipple(folder, "analyze", "chi-square", "disk.npy", "--domain", "disk")
    arrays = [np.load(Path(folder) / name) for name in ("halton.npy", "disk.npy", "power.npy")]
    return *arrays, *(json.loads(text)["results"] for text in (star, spectrum, chi))


def sentence(star, chi):
    how = "exact" if star["exact"] else f"within {star['lower']:.6g} and {star['upper']:.6g}"
    meaning = {
        "stratified": "stratified, more even than random",
        "uniform": "uniform",
        "non-uniform": "not uniform",
    }[chi["verdict"]]
    return (
        f"star discrepancy {star['value']:.6f} ({how})     •     "
        f"chi-square on the disk {chi['statistic']:.1f} with {chi['degrees_of_freedom']:.0f} "
        f"degrees of freedom, p = {chi['p_value']:.1g}: {meaning}"
    )


def draw_points(axes, points, frame, title):
    axes.plot(*frame, color=io.GREY, linewidth=0.8, clip_on=False)
    axes.scatter(*points.T, s=2.6, linewidths=0, color=io.COLOURS[0], clip_on=False)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0)
    axes.set_title(title)


def draw(halton, disk, power, star, spectrum, chi):
    plt = io.canvas()
    width, height, side = 10.4, 2.9, 2.0  # inches
    figure = plt.figure(figsize=(width, height))

    def panel(left, wide=side):
        return figure.add_axes((left / width, 0.62 / height, wide / width, side / height))

    turn = np.linspace(0, 2 * np.pi, 361)
    square = ([0, 1, 1, 0, 0], [0, 0, 1, 1, 0])
    draw_points(panel(0.1), halton, square, f"{COUNT} Halton points")
    draw_points(panel(2.4), disk, (np.cos(turn), np.sin(turn)), "the same on a disk")
    draw_spectrum(panel(4.7), power)
    draw_radial(panel(7.2, 3.1), spectrum["radial"])
    figure.text(0.5, 0.02, sentence(star, chi), ha="center", fontsize=9.5)
    return figure


def draw_spectrum(axes, power):
    power[FREQUENCY, FREQUENCY] = 0  # f = 0 has n, and tells nothing
    grey = power / (1 + power)
    axes.imshow(grey, cmap="gray", vmin=0, vmax=1, origin="lower", interpolation="nearest")
    axes.set_axis_off()
    axes.set_title("their power spectrum")


def draw_radial(axes, radial):
    axes.axhline(1, color=io.GREY, linewidth=0.9, linestyle=(0, (5, 3)))
    axes.plot(radial["frequency"], radial["power"], color=io.COLOURS[1])
    axes.text(1, 1.03, "white noise", color=io.GREY, fontsize=8)
    axes.set_xlim(0, FREQUENCY)
    axes.set_ylim(0)
    axes.set_title("and its radial mean")
    axes.set_xlabel("frequency", labelpad=1)


def arguments():
    parser = io.Parser(__doc__, EXAMPLES, inputs=None)
    parser.set_defaults(output=str(Path(__file__).resolve().parent.parent / "data/overview.png"))
    return parser.parse_args()


def main():
    options = arguments()
    target, kind = io.target_of(options, None)
    with tempfile.TemporaryDirectory() as folder:
        figure = draw(*measure(folder))
    io.write_bytes(target, io.render(figure, kind, DOTS_PER_INCH))


if __name__ == "__main__":
    io.run(main)
