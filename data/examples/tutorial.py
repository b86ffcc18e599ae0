# SPDX-License-Identifier: MIT
# %% [markdown]
# # Ten minutes in Python: make points, warp them, measure them
#
# To integrate a function, to render a picture or to explore a model, you must choose the points
# at which to evaluate it. stipple makes such points, as NumPy arrays. Here are four, from a Sobol'
# sequence. Each row is a point of the unit square, with its coordinates x and y.
# %%
import numpy as np

import stipple

print(stipple.generate("sobol", 4))

# %% [markdown]
# The first point, that of index 0, is the corner 0,0: an unfortunate place for functions such as
# 1/x. Scrambling makes the digits of the coordinates random, and keeps the structure that makes
# the set even. The numbers depend on nothing but the call and its seed (1 by default), so you see
# the same ones on any machine.
# %%
print(stipple.generate("sobol", 4, scramble="owen"))

# %% [markdown]
# ## Compare by eye
#
# How should 256 points be placed? Four generators answer differently. `random` has clumps and
# gaps, because nothing keeps independent points apart.
# %%
samplers = ["random", "jittered", "sobol:scramble=owen", "poisson-disk"]
sets = {name: stipple.generate(name, 256) for name in samplers}
print(", ".join(f"{name}: {len(points)} points" for name, points in sets.items()))
stipple.plot(sets["random"], width=400)

# %% [markdown]
# `jittered` cuts the square into 16 x 16 cells, called strata, and puts one point at random into
# each. Large gaps are gone, but two points can still meet at an edge.
# %%
stipple.plot(sets["jittered"], width=400)

# %% [markdown]
# `sobol` has one point in every cell of that grid, too, and of every other grid of 256 equal cells
# with 1, 2, 4, ... or 256 columns.
# %%
stipple.plot(sets["sobol:scramble=owen"], width=400)

# %% [markdown]
# `poisson-disk` keeps a least distance between any two points. To the eye it looks the most even.
# %%
stipple.plot(sets["poisson-disk"], width=400)

# %% [markdown]
# ## Measure
#
# The star discrepancy makes evenness a number. Of all boxes that begin in the corner 0,0, it takes
# the one in which the fraction of the points differs most from the area, and that difference is
# the star discrepancy. Lower is better. `analyze` returns a report; its results are attributes.
# %%
for name, points in sets.items():
    found = stipple.analyze("star-discrepancy", points)
    print(f"{name:20} {found.value:.4f}")

report = stipple.analyze("star-discrepancy", sets["random"])
worst = report.worst_box
print(f"\nThe worst box of random has {worst.points} of 256 points on {worst.volume:.1%} of the area.")

# %% [markdown]
# A spectrum shows evenness at every scale: low frequencies are large distances, and independent
# points have a power of about 1 at all of them, up to chance (the grey band). Where the power is
# low, the set has neither clumps nor gaps of that size. `poisson-disk` has little power at low
# frequencies, and a peak near the frequency that belongs to the distance between its points. Such
# sets are called blue noise. (The lower curves tell whether directions differ; here they do not.)
# %%
spectra = {name: stipple.analyze("periodogram", sets[name]) for name in ("random", "poisson-disk")}
for name, spectrum in spectra.items():
    print(f"{name:13} mean power below frequency 8: {spectrum.radial.power[:7].mean():.3f}")
stipple.plot(spectra)

# %% [markdown]
# ## Warp
#
# Few problems live in a square. A warp moves points from the unit square onto another domain, here
# a disk, and takes parts of equal area to parts of equal area. A grid shows best what happens: by
# default, its columns become circles and its rows become rays.
# %%
grid = stipple.generate("grid", 100)
stipple.plot(stipple.warp(grid, "disk"), width=400)

# %% [markdown]
# The concentric method turns squares around the centre into circles. Both methods cover the disk
# evenly; this one keeps neighbours closer together.
# %%
stipple.plot(stipple.warp(grid, "disk", method="concentric"), width=400)

# %% [markdown]
# Points can also be warped while they are generated. With `return_meta` they carry a dictionary
# that says how they were made; from it, later calls know that the points lie on a disk.
# %%
disk = stipple.generate("sobol", 256, scramble="owen", warp="disk", return_meta=True)
print(f"domain: {disk.meta['domain']}, warps: {disk.meta['warps']}, seed: {disk.meta['seed']}")
stipple.plot(disk, width=400)

# %% [markdown]
# ## Test the warp
#
# A common mistake is to take x itself as the distance from the centre, where its square root is
# due: half of the points are then on a quarter of the area. stipple has this wrong warp, too, as
# the method `naive`. The chi-square test counts the points in cells, and compares with the counts
# that the areas call for. Its verdict is *uniform* if the counts vary as much as those of random
# points do, *non-uniform* if they vary too much, and *stratified* if they vary less: the set is
# then more even than chance would make it.
# %%
right = stipple.warp(sets["random"], "disk")
wrong = stipple.warp(sets["random"], "disk", method="naive")
for name, points in {"right": right, "wrong": wrong, "sobol": disk}.items():
    test = stipple.analyze("chi-square", points)
    print(f"{name:6} statistic {test.statistic:5.1f}, degrees of freedom {test.degrees_of_freedom:.0f}: {test.verdict}")

# %% [markdown]
# ## Integrate, with an error bar
#
# How far are the points of the disk from one point on its rim, on average? That is an integral
# over the disk, divided by the area, pi. A single set would give an estimate, but no idea of its
# error. `integrate` takes 16 independent sets, and works out a standard error from the scatter of
# their estimates. The function gets all points of a set at once, as an array.
# %%
def distance(points):
    return np.hypot(points[:, 0] - 1, points[:, 1])


errors = {}
for name in ("random", "sobol:scramble=owen"):
    integral = stipple.integrate(distance, name, 256, 2, warp="disk")
    errors[name] = integral.standard_error
    print(f"{name:20} {integral.estimate:.5f} +- {integral.standard_error:.5f}   (exact: {32 / 9:.5f})")

# %% [markdown]
# The error of random points falls with the square root of their number. How many times as many
# would have to be taken to be as precise as the Sobol' points?
# %%
gain = errors["random"] / errors["sobol:scramble=owen"]
print(f"{gain:.0f} times more precise; random needs about {round(gain**2, -2):.0f} times as many points.")

# %% [markdown]
# ## Compare on one page, and keep the points
#
# `report` writes all measures with pictures to one HTML page: read the table at the top first. A
# file with its meta data says how its points were made, so `stipple reproduce disk.csv` can make
# them again in a shell, and so can you.
# %%
stipple.report("report.html", {name: sets[name] for name in ("random", "sobol:scramble=owen")})
stipple.write("disk.csv", disk, meta=True)
kept = stipple.read("disk.csv")
made = kept.meta
again = stipple.generate(made["generator"], made["count"], seed=made["seed"], warp=made["warps"], **made["options"])
print(f"{made['count']} points of {made['generator']}, {made['options']}, warps {made['warps']}")
print("The same points again:", np.array_equal(kept, again))
