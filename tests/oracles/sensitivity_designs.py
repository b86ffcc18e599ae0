"""Sensitivity analysis of structured designs: indices recomputed from the tables, what inputs follow, mutated tables."""
import itertools
import json
import math
import os
import random
import re
import subprocess
import tempfile

import numpy
import scipy.stats

models = [
    lambda u: math.sin(math.pi * (2 * u[0] - 1)) + (7 * math.sin(math.pi * (2 * u[1] - 1)) ** 2 if len(u) > 1 else 0),
    lambda u: math.prod((abs(4 * x - 2) + a) / (1 + a) for a, x in enumerate(u)),
    lambda u: sum((i + 1) * x for i, x in enumerate(u)),
    lambda u: 1e9 + sum(x * y for x, y in itertools.pairwise(u)) + u[0],
]


class Files:
    """Files in a temporary folder, removed with the object."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as out:
            out.write(text)
        return self.path(name)


def csv(header, rows):
    return "\n".join([",".join(header)] + [",".join(repr(float(x)) for x in row) for row in rows]) + "\n"


def names(k):
    return [f"in{i + 1}" for i in range(k)]


def run(cases, *words):
    """Results and messages of an analysis, for any exit code; results are None if there are none."""
    done = subprocess.run([cases.program, "analyze", "sensitivity", *map(str, words)], capture_output=True, text=True)
    results = json.loads(done.stdout)["results"] if done.returncode == 0 and done.stdout.startswith("{") else None
    return results, done.stderr


def table_of(files, rows, y, name="table.csv"):
    return files.write(name, csv(names(len(rows[0])) + ["out"], [[*row, value] for row, value in zip(rows, y)]))


# ---------------------------------------------------------------- pick-freeze


def jansen_and_saltelli(y, k, pairs):
    """Saltelli et al. 2010, table 2 (b) and (f), second order as in Saltelli 2002; groups A, AB.., [BA..,] B."""
    group = 2 * k + 2 if pairs else k + 2
    f = numpy.array(y).reshape(-1, group)
    f = f - f.mean()
    a, b, ab = f[:, 0], f[:, -1], f[:, 1:k + 1]
    variance = numpy.var(numpy.concatenate([a, b]))
    first = [numpy.mean(b * (ab[:, i] - a)) / variance for i in range(k)]
    total = [numpy.mean((a - ab[:, i]) ** 2) / 2 / variance for i in range(k)]
    second = {}
    for i in range(k if pairs else 0):
        for j in range(i + 1, k):
            ba = f[:, k + 1 + i]
            second[i, j] = numpy.mean(ba * ab[:, j] - a * b) / variance - first[i] - first[j]
    return first, total, second


def check_pick_freeze(cases):
    """Saltelli's rows: indices by the formulas of Saltelli 2010, Jansen and Saltelli 2002"""
    files = Files()
    for k, bases, pairs, m in itertools.product((1, 2, 3, 5), (4, 32), (False, True), range(len(models))):
        group = 2 * k + 2 if pairs else k + 2
        rows = cases.points("generate", "saltelli", "-d", k, "-n", bases * group, *(["--second-order"] if pairs else []))
        y = [models[m](row) for row in rows]
        found, _ = run(cases, table_of(files, rows, y), "--response", "out", "--bootstrap", 0)
        found = found["out"]
        cases.expect(f"method of {k} {bases} {pairs}", found["method"] == "saltelli", found["method"])
        first, total, second = jansen_and_saltelli(y, k, pairs and found["samples"] * group == len(rows))
        for i, name in enumerate(names(k)):
            cases.compare(f"first {k} {bases} {pairs} {m}", found[name]["first"], first[i], 1e-6, 1e-6)
            cases.compare(f"total {k} {bases} {pairs} {m}", found[name]["total"], total[i], 1e-6, 1e-6)
        for (i, j), value in second.items():
            pair = found[f"in{i + 1}:in{j + 1}"]["second"]
            cases.compare(f"second {k} {bases} {m}", pair, value, 1e-6, 1e-6)


# ---------------------------------------------------------------- elementary effects

marginals = [
    ({"range": [1, 100], "scale": "log"}, scipy.stats.loguniform(1, 100)),
    ({"range": [-3, 5]}, scipy.stats.uniform(-3, 8)),
    ({"distribution": "triangular", "low": 0, "high": 4, "mode": 1}, scipy.stats.triang(0.25, 0, 4)),
    ({"distribution": "normal", "mean": 5, "deviation": 2}, scipy.stats.norm(5, 2)),
]


