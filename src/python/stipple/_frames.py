# SPDX-License-Identifier: MIT
"""Tables with named columns, such as those of pandas and polars, which need not be installed."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from . import _stipple
from ._arguments import Floats, shown
from ._errors import Error

if TYPE_CHECKING:
    from ._arrays import Points


class Frame(Protocol):
    """A table of columns: a DataFrame of pandas or polars, and any object like them."""

    @property
    def columns(self) -> Iterable[Any]: ...
    def to_numpy(self) -> Any: ...
    def __getitem__(self, column: Any) -> Any: ...


def is_frame(x: object) -> bool:
    return hasattr(x, "columns") and hasattr(x, "to_numpy")


def _column(name: str, key: str, column: Any) -> tuple[Floats, list[str]]:
    """The numbers of a column, and its words if it has words: the numbers are then their places in
    the list of categories or, if the column has no such list, in alphabetical order."""
    try:
        values = np.asarray(column.to_numpy())
    except Exception:
        raise Error(f"{name} has a column {key!r} that gives no array", "input") from None
    where = f"{name}[{key!r}]"
    if values.ndim != 1:
        raise Error(f"{where} has the shape {values.shape}; columns are (n,)", "input")
    if values.dtype.kind in "fiu":
        return values.astype(np.float64), []
    if values.dtype.kind not in "OUT":
        raise Error(f"{where} has elements of type {values.dtype}; expected numbers or words", "input")
    several = [isinstance(value, str) for value in values]
    numbers: list[Any]
    if any(several):
        categories = getattr(getattr(column, "dtype", None), "categories", None)
        words = [str(w) for w in (sorted({*values[several]}) if categories is None else categories)]
        places = {word: place for place, word in enumerate(words)}
        numbers = [places.get(str(v)) if isinstance(v, str) else None for v in values]
    else:
        words = []
        numbers = [v if isinstance(v, (int, float, np.number)) and not isinstance(v, bool) else None
                   for v in values]
    for i, (number, value) in enumerate(zip(numbers, values)):
        if number is None:
            expected = "a word, as in the rest of the column" if any(several) else "a number"
            raise Error(f"{where}[{i}] is {shown(value)}; expected {expected}", "input")
    return np.array(numbers, dtype=np.float64), words


def default_names(d: int) -> list[str]:
    return ["x", "y", "z"][:d] if d < 4 else [f"x{k + 1}" for k in range(d)]


def is_word(text: str) -> bool:
    """Whether a header can hold a name, or a file a word, so that it is read back. (The library takes
    no lone surrogates, which are not printable.)"""
    return text.isprintable() and _stipple.is_word(text)


def are_named(names: list[str]) -> bool:
    """Whether some name carries a meaning: a file can hold it, and it is not the default one."""
    return any(is_word(name) and name != usual for name, usual in zip(names, default_names(len(names))))


def recorded(frame: Any) -> tuple[str, list[str]] | None:
    """The domain that Points.to_pandas() recorded, and the names of its columns."""
    attrs = getattr(frame, "attrs", None)
    kept = attrs.get("stipple") if isinstance(attrs, dict) else None
    if not isinstance(kept, dict) or not isinstance(kept.get("domain"), str) or "columns" not in kept:
        return None
    return kept["domain"], list(kept["columns"])


def taken(frame: Any, name: str) -> tuple[Floats, dict[str, Any]]:
    """The numbers of a table (n, d), and the meta of its points: names of the columns, and words of
    categorical columns. Columns 0, 1, ... of pandas have no names."""
    try:
        keys = list(frame.columns)
    except Exception:
        raise Error(f"{name} is {shown(frame)}; its columns have no names", "input") from None
    names = [str(key) for key in keys]
    for i, key in enumerate(names):
        if key in names[:i]:
            raise Error(f"{name} has two columns {key!r}", "input")
    meta: dict[str, Any] = {"columns": default_names(len(keys)) if keys == [*range(len(keys))] else names}
    columns = []
    for key, shown_key, word in zip(keys, names, meta["columns"]):
        numbers, words = _column(name, shown_key, frame[key])
        columns.append(numbers)
        if words:
            meta.setdefault("levels", {})[word] = words
    rows = np.column_stack(columns) if columns else np.zeros((0, 0))
    return np.ascontiguousarray(rows), meta


def _columns(points: Points) -> dict[str, tuple[Floats, list[str]]]:
    """Columns of a set by name, each with its words."""
    meta = points.meta if isinstance(points.meta, dict) else {}
    if points.ndim != 2:
        raise Error(f"the points have the shape {points.shape}; a table is of one set (n, d)")
    d = points.shape[1]
    names = meta.get("columns") or default_names(d)
    levels = meta.get("levels", {})
    rows = np.asarray(points)
    return {name: (rows[:, k], levels.get(name, [])) for k, name in enumerate(names)}


def _library(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise Error(f"tables need the package {name}, which is not installed") from None


def to_pandas(points: Points) -> Any:
    pandas = _library("pandas")
    columns = _columns(points)
    frame = pandas.DataFrame({
        name: pandas.Categorical.from_codes(numbers.astype(int), words) if words else numbers
        for name, (numbers, words) in columns.items()
    })
    meta = points.meta or {}
    if meta.get("domain") is not None:
        made = {"generator": meta["generator"]} if meta.get("generator") else {}
        frame.attrs["stipple"] = {"domain": meta["domain"], "columns": list(columns), **made}
    return frame


def to_polars(points: Points) -> Any:
    polars = _library("polars")
    return polars.DataFrame([
        polars.Series(name, [words[int(place)] for place in numbers], polars.Enum(words))
        if words else polars.Series(name, numbers)
        for name, (numbers, words) in _columns(points).items()
    ])
