#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws data/overview.png: generate, warp and analyze for three samplers, one in each row.

    PYTHONPATH=build/release/python scripts/overview.py [PICTURE]

Points in the square, the same points on a disk, the power spectrum (mean of SETS sets), the discrepancy of every box, and
results of analyzers.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.colors import LinearSegmentedColormap

import figures
import stipple

SAMPLERS = {
    "random": "Random",
    "sobol:scramble=owen": "Sobol', scrambled",
    "poisson-disk": "Poisson disk",
}
HEADS = ("generate", "warp", "analyze: spectrum", "discrepancy", "and numbers")
COUNT = 256
SETS = 16
FREQUENCY = 32
CORNERS = 65  # boxes along each axis
LIMIT = 0.08  # discrepancy with the strongest colour
BORDER = ([0, 1, 1, 0, 0], [0, 0, 1, 1, 0])
SIDE, GAP, LEFT, TOP = 1.3, 0.2, 0.3, 0.3  # inches
WORDS = 1.95  # inches for the numbers
DOTS_PER_INCH = 150
TOO_FEW_OR_MANY = LinearSegmentedColormap.from_list("boxes", (figures.COLOURS[0], "white", figures.COLOURS[1]))


def discrepancy(points):
    """Fraction of the points in each box [0,x) x [0,y) minus its area, at the centres of a grid of corners (y, x)."""
    corners = (np.arange(CORNERS) + 0.5) / CORNERS
    below = (points[:, :, None] < corners).astype(float)
    return below[:, 1].T @ below[:, 0] / len(points) - np.outer(corners, corners)


def spectrum(name):
    """Mean power of several sets. The power of frequency 0, which is the number of points, is 0."""
    sets = stipple.generate(name, COUNT, sets=SETS)
    power = np.mean([stipple.analyze("periodogram", one, max_frequency=FREQUENCY).grid for one in sets], axis=0)
    power[FREQUENCY, FREQUENCY] = 0
    return power


def results(name, points, disk):
    star = stipple.analyze("star-discrepancy", points)
    near = stipple.analyze("nearest-neighbor", points)
    integral = stipple.integrate(lambda x: np.hypot(x[:, 0] - 1, x[:, 1]), name, COUNT, 2, replications=SETS, warp="disk")
    verdict = stipple.analyze("chi-square", disk).verdict
    return (f"star discrepancy  {star.value:.3f}\nclosest two points  {near.minimum:.3f}\n"
            f"test on the disk: {verdict}\nan integral (exact: {32 / 9:.4f})\n"
            f"{integral.estimate:.4f} ± {integral.standard_error:.4f}")


def draw_points(axes, points, frame):
    axes.plot(*frame, color=figures.GREY, linewidth=0.7, clip_on=False)
    axes.scatter(*points.T, s=3, linewidths=0, color=figures.COLOURS[0], clip_on=False)
    axes.set_aspect("equal")
    axes.margins(0)


def draw_row(panels, name):
    points = stipple.generate(name, COUNT)
    disk = stipple.warp(points, "disk")
    turn = np.linspace(0, 2 * np.pi, 361)
    draw_points(panels[0], points, BORDER)
    draw_points(panels[1], disk, (np.cos(turn), np.sin(turn)))
    power = spectrum(name)
    panels[2].imshow(power / (1 + power), cmap="gray", vmin=0, vmax=1, origin="lower", interpolation="nearest")
    panels[3].imshow(discrepancy(points), cmap=TOO_FEW_OR_MANY, vmin=-LIMIT, vmax=LIMIT, origin="lower", interpolation="nearest")
    panels[3].plot(*BORDER, color=figures.GREY, linewidth=0.7, clip_on=False, transform=panels[3].transAxes)
    panels[4].text(0, 0.5, results(name, points, disk), va="center", linespacing=1.6, fontsize=8.5)
    for panel in panels:
        panel.set_axis_off()


def draw():
    width = LEFT + 4 * (SIDE + GAP) + WORDS
    height = TOP + len(SAMPLERS) * (SIDE + GAP / 2)
    figure = figures.plt.figure(figsize=(width, height))
    for row, (name, title) in enumerate(SAMPLERS.items()):
        bottom = height - TOP - row * (SIDE + GAP / 2) - SIDE
        places = [(LEFT + column * (SIDE + GAP), SIDE if column < 4 else WORDS) for column in range(5)]
        panels = [figure.add_axes((left / width, bottom / height, wide / width, SIDE / height)) for left, wide in places]
        draw_row(panels, name)
        figure.text(0.12 / width, (bottom + SIDE / 2) / height, title, rotation=90, va="center", ha="center", fontsize=10)
        if row == 0:
            for panel, head in zip(panels, HEADS):
                panel.set_title(head, loc="left" if head == HEADS[-1] else "center", fontsize=10, fontweight="bold")
    return figure


if __name__ == "__main__":
    default = Path(__file__).resolve().parent.parent / "data/overview.png"
    figures.save(draw(), sys.argv[1] if len(sys.argv) > 1 else default, DOTS_PER_INCH)
