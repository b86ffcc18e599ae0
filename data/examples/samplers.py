# SPDX-License-Identifier: MIT
# %% [markdown]
# Which sampler has the least star discrepancy? A study measures each with five seeds.
# %%
import stipple

samplers = ["random", "latin-hypercube", "sobol:scramble=owen"]
study = stipple.study(samplers, "star-discrepancy", n=[64, 256], seeds=5)

# %% [markdown]
# Means over the seeds, with the interval of Student's t.
# %%
for mean in study.means():
    if mean.key == "value":
        print(f"{mean.generator:20} n = {mean.count:4}  {mean.mean:.4f}  [{mean.low:.4f}, {mean.high:.4f}]")

# %% [markdown]
# The sets of the first seed in one frame, in colours, and a page with all of their measures.
# %%
sets = {name: stipple.generate(name, 256) for name in samplers}
stipple.report("samplers.html", sets)
stipple.plot(sets)
