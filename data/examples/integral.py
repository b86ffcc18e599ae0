# SPDX-License-Identifier: MIT
# %% [markdown]
# An integral with error bars. The integrand is a peak in the middle of the cube; random points stand
# beside scrambled Sobol' points.
# %%
import numpy as np

import stipple


def peak(x):
    return np.exp(-((x - 0.5) ** 2).sum(axis=1))


# %% [markdown]
# Sixteen sets with seeds of their own give sixteen estimates, whose spread tells the error of their mean.
# %%
for n in (64, 256, 1024):
    for sampler in ("random", "sobol:scramble=owen"):
        found = stipple.integrate(peak, sampler, n, d=3, replications=16)
        print(f"{sampler:20} n = {n:5}  {found.estimate:.6f} +- {found.standard_error:.1e}")

# %% [markdown]
# Where they come from: the first two coordinates of both samplers.
# %%
samplers = ("random", "sobol:scramble=owen")
stipple.plot({name: stipple.generate(name, 256, 2) for name in samplers})
