# SPDX-License-Identifier: MIT
"""Descriptions of the units, from the same records as the command line's help."""

import functools
import textwrap

from . import _stipple
from ._errors import Error

_KINDS = ("generators", "scrambles", "warps", "analyzers", "formats")


@functools.cache
def records():
    """All records: a dictionary of kinds, each a dictionary of units by name."""
    found = _stipple.records()
    return {kind: {unit["name"]: unit for unit in found[kind]} for kind in _KINDS}


def list(kind=None):
    """Names and summaries of units: of one kind ("generators", "scrambles", "warps", "analyzers",
    "formats"), or of all kinds in a dictionary."""
    if kind is None:
        return {kind: list(kind) for kind in _KINDS}
    if kind not in _KINDS:
        raise Error(f"there is no kind of units {kind!r}; there are {', '.join(_KINDS)}")
    return {name: unit["summary"] for name, unit in records()[kind].items()}


def find(name, kinds=_KINDS):
    """The record of a unit by name or alias; None if there is none."""
    for kind in kinds:
        for unit in records()[kind].values():
            if name == unit["name"] or name in unit["aliases"]:
                return unit
    return None


def option_text(option):
    """Describes an option as an argument of a call."""
    name = option["name"].replace("-", "_")
    allowed = "|".join(option.get("choices", ())) or option.get("range", "")
    default = option["default"]
    notes = [option["type"], allowed and f"in {allowed}", f"default {default!r}"]
    head = f"{name}: {', '.join(note for note in notes if note)}"
    return head + "\n" + textwrap.indent(textwrap.fill(option["help"], 92), "    ")


def describe(name):
    """Documents a unit: summary, source, options and results."""
    unit = find(name)
    if unit is None:
        raise Error(f"there is no unit {name!r}; stipple.list() names all")
    parts = [unit["name"] + ": " + unit["summary"], "Source: " + unit["source"]]
    if unit["aliases"]:
        parts.append("Also called " + ", ".join(unit["aliases"]) + ".")
    parts += [option_text(option) for option in unit["options"]]
    if "results" in unit:
        lines = [f"    {result['key']}: {result['help']}" for result in unit["results"]]
        parts.append("Results\n" + "\n".join(lines))
    return "\n\n".join(parts)
