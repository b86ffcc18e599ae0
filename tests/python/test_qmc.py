# SPDX-License-Identifier: MIT
import copy
import inspect
import os
import pickle
import subprocess
import sys
import warnings
from fractions import Fraction
from math import prod

import numpy as np
import pytest
import scipy.stats._qmc
from scipy import integrate, special, stats
from scipy.sparse.csgraph import minimum_spanning_tree
from scipy.spatial import KDTree
from scipy.spatial.distance import pdist, squareform
from scipy.stats import sampling
from scipy.stats import qmc as scipy_qmc

import stipple
from stipple import qmc

qmc_quad = getattr(integrate, "qmc_quad", None) or integrate._quadrature._qmc_quad
ENGINES = [qmc.Sobol, qmc.Halton, qmc.LatinHypercube, qmc.PoissonDisk]


def arguments(call):
    """Names that can be passed without a keyword, and all names."""
    parameters = inspect.signature(call).parameters
    return [p.name for p in parameters.values() if p.kind is p.POSITIONAL_OR_KEYWORD], {*parameters}


@pytest.mark.parametrize("name", scipy.stats._qmc.__all__)
def test_calls_have_scipys_arguments(name):
    ours, theirs = getattr(qmc, name), getattr(scipy_qmc, name)
    methods = ["__init__", *(each for each in dir(theirs) if not each.startswith("_"))] if isinstance(theirs, type) else [None]
    for method in methods:
        pair = [call if method is None else getattr(call, method) for call in (ours, theirs)]
        if callable(pair[1]):
            (first, mine), (expected, all_theirs) = map(arguments, pair)
            assert first[: len(expected)] == expected and all_theirs <= mine, method


@pytest.mark.parametrize("engine", ENGINES)
def test_engines_are_scipys(engine):
    one = engine(2, seed=3)
    assert isinstance(one, scipy_qmc.QMCEngine)
    x = one.random(64)
    assert x.shape == (64, 2) and x.min() >= 0 and x.max() < 1
    assert one.num_generated == 64
    assert np.array_equal(one.reset().random(64), x)
    assert np.array_equal(engine(2, seed=3).random(64), x)
    assert not np.array_equal(engine(2, seed=4).random(64), x)
    assert scipy_qmc.discrepancy(x) < 0.1
    drawn = engine(2, seed=np.random.default_rng(1)).random(8)
    assert np.array_equal(drawn, engine(2, seed=np.random.default_rng(1)).random(8))


def test_sequences_go_on():
    sobol = qmc.Sobol(3, seed=1)
    x = sobol.random_base2(6)
    rest = sobol.random(64)
    assert np.array_equal(np.concatenate([x, rest]),
                          stipple.generate("sobol", 128, 3, scramble="owen", seed=1))
    assert np.array_equal(qmc.Sobol(3, seed=1).fast_forward(100).random(28), rest[36:])
    cubes = qmc.LatinHypercube(2, seed=1)
    sets = [cubes.random(5), cubes.random(5), cubes.random(5)]
    assert np.array_equal(cubes.reset().fast_forward(5).fast_forward(0).random(5), sets[1])
    assert np.array_equal(sets[2], stipple.generate("latin-hypercube", 5, 2, seed=3))
    plain = qmc.Halton(2, scramble=False).random(10)
    assert np.allclose(plain, scipy_qmc.Halton(2, scramble=False).random(10), atol=1e-15)


def test_any_generator_is_an_engine():
    engine = qmc.Engine(2, generator="multi-jittered:order=cells", seed=2)
    assert engine.random(16).shape == (16, 2)
    with pytest.raises(stipple.Error, match="did you mean"):
        qmc.Engine(2, generator="haltn")


