#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws data/overview.png: what stipple does, in one row, with the program on the PATH.

Halton points, the same points on a disk, their power spectrum and its radial mean; below, what the
analyzers say about them.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import stipple_io as io

COUNT = 1024
FREQUENCY = 64
DOTS_PER_INCH = 140


def stipple(folder, *words):
    """What the program prints; its own message is passed on when it fails."""
    try:
        done = subprocess.run(["stipple", *words], cwd=folder, capture_output=True, text=True)
    except OSError as error:
        raise io.Refusal(io.IO, f"stipple: {error.strerror}; put its folder on the PATH") from None
    if done.returncode != 0:
        raise io.Refusal(io.IO, f"'stipple {' '.join(words)}' failed: {done.stderr}")
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
        f"star discrepancy  {star['value']:.6f} ({how})      "
        f"chi-square on the disk  {chi['statistic']:.1f} with {chi['degrees_of_freedom']:.0f} degrees of freedom, "
        f"p = {chi['p_value']:.1g}: {meaning}"
    )


def draw_points(axes, points, frame, title):
    axes.plot(*frame, color=io.GREY, linewidth=0.8, clip_on=False)
    axes.scatter(*points.T, s=2.6, linewidths=0, color=io.COLOURS[0], clip_on=False)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.01)
    axes.set_title(title)


def draw(halton, disk, power, star, spectrum, chi):
    plt = io.canvas()
    figure = plt.figure(figsize=(10.6, 2.95))
    panels = figure.subplots(
        1, 4, gridspec_kw={"width_ratios": (1, 1, 1, 1.25), "left": 0.01, "right": 0.99, "bottom": 0.23, "top": 0.89, "wspace": 0.14}
    )
    turn = np.linspace(0, 2 * np.pi, 361)
    draw_points(panels[0], halton, ([0, 1, 1, 0, 0], [0, 0, 1, 1, 0]), f"{COUNT} Halton points")
    draw_points(panels[1], disk, (np.cos(turn), np.sin(turn)), "on the disk")

    power[FREQUENCY, FREQUENCY] = 0
    edge = FREQUENCY + 0.5
    panels[2].imshow(power / (1 + power), cmap="gray", vmin=0, vmax=1, origin="lower", extent=(-edge, edge) * 2)
    panels[2].set_axis_off()
    panels[2].set_title("power spectrum")

    radial = spectrum["radial"]
    panels[3].axhline(1, color=io.GREY, linewidth=0.9, linestyle=(0, (5, 3)))
    panels[3].plot(radial["frequency"], radial["power"], color=io.COLOURS[1])
    panels[3].annotate("white noise", (2, 1), xytext=(0, 3), textcoords="offset points", color=io.GREY, fontsize=8)
    panels[3].set_xlim(0, FREQUENCY)
    panels[3].set_ylim(0)
    panels[3].set_title("radial power")
    panels[3].set_xlabel("frequency", labelpad=1)

    figure.text(0.5, 0.03, sentence(star, chi), ha="center", fontsize=9.5)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    default = Path(__file__).resolve().parent.parent / "data" / "overview.png"
    parser.add_argument("-o", "--output", default=str(default), help="a .png, .svg or .pdf file (default: data/overview.png)")
    options = parser.parse_args()
    target, kind = io.target_of(options, None)
    with tempfile.TemporaryDirectory() as folder:
        figure = draw(*measure(folder))
    figure.set_dpi(DOTS_PER_INCH)
    io.write_bytes(target, io.render(figure, kind))


if __name__ == "__main__":
    io.run(main)
