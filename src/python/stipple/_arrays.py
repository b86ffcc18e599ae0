# SPDX-License-Identifier: MIT
"""Arrays of points, and their conversion to what the library takes."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable, Mapping
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _frames, _stipple
from ._arguments import Floats, is_masked, refuse, shown, text
from ._errors import Error

Given: TypeAlias = tuple[Floats, str, str]
"""Rows (n, d), the spec of their domain, and their meta as JSON."""


def _is_whole(key: Any, size: int) -> bool:
    return isinstance(key, slice) and range(size)[key] == range(size)


def _picks(key: Any) -> bool:
    """Whether a key keeps its axis: a slice, a list of indices or a mask."""
    return isinstance(key, slice) or np.ndim(key) == 1


def _keys_of(index: Any, dimensions: int) -> list[Any] | None:
    """One key per axis; None if the index has other keys."""
    keys = list(index) if isinstance(index, tuple) else [index]
    dots = [i for i, key in enumerate(keys) if key is Ellipsis]
    place = dots[0] if dots else len(keys)
    keys[place : place + len(dots)] = [slice(None)] * (dimensions - len(keys) + len(dots))
    return None if len(keys) != dimensions or any(key is None for key in keys) else keys


def _domain_of_columns(domain: str, d: int, columns: list[int]) -> str | None:
    """The domain of some coordinates; None if it is not known to be the domain of these alone."""
    if len({*columns}) < len(columns):
        return None
    if domain == "unit-cube":
        return domain
    whole = " x " not in domain
    head, _, tail = domain.partition("=[")
    try:
        if whole and head == "box:bounds" and len(sides := tail[:-1].split(",")) == d:
            return f"box:bounds=[{','.join(sides[k] for k in columns)}]"
        if whole and head == "parameters:json":
            content = json.loads(tail[:-1])
            if {*content} - {"parameters", "$schema"}:
                return None
            content["parameters"] = [content["parameters"][k] for k in columns]
            some = len(columns)
            return _stipple.domain_of_columns(f"{head}=[{json.dumps(content)}]", some, [*range(some)])
        return None if whole else _stipple.domain_of_columns(domain, d, columns) or None
    except (Error, ValueError):
        return None


def _meta_of_columns(meta: dict[str, Any], d: int, columns: list[int]) -> dict[str, Any]:
    """The names, levels and domain of some coordinates."""
    kept: dict[str, Any] = {}
    domain = _domain_of_columns(meta.get("domain", "unit-cube"), d, columns)
    if domain is not None:
        kept["domain"] = domain
    if "columns" in meta:
        names = [meta["columns"][k] for k in columns]
        if len({*names}) == len(names):
            kept["columns"] = names
            levels = {name: meta.get("levels", {}).get(name) for name in names}
            kept |= {"levels": found} if (found := {k: v for k, v in levels.items() if v}) else {}
    return kept


def _meta_of_part(points: Points, index: Any) -> Any:
    """The meta of a selection of points. Whole sets keep everything; otherwise the domain, names and
    levels of the selected coordinates remain if they still hold. None if the result is not
    points."""
    keys = _keys_of(index, points.ndim)
    if keys is None or points.ndim not in (2, 3) or not (_picks(keys[-1]) and _picks(keys[-2])):
        return None
    columns = keys[-1]
    if sum(not isinstance(key, slice) for key in keys[-2:]) > 1:
        return None
    rows, d = keys[-2], points.shape[-1]
    all_columns = _is_whole(columns, d)

    def part(meta: Any) -> Any:
        if not isinstance(meta, dict) or all_columns and _is_whole(rows, points.shape[-2]):
            return meta
        if all_columns:
            return {key: meta[key] for key in ("domain", "columns", "levels", "warps") if meta.get(key)}
        return _meta_of_columns(meta, d, np.arange(d)[columns].tolist())

    if points.ndim == 2:
        return part(points.meta)
    sets = keys[0]
    if not isinstance(points.meta, list) or not isinstance(sets, slice) and (
        not isinstance(keys[2], slice) or np.ndim(sets) == 1 and not isinstance(rows, slice)
    ):
        return None
    if _picks(sets):
        return [part(points.meta[k]) for k in np.arange(len(points))[sets]]
    return part(points.meta[sets]) if np.ndim(sets) == 0 else None


class Points(np.ndarray[Any, np.dtype[np.float64]]):
    """An array of points (n, d), or (sets, n, d), with its provenance.

    meta: a dictionary of the generator, its options, the seed, warps, domain, names of columns ...;
    for several sets a list of them. It is kept by copies and pickles.

    A selection of points (x[:50], x[::2], x[mask], x[[3, 1]]) keeps the domain, the warps, and the
    names and levels of the columns. A selection of columns (x[:, :2]) keeps their names and levels, and the
    domain if it is that of these columns alone: of a cube, a box, parameters that are independent of
    the others, or a whole factor of a product. Results of arithmetic, also in place, are arrays
    whose meta is None, and so are sorted ones.
    """

    meta: Any = None

    def __array_finalize__(self, source: object) -> None:
        self.meta = None

    def __array_wrap__(self, *results: Any) -> Any:
        found = super().__array_wrap__(*results)
        if found is self:  # x *= 2
            self.meta = None
        return found

    def sort(self, *args: Any, **options: Any) -> None:
        """Sorts in place; the meta, which is that of other points, becomes None."""
        super().sort(*args, **options)
        self.meta = None

    def __getitem__(self, index: Any) -> Any:
        part = super().__getitem__(index)
        if self.meta is not None and isinstance(part, Points):
            part.meta = _meta_of_part(self, index)
        return part

    def copy(self, order: Literal["K", "A", "C", "F"] | None = "C") -> Points:
        """A copy with a copy of its meta."""
        return with_meta(np.array(self, order=order), copy.deepcopy(self.meta))

    def __copy__(self) -> Points:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> Points:
        return self.copy()

    def __reduce__(self) -> tuple[Callable[..., Points], tuple[Floats, Any]]:
        return with_meta, (np.array(self), self.meta)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame of a set (n, d) with a column for each coordinate: x, y, z or x1, x2,
        ... unless the meta names them. Columns with levels are categorical. Its attrs record the
        domain, for use by analyze() and other calls. Raises Error if pandas is not installed."""
        return _frames.to_pandas(self)

    def to_polars(self) -> Any:
        """A polars.DataFrame as for to_pandas(), with the type Enum for columns with levels; it does
        not record the domain. Raises Error if polars is not installed."""
        return _frames.to_polars(self)


