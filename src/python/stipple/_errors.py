# SPDX-License-Identifier: MIT
"""The exception and the warning of the package."""

import re

_NAMES = {"count": "n", "dimension": "d"}


def _plain(message):
    """Options of the command line as names of arguments: "--count: ..." is "n: ..."."""
    return re.sub(
        r"--([a-z][a-z0-9-]*)",
        lambda found: _NAMES.get(found[1], found[1].replace("-", "_")),
        message,
    )


class Error(Exception):
    """What went wrong.

    kind: "usage" (a wrong call), "input" (bad data), "io" (the file system) or "limit" (memory).
    hint: one sentence that helps to mend the call, or "".
    """

    def __init__(self, message, kind="usage", hint=""):
        message, hint = _plain(message), _plain(hint)
        super().__init__(f"{message} ({hint})" if hint else message)
        self.message = message
        self.kind = kind
        self.hint = hint


class Note(UserWarning):
    """A sentence that a user of the command line would see on the terminal."""
