# SPDX-License-Identifier: MIT
"""The names of scipy.stats.qmc with stipple's points and measures: `from stipple import qmc`.

Calls, checks, warnings and errors (ValueError) are SciPy's; its documentation applies, except where
this one differs. Engines are QMCEngines, so that SciPy's own functions accept them. Their points
are those of stipple.generate(): reproducible from the seed, but not the points that SciPy makes of
it. QMCEngine, scale() and update_discrepancy() are SciPy's own.

seed or rng of an engine or a function, at most one of them:
  seed=5                          the seed, as for stipple.generate(); from 0 to 2^64 - 1
  seed=Generator or RandomState   draws the seed
  rng=5, Generator, ...           numpy.random.default_rng(rng) draws the seed
  None                            an unpredictable seed

workers is the number of threads, -1 for all cores. Results do not depend on it.
"""

from __future__ import annotations

import inspect
import math
import numbers
import os
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

try:
    import scipy.stats.qmc as _scipy  # type: ignore[import]
except ModuleNotFoundError as error:
    raise ImportError("stipple.qmc needs the package scipy, which is not installed") from error
from scipy.sparse.csgraph import minimum_spanning_tree  # type: ignore[import]
from scipy.spatial.distance import pdist, squareform  # type: ignore[import]
from scipy.stats.qmc import QMCEngine, scale, update_discrepancy

from . import _stipple
from ._arguments import Floats, Option, Whole, settings_of
from ._bridson import Bridson
from .calls import _how, analyze, generate
from .calls import scramble as _scrambled
from .units import find, records

__all__ = [
    "Engine",
    "Halton",
    "LatinHypercube",
    "MultinomialQMC",
    "MultivariateNormalQMC",
    "PoissonDisk",
    "QMCEngine",
    "Sobol",
    "check_random_state",
    "discrepancy",
    "geometric_discrepancy",
    "n_primes",
    "primes_from_2_to",
    "scale",
    "update_discrepancy",
    "van_der_corput",
]

Seed: TypeAlias = Whole | np.random.Generator | np.random.RandomState | None
Rng: TypeAlias = (Whole | Sequence[int] | NDArray[np.integer[Any]] | None
                  | np.random.SeedSequence | np.random.BitGenerator | np.random.Generator)

_SEED = "rng" if "rng" in inspect.signature(QMCEngine.__init__).parameters else "seed"


def check_random_state(seed: Seed = None) -> np.random.Generator | np.random.RandomState:
    """A Generator made of None or a whole number; a Generator or RandomState itself."""
    if seed is None or isinstance(seed, numbers.Integral):
        return np.random.default_rng(None if seed is None else int(seed))
    if isinstance(seed, (np.random.Generator, np.random.RandomState)):
        return seed
    raise ValueError(f"{seed!r} cannot be used to seed a numpy.random.Generator instance")


def _first_seed(seed: Seed, rng: Rng) -> int:
    if seed is not None and rng is not None:
        raise TypeError("got multiple values for argument now known as `rng`. Specify one of `rng` "
                        "or `seed`.")
    if isinstance(seed, numbers.Integral) and 0 <= int(seed) < 2**64:
        return int(seed)
    source = check_random_state(seed) if rng is None else np.random.default_rng(rng)
    if isinstance(source, np.random.RandomState):
        return int(source.randint(1, 2**63, dtype=np.int64))
    return int(source.integers(1, 2**63, dtype=np.int64))


def _threads(workers: Whole) -> int:
    workers = int(workers)
    if workers == -1:
        cores = os.cpu_count()
        if cores is None:
            raise NotImplementedError("Cannot determine the number of cpus using os.cpu_count(), "
                                      "cannot use -1 for the number of workers")
        return cores
    if workers <= 0:
        raise ValueError(f"Invalid number of workers: {workers}, must be -1 or > 0")
    return workers


def _whole(name: str, value: Any) -> int:
    if not isinstance(value, numbers.Integral) or value < 0:
        raise ValueError(f"{name} must be a non-negative integer value, not {value!r}")
    return int(value)


