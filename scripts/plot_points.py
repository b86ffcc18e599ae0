#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws a point set: in the plane, or in space seen from a fixed side."""

import re
import textwrap

import numpy as np

import stipple_io as io

EXAMPLES = """\
  stipple generate halton -n 1024 -f json | plot_points.py -o halton.png
  plot_points.py disk.csv --domain disk -o disk.svg
  plot_points.py points5d.npy --axes 4,5
"""

AREA = 0.13  # of the frame, that all markers together cover: dense sets stay legible
DENSE = 200_000  # points; above, single points are no longer seen
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def arguments():
    parser = io.Parser(__doc__, EXAMPLES)
    parser.add_argument(
        "--axes",
        metavar="I,J[,K]",
        help="coordinates to draw, numbered from 1 (default: the first two; in 3-D all)",
    )
    parser.add_argument("--set", type=int, default=0, metavar="K", help="set of the file, from 0")
    parser.add_argument(
        "--domain",
        metavar="SPEC",
        help="outline, where the file does not say: unit-cube, disk, disk:radius=2, "
        "triangle:vertices=[0,0 1,0 0,1], box:bounds=[0..2,0..1], none",
    )
    return parser.parse_args()


def chosen_axes(text, dimension):
    """Numbers, from 0, of the coordinates to draw."""
    if text is None:
        return list(range(dimension if dimension < 4 else 2))
    words = text.split(",")
    axes = [int(word) - 1 for word in words if word.strip().isdigit()]
    if len(axes) != len(words) or not 1 <= len(axes) <= 3 or len(set(axes)) < len(axes):
        raise io.usage_error(f"--axes: '{text}' is not up to three different numbers such as 1,2")
    if not all(0 <= axis < dimension for axis in axes):
        raise io.usage_error(f"--axes: '{text}' is outside 1..{dimension}, the coordinates")
    return axes


# ---------------------------------------------------------------- domains


def domain_on(spec, axes):
    """The factor of a product domain ('disk@4,5 x unit-cube@1,2,3') that lives on the axes."""
    factors = re.split(r" x (?![^\[]*\])", spec)
    for factor in factors:
        at = re.match(r"([a-z0-9-]+)@([\d,]+)(.*)", factor)
        if at is None:
            return spec, list(axes)
        places = [int(word) - 1 for word in at[2].split(",")]
        if set(axes) <= set(places):
            return at[1] + at[3], [places.index(axis) for axis in axes]
    return "", list(axes)


def option_of(spec, name):
    """The text of an option in a spec, without its brackets."""
    found = re.search(rf"[:,]{name}=(?:\[([^\]]*)\]|([^,\]]*))", spec)
    return (found[1] or found[2]) if found else None


def numbers(text):
    return [float(word) for word in re.findall(NUMBER, text or "")]


def closed(corners):
    return np.array([*corners, corners[0]], dtype=float)


def box(low, high):
    """The edges of a box in one to three dimensions."""
    if len(low) == 2:
        return [closed([low, (high[0], low[1]), high, (low[0], high[1])])]
    corners = np.stack(np.meshgrid(*zip(low, high), indexing="ij"), -1).reshape(-1, len(low))
    pairs = [(a, b) for i, a in enumerate(corners) for b in corners[i + 1 :]]
    return [np.array(pair) for pair in pairs if np.count_nonzero(pair[0] != pair[1]) == 1]


def outline(spec, axes):
    """Lines around the domain, as arrays of points on the axes; none for an unknown shape."""
    spec, axes = domain_on(spec, axes)
    name = spec.partition(":")[0]
    size = len(axes)
    if name == "unit-cube":
        return box([0.0] * size, [1.0] * size)
    if name == "box":
        parts = (option_of(spec, "bounds") or "").split(",")
        ranges = [numbers(part.replace("..", " ")) for part in parts]
        if max(axes) < len(ranges) and all(len(pair) == 2 for pair in ranges):
            return box([ranges[k][0] for k in axes], [ranges[k][1] for k in axes])
    if name == "disk" and sorted(axes) == [0, 1]:
        radius = (numbers(option_of(spec, "radius")) or [1.0])[0]
        center = numbers(option_of(spec, "center")) or [0.0, 0.0]
        turn = np.linspace(0, 2 * np.pi, 721)
        rim = np.column_stack([np.cos(turn), np.sin(turn)]) * radius + center
        return [rim[:, axes]]
    if name == "triangle":
        text = option_of(spec, "vertices")
        corners = [numbers(part) for part in text.split()] if text else [[0, 0], [1, 0], [0, 1]]
        if len({len(corner) for corner in corners}) == 1 and max(axes) < len(corners[0]):
            return [closed(corners)[:, axes]]
    return []


def domain_of(point_set, given, shown):
    """The domain's spec: as given, else as in the file, else the unit cube if all are in it."""
    if given is not None:
        return given
    spec = point_set.meta.get("domain")
    if isinstance(spec, str):
        return spec
    return "unit-cube" if 0 <= shown.min() and shown.max() <= 1 else ""


# ---------------------------------------------------------------- words


def title_of(point_set):
    """'halton, n = 1024, seed 1, on disk' from the provenance, or the file's name."""
    meta = point_set.meta
    name = meta.get("generator") or (point_set.source if point_set.source != "-" else "points")
    words = [str(name).rpartition("/")[2], f"n = {point_set.count}"]
    if "seed" in meta:
        seed = meta["seed"]
        words.append(f"seed {seed + point_set.number if isinstance(seed, int) else seed}")
    elif point_set.sets > 1:
        words.append(f"set {point_set.number} of {point_set.sets}")
    warps = meta.get("warps")
    if isinstance(warps, list) and warps:
        words.append("warped by " + ", ".join(str(warp) for warp in warps))
    return ", ".join(words)


