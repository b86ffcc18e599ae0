# SPDX-License-Identifier: MIT
"""Shared by scripts that show every unit: specs of units that need options, and the files that these name."""

import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Specs of units that need options, or would be slow by default.
SPECS = {
    "digital-net": "digital-net:matrices=sobol_4d.txt",
    "optimized": "optimized:effort=0.02",
    "subset": "subset:effort=0.05",
    "expression-1d": "expression-1d:density=[1+sin(9*x)]",
    "expression-2d": "expression-2d:density=[exp(-9*(x-0.3)^2-9*(y-0.6)^2)+0.1]",
    "rejection": "rejection:density=[abs(sin(5*x)*sin(5*y))]",
    "image": "image:file=overview.png",
    "mesh": "mesh:file=octahedron.obj",
    "truncated": "truncated:low=-1,high=2",
    "dirichlet": "dirichlet:alpha=[2,2,2]",
    "simplex": "simplex@1,2",
    "polytope": "polytope:constraints=[x+2*y<=2,x-y>=-0.5,y>=0.1-x/4]",
    "parameters": 'parameters:json=[{"parameters":[{"name":"a","range":[0,1]},{"name":"b","distribution":"normal"}],'
                  '"correlation":{"spearman":[["a","b",0.8]]}}]',
}

CORNERS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
OCTAHEDRON = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
OCTAHEDRON += "".join(f"f {a} {b} {c}\n" for a in (1, 2) for b in (3, 4) for c in (5, 6))


def place_files(folder):
    """Puts the files that SPECS name into a folder."""
    for file in ("sobol_4d.txt", "overview.png"):
        shutil.copy(ROOT / "data" / file, Path(folder) / file)
    (Path(folder) / "octahedron.obj").write_text(OCTAHEDRON)
