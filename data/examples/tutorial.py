# SPDX-License-Identifier: MIT
# %% [markdown]
# # Ten minutes in Python: make points, warp them, measure them
#
# To integrate a function, to render a picture or to explore a model, you must choose the points
# at which to evaluate it. stipple makes such points, as NumPy arrays. Run this file as a script,
# or cell by cell in Jupyter or Visual Studio Code, where you also see the pictures.
#
# The first cell makes four points of a Sobol' sequence. Each row is a point of the unit square,
# with its coordinates x and y.
# %%
import numpy as np

import stipple

print(stipple.generate("sobol", 4))

# %% [markdown]
# The first point has the index 0 and is the corner 0,0. This corner is a bad place for some
# functions: 1/x is infinite there. A scramble makes the digits of the coordinates random, but
# keeps the structure that makes the set even. The numbers depend only on the call and its seed
# (1 by default), so you see the same ones on any machine.
# %%
print(stipple.generate("sobol", 4, scramble="owen"))

# %% [markdown]
# ## Compare by eye
#
# How should 256 points be placed? This cell makes a set with each of four generators and draws
# the first set. `random` has clumps and gaps, because nothing keeps independent points apart.
# %%
samplers = ["random", "jittered", "sobol:scramble=owen", "poisson-disk"]
sets = {name: stipple.generate(name, 256) for name in samplers}
print(", ".join(f"{name}: {len(points)} points" for name, points in sets.items()))
stipple.plot(sets["random"], width=400)

# %% [markdown]
# `jittered` cuts the square into 16 x 16 cells, called strata. It puts one point at random into
# each cell, so there are no large gaps. Two points in neighbouring cells can still be close
# together.
# %%
stipple.plot(sets["jittered"], width=400)

# %% [markdown]
# `sobol` also has one point in every cell of that grid. The same is true of every other grid of
# 256 equal cells with 1, 2, 4, ... or 256 columns.
# %%
stipple.plot(sets["sobol:scramble=owen"], width=400)

# %% [markdown]
# `poisson-disk` keeps a minimum distance between any two points. To the eye it looks the most
# even.
# %%
stipple.plot(sets["poisson-disk"], width=400)

# %% [markdown]
# ## Measure
#
# The star discrepancy measures evenness by a number. It looks at all boxes that begin in the
# corner 0,0. In each box, it compares the fraction of the points inside with the area of the box.
# The largest difference is the star discrepancy. Lower is better. `analyze` returns a report, and
# its results are attributes. (The function `scipy.stats.qmc.discrepancy` computes a different
# measure: the squared L2 discrepancies of the analyzer `l2-discrepancy`.)
# %%
for name, points in sets.items():
    found = stipple.analyze("star-discrepancy", points)
    print(f"{name:20} {found.value:.4f}")

report = stipple.analyze("star-discrepancy", sets["random"])
worst = report.worst_box
print(f"\nThe worst box of random has {worst.points} of 256 points on {worst.volume:.1%} of the area.")

# %% [markdown]
# A spectrum shows evenness at every scale. Low frequencies belong to large distances, and high
# frequencies to small ones. The curve gives the power at each frequency. Where the power is low,
# the set has neither clumps nor gaps of that size. Independent points have a power of about 1 at
# all frequencies, and chance moves their curve within the grey band. `poisson-disk` has little
# power at low frequencies. Its peak belongs to the distance between neighbouring points. Such sets
# are called blue noise. The lower curves show whether the power depends on the direction. Here it
# does not.
# %%
spectra = {name: stipple.analyze("periodogram", sets[name]) for name in ("random", "poisson-disk")}
for name, spectrum in spectra.items():
    print(f"{name:13} mean power below frequency 8: {spectrum.radial.power[:7].mean():.3f}")
stipple.plot(spectra)