def with_meta(array: Floats, meta: Any) -> Points:
    points = array.view(Points)
    points.meta = meta
    return points


def as_rows(x: ArrayLike, name: str = "x", most: int = 2, gaps: bool = False) -> Floats:
    """Points as an array (n, d) of float64 in C order; with most = 3 also (sets, n, d), with gaps
    also NaN."""
    shape = "(n, d)" if most == 2 else "(n, d) or (sets, n, d)"
    if isinstance(x, (str, bytes)) or hasattr(x, "read"):
        refuse(name, x, f"points {shape}", "read() returns the points of a file")
    if isinstance(x, Mapping) or x is None:
        raise Error(f"{name} is {shown(x)}; expected points {shape}", "input")
    try:
        array = np.asarray(x)
    except Exception as error:
        raise Error(f"{name} is no array of points: {error}", "input") from None
    if is_masked(x):
        raise Error(f"{name} has masked elements; leave such points out", "input")
    if array.dtype.kind not in "fiu":
        raise Error(
            f"{name} has elements of type {array.dtype}; points are real numbers", "input"
        )
    if not 2 <= array.ndim <= most:
        raise Error(f"{name} has the shape {array.shape}; points are {shape}", "input")
    if array.size == 0:
        raise Error(f"{name} has the shape {array.shape}; there are no points", "input")
    with np.errstate(over="ignore"):
        rows = np.ascontiguousarray(array, dtype=np.float64)
    wrong = np.isinf(rows) if gaps else ~np.isfinite(rows)
    if wrong.any():
        place = np.argwhere(wrong)[0]
        raise Error(
            f"{name}[{', '.join(map(str, place))}] is {rows[tuple(place)]}; points are finite",
            "input",
        )
    return rows.view(np.ndarray)


