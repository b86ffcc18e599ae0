# SPDX-License-Identifier: MIT
"""Uses each public name, with the types that mypy --strict finds; run by test_types.py."""

from pathlib import Path
from typing import assert_type

import numpy as np
from numpy.typing import NDArray

import stipple
from stipple import qmc

Floats = NDArray[np.float64]

x = stipple.generate("sobol", 256, 2, scramble="owen", seed=3)
assert_type(x, Floats)
assert_type(stipple.generate(("halton", {"scramble": "owen"}), n=16, bounds=(0, 1), threads=1), Floats)
assert_type(stipple.generate("halton", n=16, leap=409, bounds=[(0, 1), (2, 3)]), Floats)
points = stipple.generate("sobol", 64, warp=["owen", "disk"], return_meta=True)
assert_type(points, stipple.Points)
assert_type(points.copy(), stipple.Points)
sets = stipple.generate("random", 64, sets=2)
assert_type(sets, Floats | list[Floats])
assert_type(stipple.generate("random", 64, sets=2, return_meta=True), stipple.Points | list[stipple.Points])
frame = stipple.generate("random", 64, as_frame=True)
stipple.write("frame.csv", frame)
assert_type(stipple.plot([stipple.analyze("periodogram", x)] * 2), stipple.Picture)
parameters = {"parameters": [{"name": "a", "range": [2, 3]}]}
assert_type(stipple.generate("random", 64, parameters=parameters), Floats)

# Numbers of NumPy
eight = np.int64(8)
assert_type(stipple.generate("halton", eight, np.int32(2), seed=np.uint8(3), leap=np.int16(409), threads=eight),
            Floats)
stipple.generate("random", eight, seed=eight, start=eight, sets=eight, return_meta=True, max_memory=np.float32(1e9))
stipple.generate("poisson-disk", radius=np.float32(0.1), bounds=(np.float32(0), eight))
stipple.integrate(lambda x: x[:, 0], "random", eight, eight, start=eight, replications=eight, confidence=np.float32(0.9))
stipple.study("random", "moments", n=[eight], d=np.int8(2), seeds=eight, seed=eight)
assert_type(stipple.sequence("halton", eight)[eight], Floats)
assert_type(qmc.Halton(eight, seed=eight).random(eight), Floats)
assert_type(stipple.warp(x, "owen", base=2), stipple.Points)

sequence = stipple.sequence("halton", d=2, scramble="owen")
assert_type(sequence, stipple.Sequence)
assert_type(sequence[0:10], Floats)
assert_type(sequence.d, int)
assert_type(next(sequence.blocks(16)), Floats)

disk = stipple.warp(x, "disk", method="concentric")
assert_type(disk, stipple.Points)
assert_type(stipple.warp(x, ("disk", {"radius": 2})), stipple.Points)
assert_type(stipple.inverse(disk, "disk", method="concentric"), Floats)
assert_type(stipple.pdf(disk, "disk"), Floats)
assert_type(stipple.scramble(x, "owen", seed=7), Floats)

report = stipple.analyze("star-discrepancy", x)
assert_type(report, stipple.Report)
assert_type(report.unmet, list[str])
print(f"{report.value:.4f}", list(report), len(report), report["worst_box.volume"])


def product(points: Floats) -> Floats:
    values: Floats = points[:, 0] * points[:, 1]
    return values


assert_type(stipple.analyze("integration", x, integrand=product, exact=0.25), stipple.Report)
integral = stipple.integrate(product, "sobol:scramble=owen", 64, 2, confidence=0.9, mean=True)
assert_type(integral, stipple.Integral)
assert_type(integral.standard_error, float)
assert_type(integral.estimates, Floats)

stipple.write(Path("points.csv"), x, precision=3, header=False)
back = stipple.read(Path("points.csv"), threads=2)
assert_type(back, stipple.Points | list[stipple.Points])

study = stipple.study(["random", ("halton", {})], "star-discrepancy", n=[16, 64, 256], d=2, seeds=3, keys="value")
assert_type(study, stipple.Study)
assert_type(study[0], stipple.StudyValue)
assert_type(study[0].value, float | None)
assert_type(study.means(0.9)[0], stipple.StudyMean)

picture = stipple.plot({"disk": disk, "square": x}, title="two", width=300)
assert_type(picture, stipple.Picture)
assert_type(picture.svg, str)
picture.save("two.pdf")
assert_type(stipple.plot(study, key="value"), stipple.Picture)
assert_type(stipple.plot({"a": stipple.analyze("periodogram", x)}), stipple.Picture)
page = stipple.report("page.html", {"disk": disk}, progress=lambda share: None)
assert_type(page, stipple.Page)
assert_type(page.path, str)

assert_type(stipple.list(), dict[str, dict[str, str]])
assert_type(stipple.list("warps"), dict[str, str])
assert_type(stipple.describe("halton"), str)
try:
    stipple.generate("haltn")
except stipple.Error as error:
    assert_type(error.kind, str)
    assert_type(error.hint, str)
assert issubclass(stipple.Note, UserWarning)
print(stipple.__version__)

# The names of scipy.stats.qmc
assert_type(qmc.Sobol(2, scramble=False, seed=np.random.default_rng(1), order="natural").random(8), Floats)
assert_type(qmc.LatinHypercube(2, rng=[1, 2], optimize="maximin").random(8), Floats)
assert_type(qmc.PoissonDisk(2, radius=0.1, u_bounds=[1, 2]).fast_forward(3).fill_space(), Floats)
assert_type(qmc.Engine(3, generator="kronecker").reset().integers(6, n=5), NDArray[np.int64])
assert_type(qmc.discrepancy(x, method="MD") + qmc.geometric_discrepancy(x, metric="cityblock"), float)
assert_type(qmc.n_primes(5), list[int])
assert_type(qmc.van_der_corput(5, 3, scramble=True, seed=None), Floats)

# Wrong calls
stipple.generate("halton", "10")  # error: call-overload
stipple.generate(3)  # error: call-overload
stipple.generate("sobol", 256, 2, scramle="owen")  # error: call-overload
stipple.generate(("sobol", {}), sets=3, scramle="owen")  # error: call-overload
stipple.analyze("star-discrepancy", x, max_wrk=3)  # error: call-overload
stipple.warp(x, "disk", methd="concentric")  # error: call-overload
stipple.scramble(x, "owen", bas=2)  # error: call-overload
stipple.sequence("halton", 2, leep=3)  # error: call-arg
stipple.inverse(x, "disk", methd="concentric")  # error: call-arg
stipple.pdf(x, "disk", methd="concentric")  # error: call-arg
stipple.integrate(product, "sobol", 64, 2, scramle="owen")  # error: call-arg
stipple.generate("halton", bounds=3)  # error: call-overload
stipple.read("a.csv", formt="csv")  # error: arg-type
stipple.integrate(3, "random", 10, 2)  # error: arg-type
stipple.plot(x, titel="x")  # error: call-overload
stipple.study("random", "moments", seeds="3")  # error: arg-type
stipple.write(3, x)  # error: arg-type
qmc.Halton(2, seed="1")  # error: arg-type
qmc.LatinHypercube("2")  # error: arg-type
qmc.PoissonDisk(2, order=print)  # error: arg-type
