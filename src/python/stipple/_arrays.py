# SPDX-License-Identifier: MIT
"""Conversion of Python arrays and settings to the form that the library expects."""

import json
import os

import numpy as np

from ._errors import Error


def _is_whole(key, size):
    return isinstance(key, slice) and range(size)[key] == range(size)


def _picks(key):
    """Whether a key keeps its axis: a slice, a list of indices or a mask."""
    return isinstance(key, slice) or np.ndim(key) == 1


def _keys_of(index, dimensions):
    """One key per axis; None if the index has other keys."""
    keys = list(index) if isinstance(index, tuple) else [index]
    dots = [i for i, key in enumerate(keys) if key is Ellipsis]
    place = dots[0] if dots else len(keys)
    keys[place : place + len(dots)] = [slice(None)] * (dimensions - len(keys) + len(dots))
    return None if len(keys) != dimensions or any(key is None for key in keys) else keys


def _meta_of_part(points, index):
    """The meta of a selection of points. Whole sets keep everything; otherwise the domain and
    the names and levels of the columns. None if coordinates are dropped, or the result is not
    points."""
    keys = _keys_of(index, points.ndim)
    if keys is None or not _is_whole(keys[-1], points.shape[-1]) or not _picks(keys[-2]):
        return None
    rows = keys[-2]

    def part(meta):
        if _is_whole(rows, points.shape[-2]):
            return meta
        return {key: meta[key] for key in ("domain", "columns", "levels") if key in meta}

    if points.ndim == 2:
        return part(points.meta)
    if not isinstance(points.meta, list) or points.ndim != 3:
        return None
    sets = keys[0]
    if _picks(sets):
        both = isinstance(sets, slice) or isinstance(rows, slice)
        numbers = np.arange(len(points))[sets]
        return [part(points.meta[k]) for k in numbers] if both else None
    return part(points.meta[sets]) if np.ndim(sets) == 0 else None


class Points(np.ndarray):
    """An array of points (n, d), or (sets, n, d), with its provenance.

    meta: a dictionary of the generator, its options, the seed, warps, domain ...; for several sets
    a list of them. A selection of points (x[:50], x[::2], x[mask], x[[3, 1]]) keeps the domain and
    the names and levels of the columns. A selection of columns, and results of arithmetic, are
    plain arrays, whose meta is None.
    """

    meta = None

    def __array_finalize__(self, source):
        self.meta = None

    def __getitem__(self, index):
        part = super().__getitem__(index)
        if self.meta is not None and isinstance(part, Points):
            part.meta = _meta_of_part(self, index)
        return part

    def copy(self, order="C"):
        return with_meta(super().copy(order), self.meta)


def with_meta(array, meta):
    points = array.view(Points)
    points.meta = meta
    return points


def domain_of(x, domain):
    """The domain as a spec: the given one, or else that of the points' meta."""
    if domain is not None:
        return str(domain)
    meta = getattr(x, "meta", None)
    return meta.get("domain", "unit-cube") if isinstance(meta, dict) else "unit-cube"


def meta_text(x):
    meta = getattr(x, "meta", None)
    return json.dumps(meta) if isinstance(meta, dict) else ""


def as_rows(x, name="x", most=2):
    """Points as an array (n, d) of float64 in C order; with most = 3 also (sets, n, d)."""
    try:
        array = np.asarray(x)
    except ValueError as error:
        raise Error(f"{name} is no array of points: {error}", "input") from None
    if np.ma.is_masked(x):
        raise Error(f"{name} has masked elements; leave such points out", "input")
    if array.dtype.kind not in "fiu":
        raise Error(
            f"{name} has elements of type {array.dtype}; points are real numbers", "input"
        )
    if not 2 <= array.ndim <= most:
        shape = "(n, d)" if most == 2 else "(n, d) or (sets, n, d)"
        raise Error(f"{name} has the shape {array.shape}; points are {shape}", "input")
    if array.size == 0:
        raise Error(f"{name} has the shape {array.shape}; there are no points", "input")
    with np.errstate(over="ignore"):
        rows = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(rows).all():
        place = np.argwhere(~np.isfinite(rows))[0]
        raise Error(
            f"{name}[{', '.join(map(str, place))}] is {rows[tuple(place)]}; points are finite",
            "input",
        )
    return rows.view(np.ndarray)


def _text(value):
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (list, tuple, np.ndarray)):
        rows = [list(row) if isinstance(row, (list, tuple, np.ndarray)) else row for row in value]
        if any(isinstance(row, list) for row in rows):
            return " ".join(",".join(_text(x) for x in row) for row in rows)
        return ",".join(_text(x) for x in rows)
    raise TypeError(f"an option cannot be {value!r}")


def settings_of(options):
    """Keyword arguments as options: names with dashes, values as text; None values are omitted."""
    return [
        (name.rstrip("_").replace("_", "-"), _text(value))
        for name, value in options.items()
        if value is not None
    ]


def spec_text(value):
    """The spec of a unit: "disk", "disk:method=concentric", or ("disk", {"method":
    "concentric"})."""
    if isinstance(value, str):
        return value
    name, options = value
    settings = ",".join(f"{key}=[{text}]" for key, text in settings_of(options))
    return f"{name}:{settings}" if settings else name


def listed(value):
    """A list of specs; accepts a single unit, too."""
    if value is None:
        return []
    return [spec_text(value)] if isinstance(value, (str, tuple)) else [spec_text(v) for v in value]


def bounds_text(bounds):
    """Formats bounds: (low, high) for all coordinates, a list of such pairs, or "0..1,0..2"."""
    if bounds is None or isinstance(bounds, str):
        return bounds or ""
    pairs = np.asarray(bounds, dtype=float)
    if pairs.shape == (2,):
        pairs = pairs[None]
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise Error(f"bounds has the shape {pairs.shape}; it is (low, high), or one for each axis")
    return ",".join(f"{low!r}..{high!r}" for low, high in pairs.tolist())
