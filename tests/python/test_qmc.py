# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from scipy import stats
from scipy.stats import sampling
from scipy.stats import qmc as scipy_qmc

import stipple
from stipple import qmc

ENGINES = [qmc.Sobol, qmc.Halton, qmc.LatinHypercube, qmc.PoissonDisk]


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
    plain = qmc.Halton(2, scramble=False).random(10)
    assert np.allclose(plain, scipy_qmc.Halton(2, scramble=False).random(10), atol=1e-15)
    with pytest.raises(stipple.Error, match="not a sequence"):
        qmc.LatinHypercube(2).fast_forward(3)


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
