# SPDX-License-Identifier: MIT
"""Shared by scripts that draw figures: matplotlib with the house style, and reproducible files."""

import logging
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Okabe and Ito's colours: distinct for colour-blind readers, and dark enough for thin lines.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
GREY = "#6b6b6b"

logging.getLogger("matplotlib").setLevel(logging.ERROR)
plt.rcdefaults()  # the user's matplotlibrc must not change a figure
plt.rcParams.update(
    {
        "font.family": "sans-serif",
        "font.size": 9,
        "axes.titlesize": 10,
        "axes.linewidth": 0.7,
        "axes.edgecolor": "#333333",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
        "xtick.major.width": 0.7,
        "ytick.major.width": 0.7,
        "lines.linewidth": 1.2,
        "legend.frameon": False,
        "legend.fontsize": 8.5,
        "svg.fonttype": "none",  # text stays text
        "svg.hashsalt": "stipple",  # the same bytes every time
        "pdf.fonttype": 42,
    }
)
METADATA = {
    ".png": {"Software": "stipple"},
    ".svg": {"Date": None, "Creator": "stipple"},
    ".pdf": {"CreationDate": None, "Creator": "stipple", "Producer": "matplotlib"},
}


def save(figure, path, dpi=200):
    """Writes a .png, .svg or .pdf file."""
    figure.savefig(path, dpi=dpi, bbox_inches="tight", pad_inches=0.06,
                   metadata=METADATA[Path(path).suffix])