def _order(names: list[str], wanted: list[str | None], name: str) -> list[int] | None:
    """Positions of the wanted names; a wanted None takes the next other column. If names are missing
    and `names` mean nothing (x, y, ...): all columns in order, or None if their number differs."""
    missing = [key for key in wanted if key is not None and key not in names]
    if not missing:
        others = (k for k, key in enumerate(names) if key not in wanted)
        return [next(others) if key is None else names.index(key) for key in wanted]
    if _frames.are_named(names):
        raise Error(f"{name} has no column {missing[0]!r}, as the domain has; its columns are "
                    f"{', '.join(names)}", "input")
    return [*range(len(names))] if len(names) == len(wanted) else None


def _renumbered(column: Floats, words: list[str], levels: list[str], where: str) -> Floats:
    """Converts a column of indices into `words` to indices into `levels`."""
    places = {word: place for place, word in enumerate(levels)}
    known = np.array([places.get(word, -1) for word in words] + [-1], dtype=np.float64)
    is_place = (column >= 0) & (column < len(words)) & (column == np.floor(column))
    found: Floats = known[np.where(is_place, column, len(words)).astype(int)]
    if (found < 0).any():
        i = int(np.argmin(found))
        value = words[int(column[i])] if is_place[i] else column[i]
        expected = f"one of {', '.join(levels)}" if levels else "a number"
        raise Error(f"{where}[{i}] is {shown(value)}; expected {expected}", "input")
    return found


def matched(one: Given, name: str = "x") -> Given:
    """Returns the points with columns and words as in their domain, matched by name."""
    rows, domain, text_of_meta = one
    meta = json.loads(text_of_meta) if text_of_meta else {}
    names, words = meta.get("columns"), meta.get("levels") or {}
    if "parameters" not in domain or not names or len(names) != rows.shape[1]:
        return one
    wanted, levels = _stipple.names_of_domain(domain, len(names))
    order = _order(names, wanted, name) if any(wanted) else None
    if order is None:
        return one
    if names == wanted and words == levels:
        return one
    kept = rows[:, order]
    columns = [names[place] if key is None else key for key, place in zip(wanted, order)]
    for k, place in enumerate(order):
        own = words.get(names[place])
        if own and wanted[k] is None:
            levels[columns[k]] = own
        elif own and own != levels.get(columns[k]):
            kept[:, k] = _renumbered(kept[:, k], own, levels.get(columns[k], []),
                                     f"{name}[{names[place]!r}]")
    meta |= {"columns": columns, "levels": levels}
    return np.ascontiguousarray(kept), domain, json.dumps(meta)


def alike(sets: list[tuple[str, Given]]) -> list[Given]:
    """Unifies sets shown or written together: columns in the order of the first set, and equal
    words with equal numbers."""
    metas = [json.loads(one[2]) if one[2] else {} for _, one in sets]
    named = [k for k, meta in enumerate(metas) if _frames.are_named(meta.get("columns") or [])]
    levels: dict[str, list[str]] = {}
    for k in sorted(named, key=lambda k: "parameters" not in sets[k][1][1]):
        for key, words in (metas[k].get("levels") or {}).items():
            known = levels.setdefault(key, [])
            known.extend(word for word in words if word not in known)
    found = [one for _, one in sets]
    for k in named:
        found[k] = _as_first(sets[k], metas[k], (sets[named[0]][0], metas[named[0]]["columns"]), levels)
    return found


def _as_first(given_set: tuple[str, Given], meta: dict[str, Any], first: tuple[str, list[str]],
              levels: dict[str, list[str]]) -> Given:
    name, (rows, domain, _) = given_set
    names, own = meta["columns"], meta.get("levels") or {}
    if names == first[1] and all(words == levels[key] for key, words in own.items()):
        return given_set[1]
    order = [names.index(key) for key in first[1]] if sorted(names) == sorted(first[1]) else []
    on = domain if names == first[1] else _domain_of_columns(domain, len(names), order) if order else None
    if on is None:
        raise Error(f"{name} has the columns {', '.join(names)}, and {first[0]} {', '.join(first[1])}; "
                    "expected the same", "input")
    kept = rows[:, order]
    for k, key in enumerate(first[1]):
        words = own.get(key, [])
        if words == levels.get(key, words):
            continue
        if "parameters" in domain and words != levels[key][:len(words)]:
            raise Error(f"{name}[{key!r}] has the levels {', '.join(words)}, and another set "
                        f"{', '.join(levels[key])}", "input")
        if words:
            kept[:, k] = _renumbered(kept[:, k], words, levels[key], f"{name}[{key!r}]")
    meta |= {"columns": first[1], "domain": on}
    if own:
        meta["levels"] = {key: levels[key] for key in first[1] if key in levels}
    return np.ascontiguousarray(kept), on, json.dumps(meta)


