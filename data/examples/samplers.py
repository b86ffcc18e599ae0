# SPDX-License-Identifier: MIT
# Which sampler has the least star discrepancy? A study of generators, with means over seeds.
import stipple

study = stipple.study(
    ["random", "latin-hypercube", "sobol:scramble=owen"], "star-discrepancy", n=[64, 256], seeds=5
)
for mean in study.means():
    if mean.key == "value":
        print(f"{mean.generator:20} n = {mean.count:4}  {mean.mean:.4f}  [{mean.low:.4f}, {mean.high:.4f}]")