def test_scipy_takes_engines():
    normal = scipy_qmc.MultivariateNormalQMC([0, 1], engine=qmc.Sobol(2, seed=1)).random(256)
    assert np.allclose(normal.mean(axis=0), [0, 1], atol=0.05)
    counts = scipy_qmc.MultinomialQMC([0.25, 0.75], 100, engine=qmc.Halton(1, seed=1)).random(1)
    assert counts.sum() == 100
    law = sampling.NumericalInverseHermite(stats.norm())
    drawn = law.qrvs(128, qmc_engine=qmc.Sobol(1, seed=2))
    assert abs(drawn.mean()) < 0.05
    lhs = qmc.LatinHypercube(2, seed=1, optimization="random-cd").random(16)
    assert sorted((lhs[:, 0] * 16).astype(int)) == [*range(16)]


# Each method by its definition, in rational numbers: c^d, the mean over a point and any other, a pair.
EXACT = {
    "CD": (Fraction(13, 12), lambda x: 1 + abs(x - HALF) / 2 - (x - HALF) ** 2 / 2,
           lambda x, y: 1 + (abs(x - HALF) + abs(y - HALF) - abs(x - y)) / 2),
    "WD": (Fraction(4, 3), lambda x: Fraction(4, 3), lambda x, y: Fraction(3, 2) - abs(x - y) + (x - y) ** 2),
    "MD": (Fraction(19, 12), lambda x: Fraction(5, 3) - abs(x - HALF) / 4 - (x - HALF) ** 2 / 4,
           lambda x, y: Fraction(15, 8) - (abs(x - HALF) + abs(y - HALF) + 3 * abs(x - y)) / 4 + (x - y) ** 2 / 2),
    "L2-star": (Fraction(1, 3), lambda x: (1 - x * x) / 2, lambda x, y: 1 - max(x, y)),
}  # fmt: skip
HALF = Fraction(1, 2)


def exact_discrepancy(sample, method, iterative):
    """Its square. Divided by n + 1 if iterative, where SciPy leaves the constant of "WD" as it is."""
    constant, one, pair = EXACT[method]
    points = [[Fraction(x) for x in row] for row in sample.tolist()]
    n, d = len(points) + iterative, len(points[0])
    ones = sum(prod(one(x) for x in row) for row in points)
    pairs = sum(prod(pair(x, y) for x, y in zip(a, b)) for a in points for b in points)
    mean = constant**d if method == "WD" else Fraction(ones, n)
    return constant**d - 2 * mean + Fraction(pairs, n * n)


SETS = {
    "one point": [[0.3]],
    "one point in 3-D": [[0.3, 0.5, 0.9]],
    "corners": [[0, 1], [1, 1], [0, 0], [1, 0]],
    "a line": [[0], [0.5], [1], [0.125]],
    "duplicates": [[0.2, 0.7, 0.4]] * 5 + [[0.2, 0.1, 1]],
    "many": np.random.default_rng(1).random((40, 2)),
    "more": np.random.default_rng(2).random((30, 6)),
    "grid": stipple.generate("grid", 27, 3),
}


@pytest.mark.parametrize("iterative", [False, True])
@pytest.mark.parametrize("method", EXACT)
@pytest.mark.parametrize("name", SETS)
def test_discrepancies_are_exact_and_scipys(name, method, iterative):
    x = np.array(SETS[name], dtype=float)
    square = float(exact_discrepancy(x, method, iterative))
    found = qmc.discrepancy(x, method=method, iterative=iterative)
    scale = max(1, float(EXACT[method][0])) ** x.shape[1]
    rounding = 1e-15 * scale if iterative else 0
    if method == "L2-star":
        if square <= 0:  # iterative ones may be
            assert found == 0
            return
        assert abs(found - square**0.5) <= 1e-12 * found + rounding / square**0.5
    else:
        assert abs(found - square) <= 1e-12 * abs(square) + rounding
    theirs = scipy_qmc.discrepancy(x, method=method, iterative=iterative)
    assert abs(found - theirs) <= 1e-13 * scale / (1 if method != "L2-star" else found)
    assert qmc.discrepancy(x, method=method, iterative=iterative, workers=-1) == found


