# SPDX-License-Identifier: MIT
"""The package's exception and warning category."""

import functools
import keyword
import re
from collections.abc import Callable

from . import _stipple

# Patterns of the library's words for the command line, and words for a call, special ones first.
_SAYS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"--unit-cube beside .* --inverse' takes others back",
     "inverse(x, x.meta['domain']) takes them back to the cube"),
    (r"""'stipple warp ("?)([^"]+?)\1 --inverse'""", r"inverse(x, '\2')"),
    (r"warp --inverse|--inverse", "inverse()"),
    (r"'stipple list (\w+)'", r"list('\1')"),
    (r"'stipple (\w+)'", r"\1()"),
    (r"generate --start 1", "start=1"),
    (r"--rescale or --bounds lo\.\.hi", "(x - low) / (high - low)"),
    (r"--meta on the command that wrote them", "return_meta=True where they are made"),
    (r"(?<=with )--column|--column(?= selects)", "x[:, columns]"),
    (r"--column", "pandas.read_csv()"),
    (r": -o 'NAME_\{set\}\.\.\.'", ""),
    (r"(?<![\w-])-([nd]) (?=\d)", r"\1="),
    (r"(?<![\w-])(--count|-n)(?![\w-])", "n"),
    (r"(?<![\w-])(--dimension|-d)(?![\w-])", "d"),
    (r"--output(?![\w-])", "path"),
    (r"--analyze(?![\w-])|^analyze(?=: )", "analyzers"),
    (r"--([a-z][a-z0-9-]*)",
     lambda found: found[1].replace("-", "_") + "_" * keyword.iskeyword(found[1])),
)


@functools.cache
def _options() -> frozenset[str]:
    """Names of options that have dashes and are not also names of units."""
    units = [unit for kind in _stipple.records().values() if isinstance(kind, list) for unit in kind]
    options = {option["name"] for unit in units for option in unit["options"] if "-" in option["name"]}
    return frozenset(options.difference(*((unit["name"], *unit["aliases"]) for unit in units)))


def _argument(found: re.Match[str]) -> str:
    return found[0].replace("-", "_") if found[0] in _options() else found[0]


def in_python(message: str) -> str:
    """A message with arguments and calls instead of options and commands: "n: ...", not "--count: ..."."""
    for pattern, words in _SAYS:
        message = re.sub(pattern, words, message)
    message = re.sub(r"(unknown option ')([^']+)", lambda found: found[1] + found[2].replace("-", "_"), message)
    return re.sub(r"(?:^|(?<=: )|(?<=, )|(?<='))[a-z]\w*(?:-\w+)+(?=: |, |'|$)", _argument, message)


class Error(Exception):
    """An error reported by the library, or a wrong argument.

    kind: "usage" (a wrong call), "input" (bad data), "io" (the file system) or "limit" (memory).
    hint: one sentence on how to correct the call, or "".
    """

    message: str
    kind: str
    hint: str

    def __init__(self, message: str, kind: str = "usage", hint: str = "") -> None:
        message, hint = in_python(message), in_python(hint)
        super().__init__(f"{message} ({hint})" if hint else message)
        self.message = message
        self.kind = kind
        self.hint = hint


class Note(UserWarning):
    """A message that the command line would print for the user."""