def effects(rows, u, y, radial):
    """Mean, mean size and standard deviation of elementary effects, as defined by Morris 1991 and Campolongo 2007."""
    k = len(rows[0])
    all_effects = [[] for _ in range(k)]
    for at in range(0, len(rows), k + 1):
        for s in range(1, k + 1):
            before = at if radial else at + s - 1
            (i,) = [j for j in range(k) if rows[before][j] != rows[at + s][j]]
            all_effects[i].append((y[at + s] - y[before]) / (u[at + s][i] - u[before][i]))
    return [(numpy.mean(e), numpy.mean(numpy.abs(e)), numpy.std(e, ddof=1)) for e in all_effects]


def compare_effects(cases, what, found, right, k):
    for i, name in enumerate(names(k)):
        size = max(abs(x) for x in right[i])
        for key, value in zip(("mu", "mu_star", "sigma"), right[i]):
            cases.compare(f"{what} {key} of {name}", found[name][key], value, 1e-8, 1e-8 * size)


def check_elementary_effects(cases):
    """Morris' effects on distributions: of CSV with --parameters, JSON and provenance lines the same"""
    files = Files()
    for k, radial, m in itertools.product((1, 2, 4), (False, True), range(len(models))):
        own = [{"name": name, **marginals[i][0]} for i, name in enumerate(names(k))]
        parameters = files.write("p.json", json.dumps({"parameters": own}))
        words = ["generate", "morris", "-d", k, "-n", 12 * (k + 1), "--parameters", parameters]
        words += ["--radial"] if radial else ["--middles"]
        design = {end: files.path("design" + end) for end in (".csv", ".json", "_meta.csv")}
        for end, path in design.items():
            cases.run(*words, "-o", path, *(["--meta"] if end == "_meta.csv" else []))
        with open(design[".json"], encoding="utf-8") as json_file:
            rows = json.load(json_file)["points"]
        u = [[float(marginals[j][1].cdf(x)) for j, x in enumerate(row)] for row in rows]
        y = [models[m](row) for row in u]
        right = effects(rows, u, y, radial)
        outputs = files.write("y.csv", "out\n" + "\n".join(map(repr, y)) + "\n")
        with open(design["_meta.csv"], encoding="utf-8") as lines:
            told = [line for line in lines.read().splitlines() if line.startswith("#")]
        joined = files.write("joined.csv", "\n".join(told) + "\n" + csv(names(k) + ["out"], [[*r, v] for r, v in zip(rows, y)]))
        ways = {
            "json": [outputs, "--design", design[".json"]],
            "csv and parameters": [outputs, "--design", design[".csv"], "--parameters", parameters],
            "provenance lines": [outputs, "--design", design["_meta.csv"]],
            "a column added": [joined],
            "a table and parameters": [table_of(files, rows, y), "--parameters", parameters],
        }
        method = ["--method", "morris"] if k == 1 else []
        for way, arguments in ways.items():
            found, told_of = run(cases, *arguments, *method)
            if found is None:
                cases.expect(f"{way} {k} {radial}", False, told_of)
                continue
            found = found["out"]
            cases.expect(f"{way}: scale", (found["method"], found["scale"]) == ("morris", "distributions"),
                         (found["method"], found["scale"]))
            compare_effects(cases, f"{way} {k} {radial} {m}", found, right, k)