def test_discrepancies_are_updated():
    x = np.random.default_rng(5).random((200, 3))
    begin = qmc.discrepancy(x[:-1], iterative=True)
    assert abs(qmc.update_discrepancy(x[-1], x[:-1], begin) - qmc.discrepancy(x)) < 1e-14


@pytest.mark.parametrize("metric", ["euclidean", "cityblock", "chebyshev", "sqeuclidean", lambda x, y: abs(x - y).sum() ** 2])
@pytest.mark.parametrize("n, d", [(2, 1), (50, 1), (300, 2), (100, 5)])
def test_geometric_discrepancies(n, d, metric):
    x = np.random.default_rng(n).random((n, d))
    distances = pdist(x, metric)
    assert np.isclose(qmc.geometric_discrepancy(x, metric=metric), distances.min(), rtol=1e-13)
    mean = minimum_spanning_tree(squareform(distances)).data.mean()
    assert np.isclose(qmc.geometric_discrepancy(x, "mst", metric), mean, rtol=1e-12)


@pytest.mark.parametrize("metric", ["euclidean", "cityblock", "minkowski"])
def test_geometric_discrepancies_of_duplicates(metric):
    x = [[0, 0.5], [1, 0.5], [0, 0.5], [0.75, 0.5]]
    with pytest.warns(UserWarning, match="duplicate points"):
        assert qmc.geometric_discrepancy(x, metric=metric) == 0.25
    with pytest.warns(UserWarning, match="duplicate points"):
        assert abs(qmc.geometric_discrepancy(x, "mst", metric) - 1 / 3) < 1e-15
    for method in ("mindist", "mst"):
        with pytest.raises(ValueError, match="the same"):
            qmc.geometric_discrepancy([[0.5]] * 3, method, metric)


@pytest.mark.parametrize("engine", [*ENGINES, lambda d, **how: qmc.MultivariateNormalQMC([0] * d, **how)])
def test_seeds(engine):
    def points(**seed):
        return engine(2, **seed).random(8)

    for make in (np.random.default_rng, np.random.RandomState):
        assert np.array_equal(points(seed=make(1)), points(seed=make(1)))
        assert not np.array_equal(points(seed=make(1)), points(seed=make(2)))
    assert np.array_equal(points(rng=7), points(rng=np.random.default_rng(7)))
    assert np.array_equal(points(rng=[1, 2]), points(rng=np.random.SeedSequence([1, 2])))
    assert np.array_equal(points(seed=2**100), points(seed=np.random.default_rng(2**100)))
    assert not np.array_equal(points(), points())
    assert np.array_equal(points(seed=2**64 - 1), points(seed=np.uint64(2**64 - 1)))
    with pytest.raises(TypeError, match="multiple values"):
        points(seed=1, rng=1)
    for wrong in ("1", 1.5, [1]):
        with pytest.raises(ValueError, match="cannot be used to seed"):
            points(seed=wrong)


# SciPy's numbers, to the last bit, for any n.
def test_unscrambled_sobol_is_scipys():
    with warnings.catch_warnings(record=True) as given:
        warnings.simplefilter("always")
        ours, theirs = (each.Sobol(200, scramble=False).fast_forward(3).random(90) for each in (qmc, scipy_qmc))
        assert np.array_equal(ours, theirs) and not given
        qmc.Sobol(1).random(3)
    assert "power of 2" in str(given[0].message) and given[0].filename == __file__
    assert np.array_equal(qmc.Sobol(2, scramble="matrix", seed=4).random(8), stipple.generate("sobol", 8, 2, scramble="matrix", seed=4))
    assert qmc.Sobol(1, bits=60).fast_forward(2**52 - 1).random().shape == (1, 1)


