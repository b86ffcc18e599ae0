# SPDX-License-Identifier: MIT
"""SciPy's own tests of scipy.stats.qmc, from the installed SciPy, with stipple.qmc in its place.

Names that stipple.qmc does not have (_l1_norm, _perturb_discrepancy ...) stay SciPy's. OTHERWISE
lists the tests that must fail, and why.
"""

import sys
import types
from pathlib import Path

import pytest
import scipy.stats
import scipy.stats._qmc

from stipple import qmc

SOURCE = Path(scipy.stats.__file__).parent / "tests" / "test_qmc.py"
if not SOURCE.exists():
    pytest.skip("SciPy is installed without its tests", allow_module_level=True)
if not scipy.__version__.startswith("1.10."):
    pytest.skip("OTHERWISE is for the tests of SciPy 1.10", allow_module_level=True)

BITS = "expects the points that SciPy makes of this seed"
TAILS = "the standard deviation of 256 points depends on their extremes; of 200 seeds, 160 pass here, 161 with SciPy"
OTHERWISE = {
    "TestHalton::test_sample[Scrambled]": BITS,
    "TestHalton::test_workers": BITS,
    "TestSobol::test_sample[Scrambled]": BITS,
    "TestMultinomialQMC::test_MultinomialBasicDraw": BITS,
    "TestMultinomialQMC::test_other_engine": BITS,
    "TestMultinomialQMC::test_MultinomialDistribution":
        "a count that is off by one is off by 1/8192, which is more than 1e-4; of 200 seeds, 163 pass here and with SciPy",
    "TestNormalQMC::test_NormalQMCSeeded": BITS,
    "TestNormalQMC::test_NormalQMCSeededInvTransform": BITS,
    "TestNormalQMC::test_NormalQMCShapiroInvTransform": TAILS,
    "TestMultivariateNormalQMC::test_MultivariateNormalQMCSeeded": BITS,
    "TestMultivariateNormalQMC::test_MultivariateNormalQMCSeededInvTransform": BITS,
    "TestMultivariateNormalQMC::test_MultivariateNormalQMCShapiroInvTransform": TAILS,
    "TestPoisson::test_optimizers[lloyd-<lambda>]":
        "the first 64 points are well spread already; Lloyd's algorithm does not move them farther apart",
}


def scipys_tests():
    """Its test module, executed with the other imports."""
    private = types.ModuleType("scipy.stats._qmc")
    vars(private).update(vars(scipy.stats._qmc), **{name: getattr(qmc, name) for name in qmc.__all__})
    module = types.ModuleType("scipy_tests")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scipy.stats, "qmc", qmc)
        patch.setattr(scipy.stats, "_qmc", private)
        patch.setitem(sys.modules, "scipy.stats.qmc", qmc)
        patch.setitem(sys.modules, "scipy.stats._qmc", private)
        exec(compile(SOURCE.read_text(encoding="utf-8"), SOURCE, "exec"), vars(module))
    return module


THEIRS = scipys_tests()
globals().update({name: value for name, value in vars(THEIRS).items() if name.lower().startswith("test")})


@pytest.fixture(autouse=True)
def listed_tests_fail(request):
    reason = OTHERWISE.get(request.node.nodeid.split("::", 1)[1])
    if reason:
        request.node.add_marker(pytest.mark.xfail(strict=True, raises=AssertionError, reason=reason))


def test_what_is_tested_is_ours():
    assert THEIRS.qmc is qmc and THEIRS.van_der_corput is qmc.van_der_corput
    assert THEIRS.TestSobol.qmce is qmc.Sobol and not issubclass(qmc.Sobol, scipy.stats.qmc.Sobol)


@pytest.mark.parametrize("name", OTHERWISE)
def test_listed_tests_exist(name):
    place = THEIRS
    for part in name.split("[")[0].split("::"):
        place = getattr(place, part)
