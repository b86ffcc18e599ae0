# SPDX-License-Identifier: MIT
"""Checks of arguments. Each function returns the value as the library takes it, or raises an Error
that names the argument, the value, and what was expected."""

import operator
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Never, TypeAlias

import numpy as np
from numpy.typing import NDArray

from . import _stipple
from ._errors import Error

Floats: TypeAlias = NDArray[np.float64]
Path: TypeAlias = str | bytes | os.PathLike[str] | os.PathLike[bytes]
Progress: TypeAlias = bool | Callable[[float], object] | None
Whole: TypeAlias = int | np.integer[Any]
Number: TypeAlias = float | np.floating[Any] | np.integer[Any]
Option: TypeAlias = (
    bool | Number | str | os.PathLike[str] | Iterable[Number | str | Iterable[Number]] | None
)
Unit: TypeAlias = str | tuple[str, Mapping[str, Option]]
Units: TypeAlias = Unit | Iterable[Unit]
Bounds: TypeAlias = str | tuple[Number, Number] | Iterable[Iterable[Number]] | NDArray[Any] | None
Parameters: TypeAlias = Path | Mapping[str, Any] | None

MOST = 2**53  # points, and their indices
FLAGS = (bool, np.bool_)
NAMES = ("inputs", "response")  # options whose lists are names of columns, quoted as in CSV


def shown(value: object) -> str:
    """A value in a message, on one line and not too long."""
    try:
        text = " ".join(repr(value).split())
    except Exception:
        text = f"<{type(value).__name__}>"
    text = text.encode("utf-8", "backslashreplace").decode()
    return text if len(text) <= 60 else text[:57] + "..."


def counted(n: int, thing: str) -> str:
    """ "1 name", "2 names"."""
    return f"{n} {thing}{'s' * (n != 1)}"


def refuse(name: str, value: object, expected: str, hint: str = "") -> Never:
    raise Error(f"{name} is {shown(value)}; expected {expected}", hint=hint)


def whole(name: str, value: object, low: int = 0, high: int = MOST, hint: str = "") -> int:
    """A whole number in [low, high]. As in NumPy, 10.0 is not one: a float is the result of
    arithmetic, whose rounding would decide whether it is accepted."""
    most = {MOST: "2^53", 2**64 - 1: "2^64 - 1"}.get(high, high)
    expected = f"a whole number from {low} to {most}"
    try:
        if isinstance(value, FLAGS):
            raise TypeError
        number = operator.index(value)  # type: ignore[arg-type]
    except Exception:
        if isinstance(value, (float, np.floating)) and value.is_integer():
            hint = hint or f"write {int(value)}, or int(...) around the computation"
        refuse(name, value, expected, hint)
    if not low <= number <= high:
        refuse(name, value, expected, hint)
    return number


def whole_or_none(name: str, value: object, low: int = 0, high: int = MOST) -> int | None:
    return None if value is None else whole(name, value, low, high)


def seed_of(value: object, name: str = "seed") -> int:
    hint = "equal seeds give equal points; for others each time, pass secrets.randbits(63)"
    return whole(name, value, 0, 2**64 - 1, hint if value is None else "")


def real(name: str, value: object, low: float, high: float, expected: str) -> float:
    """A finite number in [low, high]."""
    try:
        if isinstance(value, (*FLAGS, str, bytes)):
            raise TypeError
        number = float(value)  # type: ignore[arg-type]
    except Exception:
        refuse(name, value, expected)
    if not low <= number <= high:
        refuse(name, value, expected)
    return number


def is_masked(x: object) -> bool:
    """Whether elements of an array, or of a list of arrays, are masked; np.asarray() would take them."""
    parts = x if isinstance(x, (list, tuple)) else [x]
    return any(isinstance(one, np.ma.MaskedArray) and bool(one.mask.any()) for one in parts)


def flag(name: str, value: object) -> bool:
    if not isinstance(value, FLAGS):
        refuse(name, value, "True or False")
    return bool(value)


def text(name: str, value: object, expected: str = "a text") -> str:
    if not isinstance(value, str):
        refuse(name, value, expected)
    try:
        value.encode()
    except UnicodeError:
        refuse(name, value, f"{expected} of valid Unicode characters")
    if "\0" in value:
        refuse(name, value, f"{expected} without null characters")
    return value