def _in_cube(sample: ArrayLike) -> Floats:
    sample = np.asarray(sample, dtype=np.float64, order="C")
    if sample.ndim != 2:
        raise ValueError("Sample is not a 2D array")
    if sample.size == 0:
        raise ValueError(f"Sample is empty: it has the shape {sample.shape}")
    if not (sample.min() >= 0 and sample.max() <= 1):
        raise ValueError("Sample is not in unit hypercube")
    return sample


def _box(low: ArrayLike, high: ArrayLike, d: int) -> tuple[NDArray[Any], NDArray[Any]]:
    try:
        low, high = np.broadcast_to(low, d), np.broadcast_to(high, d)
    except ValueError:
        raise ValueError("'l_bounds' and 'u_bounds' must be broadcastable and respect the sample "
                         "dimension") from None
    if not (low < high).all():
        raise ValueError("Bounds are not consistent 'l_bounds' < 'u_bounds'")
    return low, high


# SciPy's method: the kind of l2-discrepancy, whether the result is its square, and two terms of
# squared = c^d - 2/n sum_i prod_j a(x_ij) + n^-2 sum_i sum_k K(x_i, x_k): c^d (with its sign) and
# a, with z = |x - 1/2|.
_METHODS: dict[str, tuple[str, bool, Callable[[int], float], Callable[[Floats, Floats], Floats]]] = {
    "CD": ("centered", True, lambda d: (13 / 12) ** d, lambda x, z: 1 + z / 2 - z * z / 2),
    "WD": ("wraparound", True, lambda d: -((4 / 3) ** d), lambda x, z: 0 * x),
    "MD": ("mixture", True, lambda d: (19 / 12) ** d, lambda x, z: 5 / 3 - z / 4 - z * z / 4),
    "L2-star": ("star", False, lambda d: 3.0**-d, lambda x, z: (1 - x * x) / 2),
}


def discrepancy(sample: ArrayLike, *, iterative: bool = False, method: str = "CD",
                workers: Whole = 1) -> float:
    """L2 discrepancy of points: small if they are evenly spread.

    sample     points (n, d) in [0, 1]
    iterative  divide by n + 1 instead of n: the start for update_discrepancy(), method "CD" alone
    method     "CD" (centered), "WD" (wrap-around) or "MD" (mixture): squares, as SciPy returns
               them; "L2-star": not a square

    Equal to SciPy's value up to the rounding of SciPy's sums, in O(n log n) time for d <= 2 and for
    many points of 3 or 4 coordinates, O(n^2 d) otherwise.

    Source: stipple.describe("l2-discrepancy"). Raises ValueError for samples that are not 2-D,
    empty or not in the unit hypercube, and for other methods.
    """
    x = _in_cube(sample)
    threads = _threads(workers)
    if method not in _METHODS:
        raise ValueError(f"{method!r} is not a valid method. It must be one of {set(_METHODS)!r}")
    kind, is_square, constant, single = _METHODS[method]
    found = analyze("l2-discrepancy", x, kind=kind, threads=threads)[kind]
    if not iterative:
        return float(found.squared if is_square else found.value)
    n, d = x.shape
    c, mean = constant(d), single(x, abs(x - 0.5)).prod(axis=1).mean()
    pairs = (n / (n + 1)) ** 2 * (found.squared - c + 2 * mean)
    square = c - 2 * n / (n + 1) * mean + pairs
    return float(square if is_square else math.sqrt(max(square, 0)))