def test_van_der_corput():
    for base in (2, 3, 10):
        plain = qmc.van_der_corput(50, base, start_index=7)
        digits = [np.base_repr(i, base)[::-1] for i in range(7, 57)]
        assert plain.tolist() == [float(sum(Fraction(int(c), base**k) for k, c in enumerate(word, 1))) for word in digits]
        x = qmc.van_der_corput(base**3, base, scramble=True, seed=3)
        assert sorted((x * base**3).astype(int)) == [*range(base**3)]
    assert qmc.van_der_corput(0).shape == (0,)


def test_primes():
    is_prime = [p for p in range(2, 8000) if all(p % q for q in range(2, int(p**0.5) + 1))]
    for n in (0, 1, 2, 5, 6, 7, 100, 1000):
        assert qmc.n_primes(n) == is_prime[:n]
    for n in (0, 2, 3, 4, 25, 26, 7919, 7920):
        assert qmc.primes_from_2_to(n).tolist() == [p for p in is_prime if p < n]


@pytest.mark.parametrize("low, high", [(-5, 7), (10**15, 10**15 + 10), (-(2**62), 2**62 - 1), (0, 1)])
def test_integers_are_exact(low, high):
    x = qmc.Sobol(2, seed=9).random(1024)
    drawn = qmc.Sobol(2, seed=9).integers(low, u_bounds=high, n=1024, workers=2)
    if high - low < 2**50:
        assert drawn.tolist() == [[low + int(Fraction(t) * (high - low)) for t in row] for row in x.tolist()]
    assert drawn.min() >= low and drawn.max() < high and drawn.dtype == np.int64


def test_integers_of_each_coordinate():
    drawn = qmc.Halton(3, seed=1).integers([1, 2, 3], u_bounds=[1, 4, 9], n=200, endpoint=True)
    assert (drawn.min(axis=0) == [1, 2, 3]).all() and (drawn.max(axis=0) == [1, 4, 9]).all()
    assert set(qmc.LatinHypercube(1, seed=1).integers(4, n=8).ravel()) == {0, 1, 2, 3}
    assert qmc.Halton(1).integers(np.uint64(3), u_bounds=np.uint64(9)).dtype == np.int64
    with pytest.raises(ValueError, match="Bounds are not consistent"):
        qmc.Halton(2).integers(3, u_bounds=3)
    with pytest.raises(ValueError, match="2.63 or more apart"):
        qmc.Halton(2).integers(-(2**62), u_bounds=2**62)
    with pytest.raises(ValueError, match="respect the sample dimension"):
        qmc.Halton(2).integers([1, 2, 3])


COVARIANCE = np.array([[2, 1, 0], [1, 2, 0.5], [0, 0.5, 1]])


def test_normal_points_by_hand():
    root = np.linalg.cholesky(COVARIANCE).T
    u = qmc.Sobol(3, seed=5).random(64)
    expected = [1, 2, 3] + special.ndtri(u) @ root
    for given in ({"cov": COVARIANCE}, {"cov_root": root}):
        found = qmc.MultivariateNormalQMC([1, 2, 3], **given, seed=5).random(64)
        assert np.allclose(found, expected, atol=1e-6)  # SciPy keeps 5e-11 off 0 and 1
    u = qmc.Sobol(4, seed=5).random(64)
    radius, angle = np.sqrt(-2 * np.log(u[:, ::2])), 2 * np.pi * u[:, 1::2]
    pairs = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=2).reshape(64, 4)
    found = qmc.MultivariateNormalQMC([1, 2, 3], COVARIANCE, inv_transform=False, seed=5).random(64)
    assert np.allclose(found, [1, 2, 3] + pairs[:, :3] @ root, atol=1e-12)


def test_counts_by_hand():
    p = [0.5, 0.125, 0, 0.375]
    found = qmc.MultinomialQMC(p, 64, seed=3).random(4)
    u = qmc.Sobol(1, seed=3).random(256).reshape(4, 64)
    expected = [[((low <= row) & (row < low + q)).sum() for low, q in zip(np.cumsum(p) - p, p)] for row in u]
    assert np.array_equal(found, expected) and np.array_equal(found, [[32, 8, 0, 24]] * 4)