def check_morris_levels(cases):
    """Morris' levels 0, 1/(p-1), ..., 1 and steps p/(2(p-1)); Ishigami's mu* by enumeration of all of them"""
    files = Files()
    pi = math.pi
    functions = [
        lambda x: math.sin(x[0]) + 7 * math.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * math.sin(x[0]),
    ]
    for p, f in itertools.product((4, 6, 8, 10), functions):
        rows = cases.points("generate", "morris", "-d", 3, "--levels", p, "--trajectories", 400)
        levels = [l / (p - 1) for l in range(p)]
        for x in {x for row in rows for x in row}:
            cases.expect(f"level {x} of {p}", min(abs(x - l) for l in levels) < 2e-16)
        step = p / (2 * (p - 1))
        scaled = [[2 * pi * (x - 0.5) for x in row] for row in rows]
        outputs = [f(row) for row in scaled]
        found, _ = run(cases, table_of(files, scaled, outputs), "--bounds", f"{-pi!r}..{pi!r}", "--response", "out")
        found = found["out"]
        cases.expect(f"scale {p}", found["scale"] == "box", found["scale"])
        compare_effects(cases, f"levels {p}", found, effects(scaled, rows, outputs, False), 3)
        # 7 sin^2(x2) adds up with nothing: its effects are those of all p / 2 steps.
        sizes = [abs(7 * math.sin(pi * (2 * (l / (p - 1) + step) - 1)) ** 2 - 7 * math.sin(pi * (2 * l / (p - 1) - 1)) ** 2)
                 / step for l in range(p // 2)]
        cases.compare(f"mu* of x2, p = {p}", found["in2"]["mu_star"], numpy.mean(sizes), 0.1)
    cases.compare("7.875", numpy.mean([7 * math.sin(pi / 3) ** 2 * 1.5]), 7.875, 1e-12)


# ---------------------------------------------------------------- FAST


def fast_indices(y, k, harmonics):
    """Saltelli, Tarantola, Chan 1999: power at harmonics of w, and at all frequencies up to w / 2."""
    n = len(y) // k
    w = (n - 1) // (2 * harmonics)
    found = []
    for i in range(k):
        power = numpy.abs(numpy.fft.fft(y[i * n:(i + 1) * n]) / n)[1:(n - 1) // 2 + 1] ** 2
        own = sum(power[p * w - 1] for p in range(1, harmonics + 1))
        found.append((own / power.sum(), 1 - power[:w // 2].sum() / power.sum()))
    return found


def check_fast(cases):
    """FAST's curves: shares of the spectrum by NumPy's FFT; the design's own harmonics, also over distributions"""
    files = Files()
    for k, harmonics, m in itertools.product((2, 3, 4), (1, 2, 3, 4, 6), range(len(models))):
        own = [{"name": name, **marginals[i][0]} for i, name in enumerate(names(k))]
        parameters = files.write("p.json", json.dumps({"parameters": own}))
        n = 8 * harmonics * harmonics * (4 if harmonics < 3 else 1) + 65
        rows = cases.points("generate", "fast", "-d", k, "-n", n * k, "--harmonics", harmonics, "--parameters", parameters)
        y = [models[m]([float(marginals[j][1].cdf(x)) for j, x in enumerate(row)]) for row in rows]
        found, told = run(cases, table_of(files, rows, y), "--response", "out")
        if found is None or found["out"]["method"] != "fast":
            cases.expect(f"fast {k} {harmonics}", False, found["out"]["method"] if found else told)
            continue
        for name, (first, total) in zip(names(k), fast_indices(y, k, harmonics)):
            cases.compare(f"first {k} {harmonics} {m}", found["out"][name]["first"], first, 1e-6, 1e-7)
            cases.compare(f"total {k} {harmonics} {m}", found["out"][name]["total"], total, 1e-6, 1e-7)


# ---------------------------------------------------------------- columns


def check_columns(cases):
    """Which columns are inputs and outputs: by name, whatever their order; none vanishes"""
    files = Files()
    parameters = files.write("p.json", json.dumps({"parameters": [{"name": "b", "range": [0, 1]},
                                                                    {"name": "a", "range": [0, 10]}]}))
    rows = cases.points("generate", "sobol", "--scramble", "owen", "-n", 64)
    columns = {"a": [10 * r[0] for r in rows], "b": [r[1] for r in rows]}
    columns["out"] = [0.3 * a + b for a, b in zip(columns["a"], columns["b"])]
    columns["other"] = [a * b for a, b in zip(columns["a"], columns["b"])]
    for order in itertools.permutations(columns):
        table = files.write("t.csv", csv(order, zip(*(columns[name] for name in order))))
        found, told = run(cases, table, "--parameters", parameters, "--method", "rank")
        cases.expect(f"{order}: outputs", found is not None and set(found) == {"out", "other"}, found and list(found))
        if found:
            inputs = [key for key, value in found["out"].items() if isinstance(value, dict)]
            cases.expect(f"{order}: inputs", inputs == ["b", "a"], inputs)
    design = files.write("d.csv", csv(["a", "b"], zip(columns["a"], columns["b"])))

    def outputs(*given, header):
        return files.write("y.csv", csv(header, zip(*given)))

    y = columns["out"]
    found, told = run(cases, outputs(y, header=["a"]), "--design", design)
    cases.expect("an output with an input's name is refused", found is None and "other numbers" in told, told)
    found, told = run(cases, outputs(y, header=["a"]), "--design", design, "--response", "a", "--method", "rank")
    cases.expect("or picked", found is not None and list(found) == ["a"], told)
    found, told = run(cases, outputs(y, columns["a"], header=["out", "copy"]), "--design", design, "--method", "rank")
    cases.expect("an output equal to an input is kept", found is not None and list(found) == ["out", "copy"], told)
    cases.expect("and noted", "copy is equal to the input a" in told, told)
    found, told = run(cases, outputs(columns["b"], y, columns["a"], header=["b", "out", "a"]), "--design", design, "--method", "rank")
    cases.expect("copies of inputs are none", found is not None and list(found) == ["out"], told)
    found, told = run(cases, outputs(columns["a"], columns["b"], header=["a", "b"]), "--design", design)
    cases.expect("nothing but copies", found is None and "copies of inputs" in told, told)
    wrong = files.write("w.json", json.dumps({"parameters": [{"name": "b", "range": [0, 1]}, {"name": "c", "range": [0, 1]}]}))
    found, told = run(cases, table, "--parameters", wrong)
    cases.expect("a parameter that is no column", found is None and "no column c" in told, told)


# ---------------------------------------------------------------- broken designs


def check_broken_designs(cases):
    """Designs whose rows constraints, copulas, nested ranges or another order broke: said, with and without provenance"""
    files = Files()
    free = [{"name": "a", "range": [0, 1]}, {"name": "b", "range": [0, 1]}, {"name": "c", "range": [0, 1]}]
    nested = [free[0], {"name": "b", "range": [0, "a"]}, free[2]]
    kinds = {
        "constraint": {"parameters": free, "constraints": ["a + b < 1.2"]},
        "copula": {"parameters": free, "correlation": {"copula": "gaussian", "spearman": [["a", "b", 0.7]]}},
        "nested": {"parameters": nested},
        "shuffled": {"parameters": free},
    }
    for generator, (kind, text) in itertools.product(("saltelli", "morris", "fast"), kinds.items()):
        parameters = files.write("p.json", json.dumps(text))
        count = {"saltelli": 640, "morris": 640, "fast": 780}[generator]
        words = ["generate", generator, "-n", count, "--parameters", parameters]
        words += ["--radial"] if generator == "morris" else []
        for meta in (False, True):
            lines = cases.run(*words, *(["--meta"] if meta else [])).splitlines()
            told_lines = [line for line in lines if line.startswith("#")]
            header, *body = lines[len(told_lines):]
            if kind == "shuffled":
                random.Random(5).shuffle(body)
            outputs = files.write("y.csv", "\n".join(["out"] + [repr(sum(map(float, row.split(",")))) for row in body]) + "\n")
            design = files.write("d.csv", "\n".join(told_lines + [header] + body) + "\n")
            found, told = run(cases, outputs, "--design", design)
            what = f"{generator} {kind} {'provenance' if meta else 'plain'}: "
            if found is None:
                cases.expect(what, False, told)
                continue
            cases.expect(what + "another method", found["out"]["method"] in ("rank", "chaos"), found["out"]["method"])
            if meta:
                cases.expect(what + "said", f"{generator} made the design" in told, told)
            elif generator != "fast":
                cases.expect(what + "said", "differ from another row in one input" in told, told)
            if kind != "shuffled":
                cases.expect(what + "dependence", "depend on each other" in told, told)
            else:
                cases.expect(what + "no dependence", "depend on each other" not in told, told)
    # Replicated two-level factorials are neither of them, whatever their order and their replicates.
    for k, replicates, seed in itertools.product((2, 3), (2, 3, 8), range(3)):
        corners = sorted(itertools.product((0.0, 1.0), repeat=k), key=lambda row: (sum(row), row[::-1]))
        middle = corners[1:1 + k] + [tuple(1 - x for x in row) for row in corners[1:1 + k]]
        rows = ([corners[0]] + (middle if k > 2 else middle[:k]) + [corners[-1]]) * replicates
        noise = random.Random(seed)
        y = [sum(row) + 0.01 * noise.random() for row in rows]
        found, told = run(cases, table_of(files, rows, y), "--response", "out")
        if found is not None:
            cases.expect(f"2^{k} x {replicates}", found["out"]["method"] != "saltelli", found["out"]["method"])
        else:
            cases.expect(f"2^{k} x {replicates}", "saltelli" not in told, told)


# ---------------------------------------------------------------- mutated tables


def mutated(rows, rng):
    """The rows with one to three typical faults of tables."""
    rows = [list(row) for row in rows]
    odd = [0.0, -0.0, 1.0, 0.5, 1e16, -1e16, 1e300, -1e300, 1.7e308, 5e-324, 1e-300, 1 + 2**-52, 1e-16, float("nan")]
    width = len(rows[0])
    for _ in range(rng.randint(1, 3)):
        kind, i, j = rng.randrange(12), rng.randrange(len(rows)), rng.randrange(width)
        column = rng.choice([j, width - 1])
        value = rng.choice(odd)
        if kind == 0:
            rows[i][column] = value
        elif kind == 1:
            for row in rows:
                row[column] = value
        elif kind == 2 and len(rows) > 2:
            del rows[i]
        elif kind == 3:
            rows.insert(i, list(rows[rng.randrange(len(rows))]))
        elif kind == 4:
            a = rng.randrange(len(rows))
            rows[i], rows[a] = rows[a], rows[i]
        elif kind == 5:
            for row in rows:
                row[column] = float(round(row[column] * 2) if abs(row[column]) < 1e9 else 1)
        elif kind == 6:
            for row in rows:
                row[width - 1] = row[j]
        elif kind == 7:
            scale = rng.choice([1e-320, 1e-170, 1e-16, 1e160, 1e300])
            for row in rows:
                row[column] *= scale
        elif kind == 8:
            for row in rows:
                row[column] = 1e9 + row[column] * rng.choice([1e-6, 1e-8])
        elif kind == 9:
            for at, row in enumerate(rows):
                if at % rng.randint(2, 7):
                    row[width - 1] = value
        elif kind == 10:
            rows = rows[:rng.randint(1, len(rows))]
        else:
            for row in rows:
                row[width - 1] = 1 + 1e-15 * rng.random()
    return [[x if math.isfinite(x) or x != x else 1.7e308 for x in row] for row in rows]


def strange(results, path=""):
    """Results that are not numbers, or indices that no estimate of a fraction can have."""
    for key, value in results.items():
        if isinstance(value, dict):
            yield from strange(value, f"{path}{key}.")
        elif value is None or (isinstance(value, float) and not math.isfinite(value)):
            yield path + key, value
        elif key in ("first", "total", "second") and abs(value) > 10:
            yield path + key, value


def measured(cases, tables, method, form):
    """Output of an analysis of these tables, and the accepted tables; rejected ones are counted."""
    tables = list(tables)
    while tables:
        words = [cases.program, "analyze", "sensitivity", *tables, "--method", method, "-f", form, "--response", "out"]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode == 0:
            return done.stdout, tables
        refused = [table for table in tables if table in done.stderr.splitlines()[-1]]
        if done.returncode != 3 or len(refused) != 1:
            cases.expect(f"{method} of {tables}", False, f"exit {done.returncode}: {done.stderr}")
            return "", []
        last = done.stderr.splitlines()[-1].replace(refused[0], "")
        cases.expect(f"{method}: {last}", not re.search(r"\b(nan|inf)\b", last), last)
        tables.remove(refused[0])
    return "", []


def check_mutated_tables(cases):
    """3000 mutated tables: no nan, no inf and no absurd index in any format"""
    files = Files()
    bases = []
    for words in (["saltelli", "-d", 2, "-n", 32], ["saltelli", "-d", 2, "-n", 60, "--second-order"], ["morris", "-d", 3],
                  ["morris", "-d", 2, "--radial"], ["fast", "-d", 2, "-n", 130], ["sobol", "-d", 2, "-n", 24],
                  ["random", "-d", 1, "-n", 12], ["factorial", "-d", 2, "--levels", 3]):
        rows = cases.points("generate", *words)
        bases.append([[*row, models[len(bases) % 3](row)] for row in rows])
    for batch in range(50):
        tables = []
        for seed in range(60 * batch, 60 * batch + 60):
            rows = mutated(bases[seed % len(bases)], random.Random(seed))
            lines = [",".join("" if x != x else repr(x) for x in row) for row in rows]
            header = ",".join(names(len(rows[0]) - 1) + ["out"])
            tables.append(files.write(f"t{seed}.csv", "\n".join([header, *lines]) + "\n"))
        method = "rank" if batch % 5 == 4 else "auto"
        text, left = measured(cases, tables, method, "json")
        reports = json.loads(text) if len(left) > 1 else [json.loads(text)] if left else []
        for report in reports:
            found = list(strange(report["results"]))
            cases.expect(f"{method} of {os.path.basename(report['input']['source'])}", not found, found)
        for form in ("text", "csv"):
            words = measured(cases, left, method, form)[0].replace(",", " ").split() if left else []
            found = [word for word in words if word.strip("-+").lower() in ("nan", "inf", "null")]
            cases.expect(f"{method}, batch {batch}, {form}", not found, found)