def geometric_discrepancy(sample: ArrayLike, method: str = "mindist",
                          metric: str | Callable[..., float] = "euclidean") -> float:
    """Smallest distance between two different points, or mean edge of their minimum spanning tree:
    large if points are evenly spread.

    sample  two or more points (n, d) in [0, 1]
    method  "mindist" or "mst"
    metric  as for scipy.spatial.distance.pdist(). "euclidean", "cityblock" and "chebyshev" take
            O(n log n) time in the plane; others, and "mindist" with duplicates, O(n^2) time and
            memory

    Duplicates get a warning. They have no part in "mindist", and edges of length 0 in "mst", where
    SciPy gives them longer edges.

    Source: stipple.describe("nearest-neighbor"), stipple.describe("spanning-tree"). Raises
    ValueError for samples that are not 2-D, not in the unit hypercube, or at one place, and for
    other methods.
    """
    x = _in_cube(sample)
    if len(x) < 2:
        raise ValueError("Sample must contain at least two points")
    if (x == x[0]).all():
        raise ValueError("All points of the sample are the same")
    if method not in ("mindist", "mst"):
        raise ValueError(f"{method!r} is not a valid method. It must be one of "
                         "{'mindist', 'mst'}")
    norms = {"euclidean": "euclidean", "cityblock": "manhattan", "chebyshev": "chebyshev"}
    norm = norms.get(metric) if isinstance(metric, str) else None
    if norm is not None:
        analyzer = "nearest-neighbor" if method == "mindist" else "spanning-tree"
        found = analyze(analyzer, x, metric=norm)
        smallest, mean = found.minimum, found.mean
    else:
        distances = pdist(x, metric)
        smallest, longest = distances.min(), distances.max()
        if method == "mst":  # csgraph takes 0 for no edge; a constant added to all keeps the tree
            mean = minimum_spanning_tree(squareform(distances + longest)).data.mean() - longest
    if smallest == 0:
        warnings.warn("Sample contains duplicate points.", stacklevel=2)
    if method == "mst":
        return float(mean)
    if smallest == 0:
        distances = pdist(x, metric)
        smallest = distances[distances > 0].min()
    return float(smallest)


def primes_from_2_to(n: int) -> NDArray[np.int64]:
    """The primes below n, in order."""
    is_prime = np.ones(max(n, 2), dtype=bool)
    is_prime[:2] = False
    for p in range(2, math.isqrt(len(is_prime)) + 1):
        if is_prime[p]:
            is_prime[p * p :: p] = False
    return np.flatnonzero(is_prime)


def n_primes(n: int) -> list[int]:
    """The first n primes. They are below n (log n + log log n) for n >= 6 (Rosser)."""
    m = max(n, 6)
    primes = primes_from_2_to(int(m * (math.log(m) + math.log(math.log(m)))) + 1)
    return [int(prime) for prime in primes[:n]]


def van_der_corput(n: Whole, base: Whole = 2, *, start_index: Whole = 0, scramble: bool = False,
                   seed: Seed = None, rng: Rng = None, workers: Whole = 1) -> Floats:
    """Points start_index, start_index + 1, ... of the van der Corput sequence: an array (n,) in
    [0, 1).

    base      from 2 to 65536
    scramble  permute the digits at random, each by the digits before it

    Source: stipple.describe("van-der-corput"), stipple.describe("owen"). Raises ValueError for a
    base below 2, a wrong n or start_index.
    """
    threads = _threads(workers)
    if base < 2:
        raise ValueError("'base' must be at least 2")
    if _whole("n", n) == 0:
        return np.empty(0)
    start = _whole("start_index", start_index)
    x = generate("van-der-corput", n, 1, base=base, start=start, threads=threads)
    if scramble:
        x = _scrambled(x, "owen", base=[base], seed=_first_seed(seed, rng), threads=threads)
    return np.array(x).ravel()


