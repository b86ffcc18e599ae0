# SPDX-License-Identifier: MIT
"""Writes the type stubs of the package's calls, __init__.pyi, from the records of the units. Usage:
stubs.py FOLDER, where FOLDER is the package."""

import keyword
import sys
from pathlib import Path

TYPES = {
    "flag": "bool",
    "integer": "int",
    "number": "float",
    "text": "str",
    "file": "str | os.PathLike[str]",
    "numbers": "float | Sequence[float] | str",
    "points": "Sequence[Sequence[float]] | str",
    "extents": "str",
}

HEAD = '''# Written by stubs.py, from the records of the units.
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
__version__: str

class Error(Exception):
    message: str
    kind: Literal["usage", "input", "io", "limit", "cancelled"]
    hint: str

class Note(UserWarning): ...

class Points(np.ndarray[Any, np.dtype[np.float64]]):
    meta: Any

class Report(Mapping[str, Any]):
    unmet: list[str]
    def __getitem__(self, key: str) -> Any: ...
    def __getattr__(self, name: str) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

class Picture:
    @property
    def svg(self) -> str: ...
    def save(self, path: str | os.PathLike[str]) -> None: ...

class Page:
    path: str

class PointSequence:
    d: int
    def __getitem__(self, index: int | slice) -> Floats: ...
    def blocks(self, size: int, start: int = 0) -> Iterator[Floats]: ...
    def __iter__(self) -> Iterator[Floats]: ...

class Integral(NamedTuple):
    estimate: float
    standard_error: float
    low: float
    high: float
    estimates: Floats

Progress = bool | Callable[[float], object] | None
Unit = str | tuple[str, Mapping[str, Any]]

'''

TAIL = '''def inverse(x: ArrayLike, warp: Unit, **options: Any) -> Floats: ...
def pdf(x: ArrayLike, warp: Unit, **options: Any) -> Floats: ...
def sequence(generator: str, d: int | None = None, *, seed: int = 1, **options: Any) -> PointSequence: ...
def integrate(function: Callable[[Floats], ArrayLike], generator: str, n: int, d: int, *, replications: int = 16, seed: int = 1, confidence: float = 0.95, warp: Unit | None = None, **options: Any) -> Integral: ...
def read(path: str | os.PathLike[str], *, format: str = "", d: int = 0, single: bool = False, {RUN}) -> Any: ...
def write(path: str | os.PathLike[str], x: Any, *, domain: str | None = None, format: str = "", header: bool = True, meta: bool = False, single: bool = False, precision: int | None = None, {RUN}) -> None: ...
def study(generators: Any, analyzers: Any, *, n: Any = ..., d: Any = ..., seeds: int = 1, seed: int = 1, warp: Any = None, keys: str | Sequence[str] = (), {RUN}) -> Any: ...
def report(path: str | os.PathLike[str], x: Any, *, {RUN}) -> Page: ...
def plot(x: Any, ax: Any = None, *, key: str = "", width: float = 0, height: float = 0, title: str | None = None, labels: str | Sequence[str] | None = None, {RUN}) -> Any: ...
def describe(name: str) -> str: ...
def list(kind: str | None = None) -> dict[str, Any]: ...
'''

RUN = "threads: int = 0, max_memory: float = 0, progress: Progress = None"
CALLS = {
    "generators": ("generate", "generator", "n: int | None = None, d: int | None = None, *, seed: int = 1, "
                   "start: int = 0, sets: int = 1, bounds: Any = None, warp: Any = None, "
                   "parameters: Any = None, return_meta: bool = False", "Any"),
    "warps": ("warp", "warp", "*", "Points"),
    "scrambles": ("scramble", "scramble", "*, start: int = 0", "Floats"),
    "analyzers": ("analyze", "analyzer", "*, domain: Any = None", "Report"),
}


def type_of(option):
    if option["type"] == "choice":
        return f"Literal[{', '.join(repr(word) for word in option['choices'])}] | str"
    return TYPES.get(option["type"], "Any")


def call_text(kind, unit):
    """The overload for a unit's name."""
    function, argument, rest, result = CALLS[kind]
    names = ", ".join(repr(name) for name in [unit["name"], *unit["aliases"]])
    first = f"{argument}: Literal[{names}]"
    if kind == "warps" or kind == "scrambles":
        first = f"x: ArrayLike, {first}"
    elif kind == "analyzers":
        first += ", x: ArrayLike"
    options = []
    for option in unit["options"]:
        name = option["name"].replace("-", "_")
        if keyword.iskeyword(name):
            name += "_"
        type_name = "Any" if name == "integrand" else type_of(option)
        options.append(f"{name}: {type_name} | None = ...")
    if kind == "scrambles" and not any(text.startswith("seed:") for text in options):
        options.append("seed: int = 1")
    return (f"@overload\ndef {function}({first}, {', '.join([rest, *options, RUN])}) -> {result}:\n"
            f'    """{unit["summary"]}"""\n')


def any_text(kind):
    """The overload for any spec."""
    function, argument, rest, result = CALLS[kind]
    first = {"warps": f"x: ArrayLike, {argument}: Unit", "scrambles": f"x: ArrayLike, {argument}: Unit",
             "analyzers": f"{argument}: str, x: ArrayLike"}.get(kind, f"{argument}: str")
    seed = ", seed: int = 1" if kind == "scrambles" else ""
    return f"@overload\ndef {function}({first}, {rest}{seed}, **options: Any) -> {result}: ...\n".replace(
        "*, **options", "**options")


def main(folder):
    sys.path.insert(0, str(folder))  # the module alone, which needs no NumPy
    import _stipple

    records = _stipple.records()
    text = HEAD
    for kind in CALLS:
        text += "".join(call_text(kind, unit) for unit in records[kind]) + any_text(kind)
    (folder / "__init__.pyi").write_text(text + TAIL.replace("{RUN}", RUN))


main(Path(sys.argv[1]))