# %% [markdown]
# ## Warp
#
# Few problems have a square as their domain. A warp moves points from the unit square onto another
# domain. The warp `disk` maps parts of equal area to parts of equal area, so an even set stays
# even. A grid shows best how a warp deforms the square: by default, its columns become circles and
# its rows become rays.
# %%
grid = stipple.generate("grid", 100)
stipple.plot(stipple.warp(grid, "disk"), width=400)

# %% [markdown]
# The concentric method maps squares around the centre to circles. Both methods cover the disk
# evenly, but the concentric method keeps neighbours closer together.
# %%
stipple.plot(stipple.warp(grid, "disk", method="concentric"), width=400)

# %% [markdown]
# `generate` can also warp the points. With `return_meta`, the array gets a dictionary `meta` that
# says how the points were made. From it, later calls know that the points lie on a disk. `save`
# writes a picture to a file.
# %%
disk = stipple.generate("sobol", 256, scramble="owen", warp="disk", return_meta=True)
print(f"domain: {disk.meta['domain']}, warps: {disk.meta['warps']}, seed: {disk.meta['seed']}")
stipple.plot(disk, width=400).save("disk.svg")
stipple.plot(disk, width=400)

# %% [markdown]
# ## Test the warp
#
# A common mistake is to use x itself as the distance from the centre, instead of the square root
# of x. Half of the points then lie within half the radius, which is only a quarter of the area.
# stipple contains this wrong warp for teaching, as the method `naive`.
#
# The chi-square test finds such a mistake. It counts the points in cells, and compares each count
# with the expected one, which is proportional to the area of the cell. The verdict is *uniform* if
# the counts vary as much as those of random points. It is *non-uniform* if they vary more, and
# *stratified* if they vary less. A stratified set is more even than random points would be.
# %%
right = stipple.warp(sets["random"], "disk")
wrong = stipple.warp(sets["random"], "disk", method="naive")
for name, points in {"right": right, "wrong": wrong, "sobol": disk}.items():
    test = stipple.analyze("chi-square", points)
    print(f"{name:6} statistic {test.statistic:5.1f}, degrees of freedom {test.degrees_of_freedom:.0f}: {test.verdict}")

# %% [markdown]
# ## Integrate, with an error bar
#
# What is the average distance of the points of the disk from one point on its rim? It is the
# integral of this distance over the disk, divided by the area, which is pi. `integrate` estimates
# the integral, not the average. It makes 16 independent sets of 256 points, because the error of a
# single set would be unknown. The spread of the 16 estimates gives the standard error. Your
# function gets all points of a set at once, as an array.
# %%
def distance(points):
    return np.hypot(points[:, 0] - 1, points[:, 1])


errors = {}
for name in ("random", "sobol:scramble=owen"):
    integral = stipple.integrate(distance, name, 256, 2, warp="disk")
    errors[name] = integral.standard_error
    print(f"{name:20} {integral.estimate:.5f} +- {integral.standard_error:.5f}   (exact: {32 / 9:.5f})")
print(f"average distance: {integral.estimate / np.pi:.4f}")

# %% [markdown]
# The error of n random points is proportional to 1 / sqrt(n). How many times as many random points
# would you need to match the Sobol' points?
# %%
gain = errors["random"] / errors["sobol:scramble=owen"]
print(f"{gain:.0f} times more precise; random needs about {round(gain**2, -2):.0f} times as many points.")

# %% [markdown]
# ## Compare on one page, and keep the points
#
# `report` writes all measures with pictures to one HTML page. Read the table at the top first.
# `write` with `meta=True` writes the dictionary of the points into the file as well. In a shell,
# `stipple reproduce disk.csv` then makes the same points again. The last lines do so in Python.
# %%
stipple.report("report.html", {name: sets[name] for name in ("random", "sobol:scramble=owen")})
stipple.write("disk.csv", disk, meta=True)
kept = stipple.read("disk.csv")
made = kept.meta
again = stipple.generate(made["generator"], made["count"], seed=made["seed"], warp=made["warps"], **made["options"])
print(f"{made['count']} points of {made['generator']}, {made['options']}, warps {made['warps']}")
print("The same points again:", np.array_equal(kept, again))