class Engine(QMCEngine):  # type: ignore[misc]
    """Any generator of stipple as a QMCEngine.

    d             number of coordinates, 0 or more
    generator     name or spec: "kronecker", "jittered"; stipple.list("generators") names all
    optimization  None, or SciPy's "random-cd" or "lloyd", applied to each set that random() returns
    seed, rng     see stipple.qmc
    options       of the generator; stipple.describe() documents them

    If the generator is a sequence, random(n) returns its next n points, and fast_forward(n) skips n
    in no time. Otherwise each call of random() makes a set of n points, with the next seed, and
    fast_forward() skips a set. reset() starts again, with the same points. num_generated counts the
    points so far.

    Raises ValueError for a wrong d or n, stipple.Error for what the generator refuses.
    """

    generator = "random"

    if TYPE_CHECKING:  # SciPy's, which have no types
        d: int
        num_generated: int

        def random(self, n: Whole = 1, *, workers: Whole = 1) -> Floats: ...

    def __init__(self, d: Whole, *, generator: str | None = None, optimization: str | None = None,
                 seed: Seed = None, rng: Rng = None, **options: Option) -> None:
        self.d = d  # type: ignore[assignment]  # SciPy refuses other types
        self._first_seed = _first_seed(seed, rng)
        self._optimization = optimization
        self._name = generator or self.generator
        self._options: dict[str, Any] = options
        self._init_quad: dict[str, Any]
        self._init_quad = {"d": d, "generator": self._name, "optimization": optimization, **options}
        self.reset()
        unit = find(self._name.split(":")[0], ["generators"])
        if unit is None:
            generate(self._name, 1, d)  # raises the error for an unknown name
        assert unit is not None
        self._prefix: bool = unit["traits"]["sequence"] and unit["traits"]["prefix"]
        self._points: _stipple.Indexed | None = None
        if self._prefix and d > 0:
            self._indexed()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_points": None}

    def _indexed(self) -> _stipple.Indexed:
        if self._points is None:
            self._points = _stipple.Indexed(self._name, settings_of(self._options), self.d,
                                            self._first_seed)
        return self._points

    def _set(self, n: Whole | None, workers: Whole, **more: Option) -> Floats:
        """The next set of a generator that is not a sequence."""
        seed = (self._first_seed + self._sets) % 2**64
        self._sets += 1
        options: dict[str, Any] = {**self._options, **more, "threads": _threads(workers)}
        return np.array(generate(self._name, n, self.d, seed=seed, **options))

    def _random(self, n: Whole = 1, *, workers: Whole = 1) -> Floats:
        if _whole("n", n) == 0 or self.d == 0:
            return np.empty((n, self.d))
        if self._prefix:
            return self._indexed().part(self.num_generated, int(n), _how(_threads(workers)))
        return self._set(n, workers)

    def integers(self, l_bounds: ArrayLike, *, u_bounds: ArrayLike | None = None,
                 n: Whole = 1, endpoint: bool = False, workers: Whole = 1) -> NDArray[np.int64]:
        """Points of integers (n, d): l + floor((u - l) x), which are below u.

        l_bounds, u_bounds  l and u: integers, for all coordinates or for each; without u_bounds, 0
                            and l_bounds
        endpoint            include u: u_bounds + 1 in place of u_bounds

        Raises ValueError for bounds that are not integers, do not fit d, or have l >= u.
        """
        low, high = (0, l_bounds) if u_bounds is None else (l_bounds, u_bounds)
        if any(not np.issubdtype(np.asarray(bound).dtype, np.integer) for bound in (low, high)):
            raise ValueError("'u_bounds' and 'l_bounds' must be integers or array-like of integers")
        box = _box(low, np.add(high, int(endpoint)), self.d)
        lowest, highest = (bound.astype(np.int64) for bound in box)
        width = highest - lowest
        if not (width > 0).all():
            raise ValueError("'l_bounds' and 'u_bounds' are 2^63 or more apart")
        steps = np.floor(self.random(n, workers=workers) * width).astype(np.int64)
        drawn: NDArray[np.int64] = lowest + np.minimum(steps, width - 1)
        return drawn

    def reset(self) -> Engine:
        """Back to the first point or set."""
        seed = {_SEED: self._first_seed}
        QMCEngine.__init__(self, d=self.d, optimization=self._optimization, **seed)
        self._sets = 0
        return self

    def fast_forward(self, n: Whole) -> Engine:
        """Skips n points of a sequence, or one set of n points."""
        self.num_generated += _whole("n", n)
        self._sets += int(n > 0)
        return self


class _Scrambled(Engine):
    """A sequence whose option scramble is a word, but True or False in SciPy."""

    def __init__(self, d: Whole, *, scramble: bool | str = True, **options: Any) -> None:
        self.scramble = scramble
        words: dict[bool | str, str] = {True: "owen", False: "none"}
        super().__init__(d, scramble=words.get(scramble, scramble), **options)
        self._init_quad["scramble"] = scramble or True


