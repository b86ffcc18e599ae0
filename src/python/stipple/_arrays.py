# SPDX-License-Identifier: MIT
"""Arrays and settings as the library takes them."""

import json
import os

import numpy as np

from ._errors import Error


class Points(np.ndarray):
    """An array of points (n, d), or (sets, n, d), with where they come from.

    meta: a dictionary of the generator, its options, the seed, warps, domain ...; of several sets a
    list of them. Slices and results of arithmetic are plain arrays, whose meta is None.
    """

    meta = None

    def __array_finalize__(self, source):
        self.meta = None


def with_meta(array, meta):
    points = array.view(Points)
    points.meta = meta
    return points


def domain_of(x, domain):
    """The domain as text: the one that is given, or that of the points' meta."""
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
    """Keyword arguments as options: names with dashes, values as text; those that are None are left
    out."""
    return [
        (name.rstrip("_").replace("_", "-"), _text(value))
        for name, value in options.items()
        if value is not None
    ]


def spec_text(value):
    """A unit: "disk", "disk:method=concentric", or ("disk", {"method": "concentric"})."""
    if isinstance(value, str):
        return value
    name, options = value
    settings = ",".join(f"{key}=[{text}]" for key, text in settings_of(options))
    return f"{name}:{settings}" if settings else name


def listed(value):
    """A list of units, of which one may stand alone."""
    if value is None:
        return []
    return [spec_text(value)] if isinstance(value, (str, tuple)) else [spec_text(v) for v in value]


def bounds_text(bounds):
    """(low, high) for all coordinates, or a list of them; or "0..1,0..2"."""
    if bounds is None or isinstance(bounds, str):
        return bounds or ""
    pairs = np.asarray(bounds, dtype=float)
    if pairs.shape == (2,):
        pairs = pairs[None]
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise Error(f"bounds has the shape {pairs.shape}; it is (low, high), or one for each axis")
    return ",".join(f"{low!r}..{high!r}" for low, high in pairs.tolist())