def label_of(axis, dimension):
    return "xyz"[axis] if dimension <= 3 else f"$x_{{{axis + 1}}}$"


# ---------------------------------------------------------------- drawing


def marker_area(count, inches):
    """Of one marker, in square points."""
    return float(np.clip(AREA * (72 * inches) ** 2 / count, 0.12, 36))


def style(count, inches):
    return {
        "s": marker_area(count, inches),
        "linewidths": 0,
        "rasterized": count > 20_000,  # a vector file with a million circles helps nobody
    }


def draw_plane(plt, points, lines, labels):
    figure, axes = plt.subplots(figsize=(4, 4))
    for line in lines:
        axes.plot(*line.T, color=io.GREY, linewidth=0.8, zorder=1, clip_on=False)
    axes.scatter(*points.T, color=io.COLOURS[0], zorder=2, clip_on=False, **style(len(points), 3.2))
    axes.set_aspect("equal")
    axes.margins(0.02)
    for spine in axes.spines.values():
        spine.set_visible(not lines)
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1], rotation=0, ha="right", va="center", labelpad=4)
    axes.locator_params(nbins=5)
    return figure, axes


def draw_density(plt, points, lines, labels):
    """How many points fall into each cell, for more than can be told apart; the mean is 1."""
    figure, axes = plt.subplots(figsize=(4.7, 4))
    everything = np.vstack([points, *lines])
    edges = [np.linspace(low, high, 129) for low, high in zip(everything.min(0), everything.max(0))]
    counts, *_ = np.histogram2d(*points.T, bins=edges)
    shown = np.ma.masked_equal(counts.T / counts.mean(), 0)
    top = np.percentile(shown.compressed(), 99.9)
    image = axes.pcolormesh(*edges, shown, cmap="viridis", vmin=0, vmax=top, rasterized=True)
    for line in lines:
        axes.plot(*line.T, color=io.GREY, linewidth=0.8, clip_on=False)
    axes.set_aspect("equal")
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1], rotation=0, ha="right", va="center", labelpad=4)
    axes.locator_params(nbins=5)
    bar = figure.colorbar(image, ax=axes, fraction=0.046, pad=0.04)
    bar.set_label("points in a cell / mean")
    bar.outline.set_visible(False)
    return figure, axes


def draw_line(plt, points, lines, labels):
    """One coordinate: each point a stroke."""
    figure, axes = plt.subplots(figsize=(6, 1.1))
    width = float(np.clip(150 / len(points), 0.05, 1.2))
    axes.eventplot(points[:, 0], color=io.COLOURS[0], linewidths=width, lineoffsets=0.5)
    for line in lines:
        axes.set_xlim(line[:, 0].min(), line[:, 0].max())
    axes.set_ylim(0, 1)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_xlabel(labels[0])
    return figure, axes


def draw_space(plt, points, lines, labels):
    """Three coordinates, parallel projection; height is also colour, which gives depth."""
    figure = plt.figure(figsize=(4.6, 4.6))
    axes = figure.add_subplot(projection="3d", proj_type="ortho")
    axes.view_init(elev=22, azim=-58)
    for line in lines:
        axes.plot(*line.T, color=io.GREY, linewidth=0.7)
    order = np.argsort(points @ [np.sin(np.radians(-58 + 90)), -1.0, 0.0], kind="stable")
    axes.scatter(
        *points[order].T,
        c=points[order, 2],
        cmap="viridis",
        depthshade=False,
        **style(len(points), 3.2),
    )
    everything = np.vstack([points, *lines])
    low, high = everything.min(axis=0), everything.max(axis=0)
    axes.set_box_aspect(np.where(high > low, high - low, 1))
    for name, a, b, label in zip("xyz", low, high, labels):
        getattr(axes, f"set_{name}lim")(a, b if b > a else a + 1)
        getattr(axes, f"set_{name}label")(label, labelpad=0)
        axis = getattr(axes, f"{name}axis")
        axis.pane.set_visible(False)
        axis.line.set_visible(len(lines) < 12)  # the edges of a box say as much
        axis.set_rotate_label(False)
        axis.set_major_locator(plt.MaxNLocator(2))
    axes.grid(False)
    return figure, axes


def main():
    options = arguments()
    target, kind = io.target_of(options, options.input)
    sets = io.read_points(options.input)
    if not 0 <= options.set < len(sets):
        raise io.usage_error(f"--set: {options.set} is outside 0..{len(sets) - 1}, the sets")
    point_set = sets[options.set]
    axes = chosen_axes(options.axes, point_set.dimension)
    shown = point_set.points[:, axes]
    lines = outline(domain_of(point_set, options.domain, shown), axes)
    labels = [label_of(axis, point_set.dimension) for axis in axes]
    draw = (draw_line, draw_plane, draw_space)[len(axes) - 1]
    if draw is draw_plane and point_set.count > DENSE:
        draw = draw_density
    figure, frame = draw(io.canvas(), shown, lines, labels)
    title = title_of(point_set) if options.title is None else options.title
    frame.set_title(textwrap.fill(io.plain(title), 56))
    io.write_bytes(target, io.render(figure, kind))


if __name__ == "__main__":
    io.run(main)