class Sobol(_Scrambled):
    """Sobol's sequence, with direction numbers of Joe and Kuo.

    d         0 to MAXDIM coordinates
    scramble  True: nested uniform scrambling (Owen), of all 53 bits. False: SciPy's own points, in
              the order of SciPy (Gray code). Or a word of the generator: "digital-shift", "matrix"
    bits      2^bits points at most; default: 52. The coordinates do not depend on it
    options   of the generator, and those of Engine

    Warns if the first call of random() asks for another number of points than a power of 2. Source:
    stipple.describe("sobol").
    """

    generator = "sobol"
    MAXDIM: int = records()["generators"]["sobol"]["traits"]["max_dimension"]

    def __init__(self, d: Whole, *, scramble: bool | str = True, bits: Whole | None = None,
                 optimization: str | None = None, seed: Seed = None, rng: Rng = None,
                 **options: Option) -> None:
        if isinstance(d, numbers.Integral) and d > self.MAXDIM and "directions" not in options:
            raise ValueError(f"Maximum supported dimensionality is {self.MAXDIM}.")
        self.bits = 52 if bits is None else _whole("bits", bits)
        if self.bits > 64:
            raise ValueError("Maximum supported 'bits' is 64")
        self.maxn = 2**self.bits
        if not scramble:
            options.setdefault("order", "gray")
        super().__init__(d, scramble=scramble, optimization=optimization, seed=seed, rng=rng,
                         **options)
        self._init_quad["bits"] = bits

    def _random(self, n: Whole = 1, *, workers: Whole = 1) -> Floats:
        total = self.num_generated + _whole("n", n)
        if total > self.maxn:
            done = self.num_generated
            advice = "Consider increasing `bits`." if self.bits < 52 else ""
            raise ValueError(f"At most 2**{self.bits}={self.maxn} distinct points can be "
                             f"generated. {done} points have been previously generated, then: "
                             f"n={done}+{n}={total}. {advice}")
        if self.num_generated == 0 and n & (n - 1) != 0:
            warnings.warn("The balance properties of Sobol' points require n to be a power of 2.",
                          stacklevel=3)
        return super()._random(n, workers=workers)

    def random_base2(self, m: Whole) -> Floats:
        """The next 2^m points, if there are then 2^k points in all; otherwise a ValueError."""
        total = self.num_generated + 2 ** _whole("m", m)
        if total & (total - 1) != 0:
            done = self.num_generated
            raise ValueError("The balance properties of Sobol' points require n to be a power of "
                             f"2. {done} points have been previously generated, then: n={done}+2**"
                             f"{m}={total}. If you still want to do this, the function "
                             "'Sobol.random()' can be used.")
        return self.random(2**m)


class Halton(_Scrambled):
    """Halton's sequence in the first d primes.

    d         0 to 1000 coordinates
    scramble  True: nested uniform scrambling (Owen). False: SciPy's own points, up to rounding. Or
              a word of the generator: "permutation" (SciPy's method), "faure", "reverse"
    options   of the generator, and those of Engine

    Source: stipple.describe("halton").
    """

    generator = "halton"

    def __init__(self, d: Whole, *, scramble: bool | str = True, optimization: str | None = None,
                 seed: Seed = None, rng: Rng = None, **options: Option) -> None:
        super().__init__(d, scramble=scramble, optimization=optimization, seed=seed, rng=rng,
                         **options)


