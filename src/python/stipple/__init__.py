# SPDX-License-Identifier: MIT
"""Makes sample sets, warps them, and judges them.

    >>> import stipple
    >>> x = stipple.generate("sobol", n=1024, d=5, scramble="owen", seed=3)
    >>> stipple.analyze("star-discrepancy", x[:, :2]).value  # doctest: +SKIP
    >>> disk = stipple.warp(stipple.generate("halton", n=100), "disk", method="concentric")

Units (generators, scrambles, warps, analyzers) are those of the command line, and so are their options,
with underscores for dashes; list() names them and describe("halton") tells all of one. Points are arrays
(n, d) of float64, the same bytes as those of the command line with the same seed, for any number of
threads. Arguments that most functions take:

    threads     so many; 0: all cores. Results do not depend on it.
    max_memory  bytes that the call may plan to use; 0: any number.
    progress    True draws a bar on stderr; or a function of the share that is done.

Calls let other Python threads run, and Ctrl-C ends them. What is wrong raises Error; what a user should
know is a warning of the category Note.
"""

from ._arrays import Points
from ._errors import Error, Note
from ._stipple import version as __version__
from .calls import (
    analyze,
    generate,
    integrate,
    inverse,
    pdf,
    plot,
    read,
    report,
    scramble,
    sequence,
    study,
    warp,
    write,
)
from .units import describe, list

__all__ = [
    "Error",
    "Note",
    "Points",
    "analyze",
    "describe",
    "generate",
    "integrate",
    "inverse",
    "list",
    "pdf",
    "plot",
    "read",
    "report",
    "scramble",
    "sequence",
    "study",
    "warp",
    "write",
]