@pytest.mark.parametrize("d, radius, box", [(2, 0.1, None), (3, 0.3, None), (2, 0.3, ([0, 1], [2, 3])), (2, 1.4, None)])
def test_poisson_disks_leave_no_room(d, radius, box):
    low, high = box or ([0] * d, [1] * d)
    engine = qmc.PoissonDisk(d, radius=radius, seed=1, **({} if box is None else {"l_bounds": low, "u_bounds": high}))
    parts = [engine.random(1), engine.random(2), engine.fast_forward(0).fill_space()]
    x = np.concatenate(parts)
    assert len(x) == engine.num_generated and (x >= low).all() and (x <= high).all()
    assert len(x) == 1 or pdist(x).min() >= radius
    grid = np.stack(np.meshgrid(*(np.linspace(a, b, 40) for a, b in zip(low, high))), axis=-1).reshape(-1, d)
    assert KDTree(x).query(grid)[0].max() <= radius
    assert engine.random(5).shape == engine.fill_space().shape == (0, d)
    assert np.array_equal(engine.reset().random(1000), x) and engine.num_generated == len(x)


@pytest.mark.parametrize("d, radius, how", [
    (1, 0.01, {}), (1, 0.2, {}), (4, 0.3, {"ncandidates": 5}), (2, 0.02, {"hypersphere": "surface"}), (9, 1.2, {}),
    (2, 0.3, {"hypersphere": "surface", "l_bounds": [0, -3], "u_bounds": [2, -1]}), (2, 2, {}),
])
def test_other_poisson_disks_are_bridsons(d, radius, how):
    engine = qmc.PoissonDisk(d, radius=radius, seed=1, **how)
    parts = [engine.random(1), engine.random(4), engine.fill_space()]
    x = np.concatenate(parts)
    assert len(x) == engine.num_generated and (len(x) == 1 or pdist(x).min() >= radius)
    assert (x >= how.get("l_bounds", 0)).all() and (x < how.get("u_bounds", 1)).all()
    assert engine.random(5).shape == engine.fill_space().shape == engine.random(0).shape == (0, d)
    assert np.array_equal(engine.reset().random(7), x[:7])
    assert not np.array_equal(qmc.PoissonDisk(d, radius=radius, seed=2, **how).random(7), x[:7])
    with pytest.raises(ValueError, match="order: options of the generator need"):
        qmc.PoissonDisk(d, radius=radius, order="random", **how)


def test_bridsons_sets_are_about_as_dense_as_scipys():
    for d, radius, hypersphere in ((1, 0.01, "volume"), (2, 0.05, "surface"), (4, 0.3, "volume"), (4, 0.3, "surface")):
        ours, theirs = (len(each.PoissonDisk(d, radius=radius, hypersphere=hypersphere, seed=1).fill_space())
                        for each in (qmc, scipy_qmc))
        assert 0.9 * theirs < ours < 2.2 * theirs
    x = np.sort(qmc.PoissonDisk(1, radius=0.001, seed=1).fill_space()[:, 0])
    assert 500 < len(x) < 1001 and (np.diff(x) > 0.002).mean() < 0.03  # room for a further point


def test_random_cd_finds_less_than_scipys():
    for seed in range(3):
        ours, theirs = (each.LatinHypercube(4, optimization="random-cd", seed=seed).random(30) for each in (qmc, scipy_qmc))
        assert (np.sort((ours * 30).astype(int), axis=0) == np.arange(30)[:, None]).all()
        assert scipy_qmc.discrepancy(ours) < scipy_qmc.discrepancy(theirs)
    centred = [qmc.LatinHypercube(4, optimization="random-CD", scramble=False, effort=effort).random(30) for effort in (0.001, 0.02)]
    assert np.allclose(np.sort(centred[0], axis=0), (np.arange(30)[:, None] + 0.5) / 30)
    assert qmc.discrepancy(centred[1]) < qmc.discrepancy(centred[0])
    many = [qmc.LatinHypercube(2, optimization=how, seed=1).random(501) for how in (None, "random-cd")]
    assert qmc.discrepancy(many[1]) < 0.5 * qmc.discrepancy(many[0])
    assert np.array_equal(np.sort(many[1], axis=0), np.sort(many[0], axis=0))  # coordinates exchanged