class LatinHypercube(Engine):
    """Latin hypercubes: each coordinate has one point in each of n strata.

    d             number of coordinates
    scramble      False: points are the centres of their strata
    strength      2: also one point in each square of a grid of n squares, for each pair of
                  coordinates; n = p^2 for a prime p >= d - 1, otherwise a ValueError
    optimization  "random-cd": exchanges strata for a small centered discrepancy. For strength 1 and
                  up to 500 points by stipple's own search: mostly better sets than SciPy's, in the
                  same time; effort=1 searches a hundred times longer, for up to 10 000 points.
                  Otherwise as for Engine
    centered      deprecated: use scramble=False
    options       of the generator (optimize="maximin", sliced=4 ...), and those of Engine

    Source: stipple.describe("latin-hypercube").
    """

    generator = "latin-hypercube"

    def __init__(self, d: Whole, *, centered: bool = False, scramble: bool = True, strength: Whole = 1,
                 optimization: str | None = None, seed: Seed = None, rng: Rng = None,
                 **options: Option) -> None:
        if centered:
            warnings.warn("'centered' is deprecated. Please use 'scramble' instead. "
                          "'centered=True' corresponds to 'scramble=False'.", stacklevel=2)
        if strength not in (1, 2):
            raise ValueError(f"{strength!r} is not a valid strength. It must be one of {{1, 2}}")
        self.scramble = bool(scramble) and not centered
        self._strength = strength
        given: dict[str, Any] = {"strength": strength, "centered": not self.scramble, **options}
        super().__init__(d, optimization=optimization, seed=seed, rng=rng, **given)
        self._init_quad = {"d": d, "optimization": optimization, "strength": strength, **options}

    def _random(self, n: Whole = 1, *, workers: Whole = 1) -> Floats:
        p = math.isqrt(_whole("n", n))
        if self._strength == 2 and n > 0:
            primes = primes_from_2_to(max(p, 3) + 1)
            if p not in primes or n != p * p:
                raise ValueError("n is not the square of a prime number. Close values are "
                                 f"{primes[-2:]**2}")
            if self.d > p + 1:
                raise ValueError("n is too small for d. Must be n > (d-1)**2")
        return super()._random(n, workers=workers)

    def random(self, n: Whole = 1, *, workers: Whole = 1) -> Floats:
        """A set of n points (n, d)."""
        search = str(self._optimization).lower() == "random-cd" and self._strength == 1
        effort = self._options.get("effort", 0.01 if _whole("n", n) <= 500 else None)
        if not search or self.d == 0 or n == 0 or effort is None:
            return super().random(n, workers=workers)
        sample = self._set(n, workers, optimize="centered-l2", effort=effort)
        self.num_generated += n
        return sample


class PoissonDisk(Engine):
    """Random points that are radius or more apart.

    d             number of coordinates
    radius        smallest distance, in the unit of the bounds
    hypersphere   "volume"; "surface": denser, by Bridson's algorithm
    ncandidates   of Bridson's algorithm
    optimization  as for Engine; it moves points
    l_bounds, u_bounds  the box, [0, 1)^d by default
    options       of the generator poisson-disk (order="random"), and those of Engine

    In two and three dimensions with hypersphere="volume", points are those of stipple's generator
    poisson-disk with this radius: a maximal set, which has no room for a further point, made by the
    first call. random(n) returns its next n points, in an order whose first points are well spread
    already; fill_space() returns all that remain. Otherwise points are made one by one by Bridson's
    algorithm: random(n) is fast for small radii in many dimensions, too, but fill_space() leaves
    gaps. (stipple.generate("poisson-disk", d=4, radius=0.3, bounded=True) makes maximal sets in up
    to six dimensions.)

    random(n) returns fewer than n points if there is no room for more.

    Source: stipple.describe("poisson-disk"); R. Bridson 2007, doi:10.1145/1278780.1278807.
    Raises ValueError for a wrong radius, hypersphere, number of candidates or box.
    """

    generator = "poisson-disk"

    def __init__(self, d: Whole, *, radius: float = 0.05, hypersphere: str = "volume",
                 ncandidates: Whole = 30, optimization: str | None = None, seed: Seed = None,
                 rng: Rng = None, l_bounds: ArrayLike | None = None,
                 u_bounds: ArrayLike | None = None, **options: Option) -> None:
        if hypersphere not in ("volume", "surface"):
            raise ValueError(f"{hypersphere!r} is not a valid hypersphere sampling method. It must "
                             "be one of {'volume', 'surface'}")
        # Not isinstance(): type checkers take no float for a Real, and would skip the code below.
        if not (issubclass(type(radius), numbers.Real) and radius > 0):
            raise ValueError(f"radius must be above 0, not {radius!r}")
        if _whole("ncandidates", ncandidates) == 0:
            raise ValueError("ncandidates must be 1 or more")
        self.radius, self.hypersphere, self.ncandidates = radius, hypersphere, ncandidates
        given: dict[str, Any] = options
        super().__init__(d, optimization=optimization, seed=seed, rng=rng, **given)
        low, high = 0 if l_bounds is None else l_bounds, 1 if u_bounds is None else u_bounds
        self.l_bounds, self.u_bounds = box = _box(low, high, self.d)
        self._init_quad = {"d": d, "radius": radius, "hypersphere": hypersphere,
                           "ncandidates": ncandidates, "optimization": optimization,
                           "l_bounds": l_bounds, "u_bounds": u_bounds, **options}
        self._maximal = d in (2, 3) and hypersphere == "volume" and radius <= math.dist(*box)
        if options and not self._maximal:
            raise ValueError(f"{next(iter(options))}: options of the generator need two or three "
                             "dimensions and hypersphere='volume'")
        straight = not options.get("torus", False) or None
        self._options = {"radius": radius, "bounds": np.transpose(box), "order": "progressive",
                         "bounded": straight, **options}

    def reset(self) -> PoissonDisk:
        """Back to the first point."""
        self._made: Floats | None = None
        self._growing: Bridson | None = None
        super().reset()
        return self

    def _random(self, n: Whole | float = 1, *, workers: Whole = 1) -> Floats:
        if n == 0 or self.d == 0:
            return np.empty((int(n) if math.isfinite(n) else 0, self.d))
        if not self._maximal:
            if self._growing is None:
                box = self.l_bounds, self.u_bounds
                self._growing = Bridson(box, self.radius, self.hypersphere == "surface",
                                        int(self.ncandidates), self._first_seed)
            return self._growing.draw(float(n))
        if self._made is None:
            self._made = self._set(None, workers)
        first = self.num_generated
        return self._made[first : first + int(min(n, len(self._made)))].copy()

    def _draw(self, n: float, workers: Whole) -> Floats:
        sample = self._random(n, workers=workers)
        if self.optimization_method is not None and len(sample) > 0:
            sample = self.optimization_method(sample)
        self.num_generated += len(sample)
        return sample

    def random(self, n: Whole = 1, *, workers: Whole = 1) -> Floats:
        """The next n points, or as many as there is room for."""
        return self._draw(_whole("n", n), workers)

    def fill_space(self, *, workers: Whole = 1) -> Floats:
        """Points until there is no room or, by Bridson's algorithm, until no candidate fits."""
        return self._draw(math.inf, workers)

    def fast_forward(self, n: Whole) -> PoissonDisk:
        """Skips n points."""
        self.random(n)
        return self


