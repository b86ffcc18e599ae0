# SPDX-License-Identifier: MIT
"""Makes sample sets, warps them, and judges them.

    >>> import stipple
    >>> x = stipple.generate("sobol", n=1024, d=5, scramble="owen", seed=3)
    >>> stipple.analyze("star-discrepancy", x[:, :2]).value  # doctest: +SKIP
    >>> disk = stipple.warp(stipple.generate("halton", n=100), "disk", method="concentric")

Units (generators, scrambles, warps, analyzers) and their options are those of the command line,
with underscores instead of dashes; list() names them, and describe("halton") documents one. Points
are arrays (n, d) of float64: the same bytes as from the command line with the same seed, for any
number of threads. Most functions accept these arguments:

  threads     number of threads; 0: all cores. Results do not depend on it.
  max_memory  memory limit in bytes; 0: four fifths of the machine's.
  progress    True draws a bar on stderr; or a function that is called with the fraction done.

Calls let other Python threads run, and Ctrl-C interrupts them. Wrong arguments and other errors are
raised as Error; notes to the user are warnings of the category Note. In a process forked from one
that had already made calls, all calls use one thread.
"""

from ._arrays import Points
from ._errors import Error, Note
from ._reports import Page, Picture, Report
from ._stipple import version as __version__
from .calls import (
    Integral,
    Sequence,
    Study,
    StudyMean,
    StudyValue,
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
    "Integral",
    "Note",
    "Page",
    "Picture",
    "Points",
    "Report",
    "Sequence",
    "Study",
    "StudyMean",
    "StudyValue",
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
