# SPDX-License-Identifier: MIT
# %% [markdown]
# Points on a lens, as for depth of field: a blue-noise set of the square, warped to a disk.
# %%
import numpy as np

import stipple

square = stipple.generate("poisson-disk", n=500, seed=2)
lens = stipple.warp(square, "disk", method="concentric", radius=2)
stipple.plot(lens)

# %% [markdown]
# The points know that they live on a disk, so they are judged there: how far neighbours are, and
# whether equal areas have equal shares.
# %%
print(stipple.analyze("nearest-neighbor", lens))
print(stipple.analyze("chi-square", lens).verdict)

# %% [markdown]
# The way back gives the points of the square, but for rounding.
# %%
back = stipple.inverse(lens, "disk", method="concentric", radius=2)
print("largest difference after the way back:", np.abs(back - square).max())
