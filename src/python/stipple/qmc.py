# SPDX-License-Identifier: MIT
"""Generators as engines of scipy.stats.qmc."""

import numpy as np
from scipy.stats import qmc as _scipy

from . import _stipple
from ._arrays import settings_of
from ._errors import Error
from .calls import _how, generate
from .units import find


class Engine(_scipy.QMCEngine):
    """Any generator as a scipy.stats.qmc.QMCEngine.

    For a sequence, random(n) returns the next n points, and fast_forward() skips some. For another
    generator, each call returns a new set of n points, with the next seed. reset() starts again.

    generator  name or spec
    seed       a whole number, or a numpy.random.Generator that draws one
    """

    generator = "random"

    def __init__(self, d, *, generator=None, optimization=None, seed=None, **options):
        super().__init__(d=d, optimization=optimization, seed=seed)
        name = generator or self.generator
        if isinstance(seed, (int, np.integer)):
            self._first_seed = int(seed)
        else:
            self._first_seed = int(self.rng.integers(1, 2**63))
        self._name = name
        self._options = options
        unit = find(name.split(":")[0], ["generators"])
        if unit is None:
            generate(name, 1, d)  # raises the error for an unknown name
        self._prefix = unit["traits"]["sequence"] and unit["traits"]["prefix"]
        self._sets = 0
        self._points = None
        if self._prefix:
            self._points = _stipple.Indexed(name, settings_of(options), d, self._first_seed)

    def _random(self, n=1, *, workers=1):
        if self._prefix:
            return self._points.part(self.num_generated, n, _how(workers if workers > 0 else 0))
        self._sets += 1
        return np.array(generate(self._name, n, self.d, seed=self._first_seed + self._sets - 1,
                                 **self._options))

    def reset(self):
        self._sets = 0
        return super().reset()

    def fast_forward(self, n):
        if not self._prefix:
            raise Error(f"{self._name} is not a sequence; each call gives a new set")
        self.num_generated += n
        return self


class Sobol(Engine):
    """Sobol's sequence, scrambled by Owen's method unless scramble=False."""

    generator = "sobol"

    def __init__(self, d, *, scramble=True, optimization=None, seed=None, **options):
        options.setdefault("scramble", "owen" if scramble else "none")
        super().__init__(d, optimization=optimization, seed=seed, **options)

    def random_base2(self, m):
        """2^m points."""
        return self.random(2**m)


class Halton(Engine):
    """Halton's sequence, scrambled by Owen's method unless scramble=False."""

    generator = "halton"

    def __init__(self, d, *, scramble=True, optimization=None, seed=None, **options):
        options.setdefault("scramble", "owen" if scramble else "none")
        super().__init__(d, optimization=optimization, seed=seed, **options)


class LatinHypercube(Engine):
    """Latin hypercubes; with scramble=False points are the centres of their strata."""

    generator = "latin-hypercube"

    def __init__(self, d, *, scramble=True, optimization=None, seed=None, **options):
        options.setdefault("centered", not scramble)
        super().__init__(d, optimization=optimization, seed=seed, **options)


class PoissonDisk(Engine):
    """Maximal Poisson-disk sets of n points."""

    generator = "poisson-disk"
