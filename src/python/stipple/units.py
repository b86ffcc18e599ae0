# SPDX-License-Identifier: MIT
"""Descriptions of the units, from the same records as the command line's help."""

from __future__ import annotations

import functools
import textwrap
from collections.abc import Iterable
from typing import Any, overload

from . import _stipple
from ._arguments import text
from ._errors import Error, in_python

_KINDS = ("generators", "scrambles", "warps", "analyzers", "formats")


@functools.cache
def records() -> dict[str, dict[str, dict[str, Any]]]:
    """All records: a dictionary of kinds, each a dictionary of units by name."""
    found = _stipple.records()
    return {kind: {unit["name"]: unit for unit in found[kind]} for kind in _KINDS}


@overload
def list(kind: None = None) -> dict[str, dict[str, str]]: ...
@overload
def list(kind: str) -> dict[str, str]: ...
def list(kind: str | None = None) -> dict[str, Any]:
    """Names and summaries of units: a dictionary of one kind ("generators", "scrambles", "warps",
    "analyzers", "formats"), or a dictionary of the dictionaries of all kinds. Raises Error for
    another kind."""
    if kind is None:
        return {kind: list(kind) for kind in _KINDS}
    if text("kind", kind, "a kind of units") not in _KINDS:
        raise Error(f"there is no kind of units {kind!r}; there are {', '.join(_KINDS)}")
    return {name: in_python(unit["summary"]) for name, unit in records()[kind].items()}


def find(name: str, kinds: Iterable[str] = _KINDS) -> dict[str, Any] | None:
    """The record of a unit by name or alias; None if there is none."""
    for kind in kinds:
        for unit in records()[kind].values():
            if name == unit["name"] or name in unit["aliases"]:
                return unit
    return None


def option_text(option: dict[str, Any]) -> str:
    """Describes an option as an argument of a call."""
    name = option["name"].replace("-", "_")
    allowed = "|".join(option.get("choices", ())) or option.get("range", "")
    default = option["default"]
    notes = [option["type"], allowed and f"in {allowed}", f"default {default!r}"]
    head = f"{name}: {', '.join(note for note in notes if note)}"
    return head + "\n" + textwrap.indent(textwrap.fill(option["help"], 92), "    ")


def describe(name: str) -> str:
    """Documents a unit: summary, source, options and results, as a text. Raises Error if there is no
    unit of this name."""
    unit = find(text("name", name, "the name of a unit"))
    if unit is None:
        raise Error(f"there is no unit {name!r}; stipple.list() names all")
    parts = [unit["name"] + ": " + unit["summary"], "Source: " + unit["source"]]
    if unit["aliases"]:
        parts.append("Also called " + ", ".join(unit["aliases"]) + ".")
    parts += [option_text(option) for option in unit["options"]]
    if "results" in unit:
        lines = [f"    {result['key']}: {result['help']}" for result in unit["results"]]
        parts.append("Results\n" + "\n".join(lines))
    return in_python("\n\n".join(parts))
