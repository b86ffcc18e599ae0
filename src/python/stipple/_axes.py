# SPDX-License-Identifier: MIT
"""Charts and points on the axes of Matplotlib, which need not be installed."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _stipple
from ._arguments import Floats, counted, shown
from ._errors import Error


def axes_of(ax: Any) -> list[Any]:
    """Axes given singly, in a list or in an array of pyplot.subplots()."""
    single = hasattr(ax, "scatter")
    found = [ax] if single else list(np.ravel(np.asarray(ax, dtype=object)))
    if not found or not all(hasattr(one, "scatter") for one in found):
        raise Error(f"ax is {shown(ax)}; expected axes of Matplotlib, or a list of them")
    for one in found:
        if getattr(one, "name", "") in ("polar", "3d"):
            raise Error(f"ax is {shown(one)}; expected axes with x and y")
    return found


def _label(name: str) -> str | None:
    """A name in a form that legends show: they omit names that begin with an underscore."""
    return f" {name}" if name.startswith("_") else name or None


def draw_points(ax: Any, sets: list[tuple[str, Floats]], title: str | None, legend: bool,
                logs: list[bool]) -> None:
    for name, rows in sets:
        if rows.shape[1] != 2:
            raise Error(
                f"axes of Matplotlib show 2 coordinates; the points have {rows.shape[1]}", "input"
            )
        ax.scatter(rows[:, 0], rows[:, 1], s=max(1, 4000 / len(rows)), label=_label(name))
    positive = [log and all((rows[:, k] > 0).all() for _, rows in sets) for k, log in enumerate(logs)]
    for scale, log in zip((ax.set_xscale, ax.set_yscale), positive):
        if log:
            scale("log")
    ax.set_aspect("auto" if any(positive) else "equal")
    if title is not None:
        ax.set_title(title)
    if legend:
        ax.legend()


def _draw_bars(ax: Any, panel: dict[str, Any]) -> None:
    """Bars side by side at each category."""
    width = 0.8 / len(panel["series"])
    for i, (name, x, y, low, high) in enumerate(panel["series"]):
        at = np.array(x) + (i - (len(panel["series"]) - 1) / 2) * width
        error = [np.subtract(y, low), np.subtract(high, y)] if low else None
        ax.bar(at, y, width, label=_label(name), yerr=error)
    ax.set_xticks(range(1, len(panel["categories"]) + 1), panel["categories"])


def _draw_curves(ax: Any, panel: dict[str, Any]) -> None:
    for name, edges, heights in panel["bars"]:
        ax.stairs(heights, edges, label=_label(name))
    for name, x, y, low, high in panel["series"]:
        [line] = ax.plot(x, y, label=_label(name), marker="." if len(x) < 30 else None)
        if low:
            ax.fill_between(x, low, high, color=line.get_color(), alpha=0.2, linewidth=0)


def draw_chart(axes: list[Any], chart: _stipple.Chart, title: str | None) -> None:
    """Draws a chart's panels, each on axes of its own; a single one shows the first panel."""
    panels = chart.panels()
    if len(axes) not in (1, len(panels)):
        raise Error(f"ax has {len(axes)} axes; the picture has {counted(len(panels), 'panel')}")
    for ax, panel in zip(axes, panels):
        (_draw_bars if panel["categories"] else _draw_curves)(ax, panel)
        for name, x, _, low, high in panel["bands"]:
            ax.fill_between(x, low, high, color="0.9", label=_label(name), zorder=0)
        for name, x, y in panel["guides"]:
            style = {"color": "0.6", "linestyle": "--", "linewidth": 1, "label": _label(name)}
            ax.plot(x, y, **style) if x else ax.axhline(y[0], **style)
        for scale, log in zip((ax.set_xscale, ax.set_yscale), panel["logs"]):
            if log:
                scale("log")
        ax.set_xlabel(panel["names"][0])
        ax.set_ylabel(panel["names"][1])
        if len(ax.get_legend_handles_labels()[0]) > 1:
            ax.legend()
    if title is not None:
        axes[0].set_title(title)