class MultivariateNormalQMC(_scipy.MultivariateNormalQMC):  # type: ignore[misc]
    """Points of a multivariate normal distribution, made of an engine's points.

    mean           (d,)
    cov            covariance matrix (d, d), positive semidefinite; default: the identity
    cov_root       instead of cov: a matrix (d', d) that standard normal points are multiplied by
    inv_transform  the inverse of the normal distribution, coordinate by coordinate; or False: the
                   Box-Muller transform of pairs, for which the engine has d or d + 1 coordinates,
                   an even number
    engine         of d coordinates; default: Sobol(d, seed=seed)

    random(n) returns an array (n, d). Raises ValueError for wrong shapes or matrices.
    """

    def __init__(self, mean: ArrayLike, cov: ArrayLike | None = None, *,
                 cov_root: ArrayLike | None = None, inv_transform: bool = True,
                 engine: QMCEngine | None = None, seed: Seed = None, rng: Rng = None) -> None:
        if engine is None:
            d = np.atleast_1d(mean).shape[0]
            engine = Sobol(d if inv_transform else d + d % 2, seed=seed, rng=rng)
        super().__init__(mean, cov, cov_root=cov_root, inv_transform=inv_transform, engine=engine)


class MultinomialQMC(_scipy.MultinomialQMC):  # type: ignore[misc]
    """Counts of n_trials in k categories, made of an engine's points.

    pvals     probabilities (k,), which sum to 1
    n_trials  number of points of the engine for each row of counts
    engine    of one coordinate; default: Sobol(1, seed=seed)

    random(n) returns an array (n, k). Raises ValueError for wrong probabilities or engines.
    """

    def __init__(self, pvals: ArrayLike, n_trials: Whole, *, engine: QMCEngine | None = None,
                 seed: Seed = None, rng: Rng = None) -> None:
        engine = Sobol(1, seed=seed, rng=rng) if engine is None else engine
        super().__init__(pvals, n_trials, engine=engine)