@pytest.mark.parametrize("optimization", ["random-cd", "lloyd"])
@pytest.mark.parametrize("engine", ENGINES)
def test_optimized_sets_are_made_again(engine, optimization):
    one = engine(2, seed=3, optimization=optimization)
    x = one.random(16)
    assert np.array_equal(one.reset().random(16), x)
    assert np.array_equal(engine(2, seed=3, optimization=optimization).random(16), x)


@pytest.mark.parametrize("engine", [*ENGINES, lambda d, **how: qmc.PoissonDisk(d, hypersphere="surface", **how)])
def test_engines_are_copied(engine):
    one = engine(2, seed=3)
    one.random(4)
    copies = [copy.deepcopy(one), copy.copy(one).reset().fast_forward(4), pickle.loads(pickle.dumps(one))]
    x = one.random(8)
    assert all(np.array_equal(each.random(8), x) for each in (copies[0], copies[2]))
    assert copies[1].num_generated == 4


@pytest.mark.parametrize("engine", [*ENGINES, lambda d: qmc.Sobol(d, scramble=False), lambda d: qmc.Engine(d, generator="jittered")])
def test_scipys_integrals_take_engines(engine):
    found = qmc_quad(lambda x: np.prod(x, axis=-1), [0, 0], [1, 2], n_points=256, qrng=engine(2))
    assert 0 < found.standard_error and abs(found.integral - 1) < 0.1


def test_without_scipy_the_import_says_so():
    program = "import sys; sys.modules['scipy'] = None; import stipple; from stipple import qmc"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)})
    assert done.stderr.endswith("\nImportError: stipple.qmc needs the package scipy, which is not installed\n")


WRONG = {
    "n must be a non-negative integer value, not -3": lambda: qmc.Halton(2).random(-3),
    "n must be a non-negative integer value, not 10.0": lambda: qmc.LatinHypercube(2).random(10.0),
    "n must be a non-negative integer value, not None": lambda: qmc.PoissonDisk(2).random(None),
    "n must be a non-negative integer value, not '1'": lambda: qmc.Sobol(2).fast_forward("1"),
    "n must be a non-negative integer value, not -1": lambda: qmc.van_der_corput(-1),
    "m must be a non-negative integer value, not -1": lambda: qmc.Sobol(2).random_base2(-1),
    "bits must be a non-negative integer value": lambda: qmc.Sobol(2, bits=2.5),
    "d must be a non-negative integer value": lambda: qmc.Sobol(-1),
    "d must be a non-negative integer value ": lambda: qmc.PoissonDisk(2.5),
    "Invalid number of workers: 0": lambda: qmc.Halton(2).random(3, workers=0),
    "start_index must be a non-negative integer": lambda: qmc.van_der_corput(3, start_index=-1),
    "ncandidates must be 1 or more": lambda: qmc.PoissonDisk(2, ncandidates=0),
    "radius must be above 0, not 'a'": lambda: qmc.PoissonDisk(2, radius="a"),
    "radius must be above 0, not nan": lambda: qmc.PoissonDisk(2, radius=float("nan")),
    "Sample is empty": lambda: qmc.discrepancy(np.empty((0, 2))),
    "Sample is not in unit hypercube": lambda: qmc.discrepancy([[0.5, float("nan")]]),
    "n is not the square of a prime number. Close values are": lambda: qmc.LatinHypercube(2, strength=2).random(1),
}  # fmt: skip


@pytest.mark.parametrize("sentence", WRONG)
def test_wrong_arguments_get_sentences(sentence):
    with pytest.raises(ValueError) as error:
        WRONG[sentence]()
    assert sentence.strip() in str(error.value)