def _with_domain(rows: Floats, meta: Any, domain: object, name: str) -> Given:
    """Rows with the given domain or, without one, that of the meta."""
    meta = meta if isinstance(meta, dict) else {}
    on = meta.get("domain") or "unit-cube" if domain is None else domain
    try:
        words = json.dumps(meta) if meta else ""
    except Exception:
        raise Error(f"{name}.meta is {shown(meta)}; expected what JSON can hold") from None
    return matched((rows, text("domain", on, 'the name of a domain, such as "disk"'), words), name)


def sets_of(x: Any, name: str = "x", domain: object = None) -> tuple[list[Given], bool]:
    """One or several sets of points, and whether x holds several: an array (sets, n, d), or a list
    of arrays and tables."""
    if _frames.is_frame(x):
        return [given(x, name, domain)], False
    if isinstance(x, (list, tuple)) and x and all(
        isinstance(one, np.ndarray) and one.ndim == 2 or _frames.is_frame(one) for one in x
    ):
        return [given(one, f"{name}[{k}]", domain) for k, one in enumerate(x)], True
    rows = as_rows(x, name, most=3)
    meta = getattr(x, "meta", None)
    if rows.ndim == 2:
        return [_with_domain(rows, meta, domain, name)], False
    metas = meta if isinstance(meta, list) and len(meta) == len(rows) else [meta] * len(rows)
    return [_with_domain(one, each, domain, name) for one, each in zip(rows, metas)], True


def _domain_recorded(frame: Any, names: list[str]) -> str | None:
    """The domain recorded in a table, for the columns that it still has."""
    domain, columns = _frames.recorded(frame) or ("", [])
    if names == columns or "parameters" in domain and sorted(names) == sorted(columns):
        return domain or None
    if not domain or not {*names} <= {*columns}:
        return None
    return _domain_of_columns(domain, len(columns), [columns.index(key) for key in names])


def given(x: Any, name: str = "x", domain: object = None) -> Given:
    """One set of points."""
    if _frames.is_frame(x):
        rows, meta = _frames.taken(x, name)
        recorded = _domain_recorded(x, meta["columns"]) if domain is None else None
        if recorded:
            meta["domain"] = recorded
        return _with_domain(as_rows(rows, name), meta, domain, name)
    return _with_domain(as_rows(x, name), getattr(x, "meta", None), domain, name)


def given_table(x: Any, name: str, domain: object) -> Given:
    """Rows of a table, with the domain of its inputs: the analyzer finds these by name, as in files."""
    told = getattr(x, "meta", None)
    rows, meta = x, {**told} if isinstance(told, dict) else {}
    if _frames.is_frame(x):
        rows, meta = _frames.taken(x, name)
        meta |= _inputs_recorded(x, meta["columns"])
    rows = as_rows(rows, name, gaps=True)
    on = text("domain", meta.get("domain") or "unit-cube" if domain is None else domain,
              'the name of a domain, such as "disk"')
    named = "parameters" in on
    inputs, levels = _stipple.names_of_domain(on, rows.shape[1]) if named else ([], {})
    if inputs and all(inputs):
        meta["dimension"] = len(inputs)
    words = meta.get("levels") or {}
    for k, key in enumerate(meta.get("columns") or []):
        if key in inputs and key in words and words[key] != levels.get(key):
            rows = rows.copy()
            rows[:, k] = _renumbered(rows[:, k], words[key], levels.get(key, []), f"{name}[{key!r}]")
    meta["levels"] = words | levels
    return rows, on, json.dumps(meta)


def _inputs_recorded(frame: Any, names: list[str]) -> dict[str, Any]:
    """The inputs recorded in a table. A domain without names holds only for all its columns."""
    domain, columns = _frames.recorded(frame) or ("", [])
    inputs = [key for key in columns if key in names]
    if inputs != columns and "parameters" not in domain or not inputs:
        return {}
    generator = frame.attrs["stipple"].get("generator", "") if inputs == columns else ""
    return {"domain": _domain_recorded(frame, inputs), "dimension": len(inputs), "generator": generator}