def path(name: str, value: object) -> str:
    """A file's name. Names that are not Unicode keep their bytes by surrogates, as in os.fsdecode."""
    try:
        found = os.fsdecode(value)  # type: ignore[arg-type]
    except Exception:
        hint = "pass its name instead" if hasattr(value, "read") else ""
        refuse(name, value, "the name of a file", hint)
    if "\0" in found or not found:
        refuse(name, value, "the name of a file")
    return found


def run_options(threads: object = 0, max_memory: object = 0,
                progress: object = None) -> _stipple.How:
    """Checks the arguments that most calls have."""
    if not (progress is None or isinstance(progress, FLAGS) or callable(progress)):
        refuse("progress", progress, "True, or a function of the fraction done")
    if isinstance(progress, FLAGS):
        progress = _bar if progress else None
    memory = real("max_memory", max_memory, 0, 2.0**63, "a number of bytes; 0: the machine's")
    return _stipple.How(whole("threads", threads, 0, 4096), memory, progress)


def _bar(share: float) -> None:
    done = int(30 * share)
    end = "\r\033[K" if share >= 1 else ""
    sys.stderr.write(f"\r[{'=' * done}{' ' * (30 - done)}] {100 * share:3.0f} %{end}")
    sys.stderr.flush()


def _option_text(name: str, value: object, depth: int = 2) -> str:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, FLAGS):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)) and abs(int(value)) < 2**64:
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, str):
        return text(name, value)
    if isinstance(value, os.PathLike):
        return path(name, value)
    if isinstance(value, (list, tuple, range)) and depth:
        rows = any(isinstance(row, (list, tuple, np.ndarray)) for row in value)
        parts = [_option_text(name, one, depth - 1) for one in value]
        if name in NAMES:
            parts = ['"' + part.replace('"', '""') + '"' for part in parts]
        return (" " if rows else ",").join(parts)
    refuse(name, value, "a number, a text, True or False, or a list of these")


def settings_of(options: Mapping[str, object]) -> list[tuple[str, str]]:
    """Keyword arguments as options: names with dashes, values as text; None values are omitted."""
    return [
        (text("an option", name).rstrip("_").replace("_", "-"), _option_text(name, value))
        for name, value in options.items()
        if value is not None
    ]


def spec_text(name: str, value: object) -> str:
    """The spec of a unit: "disk", "disk:method=concentric", or ("disk", {"method":
    "concentric"})."""
    expected = 'the name of a unit, such as "sobol:order=gray", or ("sobol", {"order": "gray"})'
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], Mapping):
        settings = ",".join(f"{key}=[{setting}]" for key, setting in settings_of(value[1]))
        return text(name, value[0], expected) + (f":{settings}" if settings else "")
    return text(name, value, expected)


def listed(name: str, value: object) -> list[str]:
    """Specs of units: of one, or of several."""
    if value is None:
        return []
    single = isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], Mapping)
    if single or isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable):
        return [spec_text(name, value)]
    return [spec_text(f"{name}[{i}]", one) for i, one in enumerate(value)]


def wholes(name: str, value: object, low: int = 1, high: int = MOST) -> list[int]:
    """Whole numbers: one, or several."""
    single = hasattr(value, "__index__") and np.ndim(value) == 0  # type: ignore[arg-type]
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable) or single:
        return [whole(name, value, low, high)]
    found = [whole(f"{name}[{i}]", one, low, high) for i, one in enumerate(value)]
    return found or refuse(name, value, "at least one number")


def bounds_text(bounds: object) -> str:
    """Formats bounds: (low, high) for all coordinates, a list of such pairs, or "0..1,0..2"."""
    if bounds is None:
        return ""
    if isinstance(bounds, str):
        return text("bounds", bounds)
    expected = "(low, high), or one such pair for each coordinate"
    try:
        pairs = np.asarray(bounds)
        if pairs.dtype.kind not in "fiu":
            raise TypeError
    except Exception:
        refuse("bounds", bounds, expected)
    if pairs.shape == (2,):
        pairs = pairs[None]
    if pairs.ndim != 2 or pairs.shape[1] != 2 or not len(pairs):
        refuse("bounds", bounds, expected)
    if not (np.isfinite(pairs).all() and (pairs[:, 0] < pairs[:, 1]).all()):
        refuse("bounds", bounds, "low < high, both finite")
    return ",".join(f"{low!r}..{high!r}" for low, high in pairs.astype(float).tolist())
