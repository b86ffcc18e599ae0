# SPDX-License-Identifier: MIT
"""The package's exception and warning category."""

import re

_NAMES = {"count": "n", "dimension": "d"}


def _plain(message: str) -> str:
    """Replaces options of the command line by argument names: "--count: ..." becomes "n: ..."."""
    return re.sub(
        r"--([a-z][a-z0-9-]*)",
        lambda found: _NAMES.get(found[1], found[1].replace("-", "_")),
        message,
    )


class Error(Exception):
    """An error reported by the library, or a wrong argument.

    kind: "usage" (a wrong call), "input" (bad data), "io" (the file system) or "limit" (memory).
    hint: one sentence on how to correct the call, or "".
    """

    message: str
    kind: str
    hint: str

    def __init__(self, message: str, kind: str = "usage", hint: str = "") -> None:
        message, hint = _plain(message), _plain(hint)
        super().__init__(f"{message} ({hint})" if hint else message)
        self.message = message
        self.kind = kind
        self.hint = hint


class Note(UserWarning):
    """A message that the command line would print for the user."""
