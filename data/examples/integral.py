# SPDX-License-Identifier: MIT
# An integral with error bars: random points beside scrambled Sobol' points, at growing numbers of points.
import numpy as np

import stipple


def peak(x):
    return np.exp(-((x - 0.5) ** 2).sum(axis=1))


for n in (64, 256, 1024):
    for sampler in ("random", "sobol:scramble=owen"):
        found = stipple.integrate(peak, sampler, n, d=3, replications=16)
        print(f"{sampler:20} n = {n:5}  {found.estimate:.6f} +- {found.standard_error:.1e}")
