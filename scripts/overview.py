#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws data/overview.png: the functions of stipple in one row.

    PYTHONPATH=build/release/python scripts/overview.py [PICTURE]

Halton points, the same points on a disk, their power spectrum and its radial mean; below, results
of analyzers.
"""

import sys
from pathlib import Path

import numpy as np

import figures
import stipple

COUNT = 1024
FREQUENCY = 46  # 93 cells a side are three pixels each
DOTS_PER_INCH = 140


def sentence(star, chi):
    how = "exact" if star.exact else f"within {star.lower:.6g} and {star.upper:.6g}"
    meaning = {
        "stratified": "stratified, more even than random",
        "uniform": "uniform",
        "non-uniform": "not uniform",
    }[chi.verdict]
    return (
        f"star discrepancy {star.value:.6f} ({how})     •     "
        f"chi-square on the disk {chi.statistic:.1f} with {chi.degrees_of_freedom:.0f} "
        f"degrees of freedom, p = {chi.p_value:.1g}: {meaning}"
    )


def draw_points(axes, points, frame, title):
    axes.plot(*frame, color=figures.GREY, linewidth=0.8, clip_on=False)
    axes.scatter(*points.T, s=2.6, linewidths=0, color=figures.COLOURS[0], clip_on=False)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0)
    axes.set_title(title)


def draw():
    halton = stipple.generate("halton", COUNT, 2, start=1)
    disk = stipple.warp(halton, "disk")
    spectrum = stipple.analyze("periodogram", halton, max_frequency=FREQUENCY)
    width, height, side = 10.4, 2.9, 2.0  # inches
    figure = figures.plt.figure(figsize=(width, height))

    def panel(left, wide=side):
        return figure.add_axes((left / width, 0.62 / height, wide / width, side / height))

    turn = np.linspace(0, 2 * np.pi, 361)
    square = ([0, 1, 1, 0, 0], [0, 0, 1, 1, 0])
    draw_points(panel(0.1), halton, square, f"{COUNT} Halton points")
    draw_points(panel(2.4), disk, (np.cos(turn), np.sin(turn)), "the same on a disk")
    draw_spectrum(panel(4.7), spectrum.grid)
    draw_radial(panel(7.2, 3.1), spectrum.radial)
    words = sentence(stipple.analyze("star-discrepancy", halton), stipple.analyze("chi-square", disk))
    figure.text(0.5, 0.02, words, ha="center", fontsize=9.5)
    return figure


def draw_spectrum(axes, power):
    power[FREQUENCY, FREQUENCY] = 0  # f = 0 has n, and tells nothing
    grey = power / (1 + power)
    axes.imshow(grey, cmap="gray", vmin=0, vmax=1, origin="lower", interpolation="nearest")
    axes.set_axis_off()
    axes.set_title("their power spectrum")


def draw_radial(axes, radial):
    axes.axhline(1, color=figures.GREY, linewidth=0.9, linestyle=(0, (5, 3)))
    axes.plot(radial.frequency, radial.power, color=figures.COLOURS[1])
    axes.text(1, 1.03, "white noise", color=figures.GREY, fontsize=8)
    axes.set_xlim(0, FREQUENCY)
    axes.set_ylim(0)
    axes.set_title("and its radial mean")
    axes.set_xlabel("frequency", labelpad=1)


if __name__ == "__main__":
    default = Path(__file__).resolve().parent.parent / "data/overview.png"
    figures.save(draw(), sys.argv[1] if len(sys.argv) > 1 else default, DOTS_PER_INCH)
