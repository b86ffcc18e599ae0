# SPDX-License-Identifier: MIT
"""Writes the package's type stub, __init__.pyi, from the records of the units: overloads for each unit
with its options, and for any unit with the options of all units. All other types are in the sources.
Usage: stubs.py FOLDER, where FOLDER is the package."""

import ast
import keyword
import sys
from pathlib import Path

TYPES = {
    "flag": "bool",
    "integer": "Whole",
    "number": "Number",
    "text": "str",
    "file": "str | os.PathLike[str]",
    "numbers": "Number | Iterable[Number] | str",
    "points": "Iterable[Iterable[Number]] | NDArray[Any] | str",
    "extents": "str",
}

HEAD = '''# Written by stubs.py, from the records of the units.
import builtins
import os
from collections.abc import Callable, Iterable
from typing import Any, Literal, overload

import pandas  # type: ignore
import polars  # type: ignore
from numpy.typing import ArrayLike, NDArray

from ._arguments import Bounds, Floats, Number, Option, Parameters, Path, Progress, Unit, Units, Whole
from ._frames import Frame
from .calls import PointsLike, Sequence

'''

RUN = "threads: Whole = 0, max_memory: Number = 0, progress: Progress = None"
MADE = ("n: Whole | None = None, d: Whole | None = None, *, {}seed: Whole = 1, start: Whole = 0, bounds: Bounds = None, "
        "warp: Units | None = None, parameters: Parameters = None")
# Return types of generate() by arguments; RESULTS has those for one set, then for several.
KINDS = [("return_meta: Literal[False] = False, as_frame: Literal[False] = False", "Floats"),
         ("return_meta: Literal[True], as_frame: Literal[False] = False", "Points"),
         ("return_meta: bool = False, as_frame: Literal[True, 'pandas']", "pandas.DataFrame"),
         ("return_meta: bool = False, as_frame: Literal['polars']", "polars.DataFrame")]
RESULTS = [
    *(("sets: Literal[1] = 1, " + arguments, result) for arguments, result in KINDS),
    *(("sets: Whole, " + arguments, ("" if "." in result else result + " | ") + f"builtins.list[{result}]")
      for arguments, result in KINDS),
    ("sets: Whole = 1, return_meta: bool = False, as_frame: bool | str = False", "Any"),
]
CALLS = {
    "generators": ("generate", "{}", "generator", MADE.format(""), "Floats"),
    "warps": ("warp", "x: PointsLike, {}", "warp", "*", "Points"),
    "scrambles": ("scramble", "x: PointsLike, {}", "scramble", "*, seed: Whole = 1, start: Whole = 0", "Floats"),
    "analyzers": ("analyze", "{}, x: PointsLike", "analyzer", "*, domain: str | None = None, parameters: Parameters = None", "Report"),
}
# Calls in calls.py with the options of these units.
OTHERS = {"sequence": "generators", "integrate": "generators", "inverse": "warps", "pdf": "warps"}
INTEGRAND = "str | Callable[[Floats], ArrayLike]"


def reexports(folder):
    """The imports of __init__.py, in the form that makes names public in a stub."""
    text = ""
    for node in ast.parse((folder / "__init__.py").read_text()).body:
        if isinstance(node, ast.ImportFrom):
            for name in node.names:
                if name.asname:
                    text += f"{name.asname}: str\n"
                elif name.name not in {*OTHERS, *(call for call, *_ in CALLS.values())}:
                    text += f"from .{node.module} import {name.name} as {name.name}\n"
    return text + "\n"


def type_of(option):
    if option["name"] == "integrand":
        return INTEGRAND
    if option["type"] == "choice":
        return f"Literal[{', '.join(repr(word) for word in option['choices'])}]"
    return TYPES[option["type"]]


def argument_of(option):
    name = option["name"].replace("-", "_")
    return name + "_" * keyword.iskeyword(name)


def all_options(units, given):
    """The options of all units, except arguments that a call already has."""
    names = dict.fromkeys(argument_of(option) for unit in units for option in unit["options"])
    return ", ".join(f"{name}: Option = None" for name in names if f"{name}:" not in given)


def call_text(kind, unit):
    """The overload for a unit's name."""
    function, first, argument, rest, result = CALLS[kind]
    names = ", ".join(repr(name) for name in [unit["name"], *unit["aliases"]])
    options = []
    for option in unit["options"]:
        name = argument_of(option)
        if f"{name}:" not in rest:
            options.append(f"{name}: {type_of(option)} | None = None")
    given = first.format(f"{argument}: Literal[{names}]")
    return (f"@overload\ndef {function}({given}, {', '.join([rest, *options, RUN])}) -> {result}:\n"
            f'    """{unit["summary"]}"""\n')


def any_text(kind, units):
    """The overloads for any spec."""
    function, first, argument, rest, result = CALLS[kind]
    given = first.format(f"{argument}: Unit")
    results = RESULTS if kind == "generators" else [("", result)]
    text = ""
    for arguments, result in results:
        if kind == "generators":
            rest = MADE.format(arguments + ", " if arguments else "")
        extra = f"integrand: {INTEGRAND} | None = None, " if kind == "analyzers" else ""
        arguments = f"{given}, {rest}, {extra}{RUN}"
        text += f"@overload\ndef {function}({arguments}, {all_options(units, arguments)}) -> {result}: ...\n"
    return text


def others_text(folder, records):
    """The calls in OTHERS."""
    text = ""
    for node in ast.parse((folder / "calls.py").read_text()).body:
        if isinstance(node, ast.FunctionDef) and node.name in OTHERS:
            star = "" if node.args.kwonlyargs else "*, "
            arguments = ast.unparse(node.args).replace("**options: Option", star)
            options = all_options(records[OTHERS[node.name]], arguments)
            text += (f"def {node.name}({arguments}{options}) -> {ast.unparse(node.returns)}:\n"
                     f'    """{ast.get_docstring(node, clean=False)}"""\n')
    return text


def main(folder):
    sys.path.insert(0, str(folder))  # the module alone, which needs no NumPy
    import _stipple

    records = _stipple.records()
    text = HEAD + reexports(folder)
    for kind in CALLS:
        text += "".join(call_text(kind, unit) for unit in records[kind])
        scrambles = records["scrambles"] if kind == "warps" else []  # which warp() also takes
        text += any_text(kind, [*records[kind], *scrambles])
    text += others_text(folder, records)
    public = next(ast.literal_eval(node.value) for node in ast.parse((folder / "__init__.py").read_text()).body
                  if isinstance(node, ast.Assign))
    (folder / "__init__.pyi").write_text(f"{text}\n__all__ = {public}\n")


main(Path(sys.argv[1]))
