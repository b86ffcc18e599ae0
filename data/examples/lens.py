# SPDX-License-Identifier: MIT
# Points on a lens: a blue-noise set on a disk, judged there, drawn, and given back to the square.
import numpy as np

import stipple

square = stipple.generate("poisson-disk", n=500, seed=2)
lens = stipple.warp(square, "disk", method="concentric", radius=2)
print(stipple.analyze("nearest-neighbor", lens))
print(stipple.analyze("chi-square", lens).verdict)
stipple.plot(lens).save("lens.svg")
back = stipple.inverse(lens, "disk", method="concentric", radius=2)
print("largest difference after the way back:", np.abs(back - square).max())
