# SPDX-License-Identifier: MIT
"""Messages name arguments and calls, not options and commands of the program."""

import inspect
import itertools
import keyword
import re
import warnings

import numpy as np
import pytest

import stipple
from stipple import _errors
from stipple.units import records

X = {d: np.random.default_rng(1).random((16, d)) for d in (1, 2, 3, 5)}
WRONG = ("x", -1, 1e300, "[1 2,3]")
PARAMETERS = {"parameters": [{"name": "a", "range": [1, 100], "scale": "log"}, {"name": "m", "levels": ["y", "x"]}]}
OPTION = re.compile(r"(?<![\w(-])(--[a-z]|-[a-zA-Z](?![\w(*^]))")


def argument(option):
    return option.replace("-", "_") + "_" * keyword.iskeyword(option)


ARGUMENTS = {"n", "d"} | {
    name for call in stipple.__all__ if inspect.isfunction(getattr(stipple, call))
    for name in inspect.signature(getattr(stipple, call)).parameters
} | {argument(option["name"]) for kind in records().values() for unit in kind.values() for option in unit.get("options", [])}


@pytest.fixture
def said(monkeypatch):
    """All messages of the library, with what became of them."""
    known = {}
    translate = _errors.in_python
    monkeypatch.setattr(_errors, "in_python", lambda message: known.setdefault(message, translate(message)))
    return known


def wrong_options(unit):
    return [{}] + [{argument(option["name"]): wrong} for option in unit["options"] for wrong in WRONG]


def wrong_generators():
    for unit in records()["generators"].values():
        for options in wrong_options(unit):
            yield stipple.generate, (unit["name"], 5, 2), options
        for n, d in ((0, 2), (5, 0), (5, 10**5), (2**50, 3)):
            yield stipple.generate, (unit["name"], n, d), {"start": 2**40} if n == 5 else {}
        yield stipple.sequence, (unit["name"], 2), {}


def wrong_warps():
    for unit in itertools.chain(records()["warps"].values(), records()["scrambles"].values()):
        for call, d in itertools.product((stipple.warp, stipple.inverse, stipple.pdf), (1, 2, 5)):
            yield call, (X[d], unit["name"]), {}
        yield stipple.warp, (X[2] + 3, unit["name"]), {}
        yield stipple.inverse, (X[2] + 3, unit["name"]), {}
        for options in wrong_options(unit):
            yield stipple.warp, (X[2], unit["name"]), options
    yield stipple.scramble, (X[2] + 3, "owen"), {}


def wrong_analyzers():
    sets = [X[1], X[5], X[2] + 3, stipple.warp(X[2], "disk") + 0, stipple.warp(X[2], "sphere"),
            stipple.warp(X[2], "disk"), stipple.generate("random", 16, parameters=PARAMETERS, return_meta=True)]
    for unit in records()["analyzers"].values():
        for x in sets:
            yield stipple.analyze, (unit["name"], x), {}
        for domain in ("disk", "sphere", "box:bounds=[0..1]", "unit-cube x disk@1,2"):
            yield stipple.analyze, (unit["name"], X[3]), {"domain": domain}
        for options in wrong_options(unit):
            yield stipple.analyze, (unit["name"], X[2]), options
        yield stipple.study, ("random", unit["name"]), {"n": 5, "d": [1, 5], "keys": "no such"}


def wrong_files(folder):
    sets = [X[1], X[5], [X[2], X[2]], [X[2], X[2][:5]], [X[1], X[2]]]
    for unit, x in itertools.product(records()["formats"].values(), sets):
        yield stipple.write, (folder / "a.dat", x), {"format": unit["name"], "precision": 3}
    for name, content in {"a.csv": "a,b\nx,1\n", "b.csv": "a,a\n1,2\n", "c.csv": "a,b\n1\n", "d.csv": "\"a,b\n", "a.bin": "12345678",
                          "a.json": "{\"points\": 3}", "b.json": "[{\"x\": \"a\"}]", "a.txt": "1 2\n3 x\n", "a.npy": "12",
                          "a.ply": "ply\n", "a.xyz": "1", "b.txt": "", "e.csv": "a\n\n", "f.csv": "a,b\n1,\n", "a.jsonl": "[1,2]\n[3]\n",
                          "b.jsonl": "{\"x\": 1, \"y\": \"a\"}\n", "a.gz": "x", "a.psa": "1", "a.utk": "x"}.items():
        (folder / name).write_text(content)
        yield stipple.read, (folder / name,), {}
        yield stipple.read, (folder / name,), {"format": "npy"}
    yield stipple.write, (folder / "a.nothing", X[2]), {}
    yield stipple.report, (folder / "a.html", X[2] + 3), {}
    yield stipple.plot, (X[5] * 1e300,), {}
    yield stipple.plot, (stipple.study("random", "moments", n=16),), {"key": "no such"}
    yield stipple.plot, (stipple.analyze("moments", X[2]),), {"key": "no such"}
    for bounds, warp in itertools.product(("1..0", "0..1,0..1,0..1", "x"), (None, "disk", ["disk", "sphere"])):
        yield stipple.generate, ("random", 5, 2), {"bounds": bounds, "warp": warp}


@pytest.mark.parametrize("kind", ["generators", "warps", "analyzers", "files"])
def test_no_message_names_an_option_of_the_program(kind, said, tmp_path):
    calls = {"generators": wrong_generators, "warps": wrong_warps, "analyzers": wrong_analyzers,
             "files": lambda: wrong_files(tmp_path)}[kind]()
    refused, problems = 0, set()
    for call, arguments, options in calls:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                call(*arguments, **options)
            except stipple.Error:
                refused += 1
    assert refused > 50 and len(said) > 20
    for message, sentence in said.items():
        others = {argument(name) for name in re.findall(r"--([a-z][a-z-]*)", message)} - ARGUMENTS - {"count", "dimension"}
        named = [name for name in others if re.search(rf"\b{name}\b(?!\()", sentence)]
        if OPTION.search(sentence) or named or re.search("'stipple (?!help)", sentence):
            problems.add(f"{message}  ->  {sentence}")
    assert not problems, "\n".join(sorted(problems))


def test_notes_name_arguments(tmp_path):
    (tmp_path / "a.csv").write_text(",a,b\nfirst,0.1,0.2\nsecond,0.3,0.4\n")
    with pytest.warns(stipple.Note, match="pandas") as notes:
        assert stipple.read(tmp_path / "a.csv").shape == (2, 2)
    assert not any(OPTION.search(str(note.message)) for note in notes)


def test_failures_of_a_study_name_arguments():
    failures = set()
    for name in records()["analyzers"]:
        try:
            failures |= {row.failure for row in stipple.study(["random", "random -w sphere"], name, n=[1, 5], d=[2, 5])}
        except stipple.Error:
            pass
    assert len(failures) > 5 and not [failure for failure in failures if OPTION.search(failure)]


def test_descriptions_name_arguments():
    for kind, units in stipple.list().items():
        for name, summary in units.items():
            assert not re.search(r"(?<!\w)(--[a-z]|-[nd] )", summary + stipple.describe(name)), name


@pytest.mark.parametrize("message, sentence", [
    ("--count: 3 is odd", "n: 3 is odd"),
    ("name the coordinates: disk@1,2, or make points with -d 2", "name the coordinates: disk@1,2, or make points with d=2"),
    ("a.bin: raw numbers have no dimension; give it with -d", "a.bin: raw numbers have no dimension; give it with d"),
    ("'stipple warp \"disk:center=[0 1]\" --inverse' takes them back", "inverse(x, 'disk:center=[0 1]') takes them back"),
    ("'stipple warp disk@1,2 --inverse' takes them back", "inverse(x, 'disk@1,2') takes them back"),
    ("--unit-cube beside --parameters leaves generated points there; 'stipple warp parameters --parameters FILE --inverse' takes others back",
     "inverse(x, x.meta['domain']) takes them back to the cube"),
    ("use fewer axes, or fewer coordinates with --column", "use fewer axes, or fewer coordinates with x[:, columns]"),
    ("--max-memory and --minimum-distance", "max_memory and minimum_distance"),
    ("--from contradicts --count", "from_ contradicts n"),
    ("time-limit: -1 is outside", "time_limit: -1 is outside"),
    ("star-discrepancy: time-limit: 'x' is no number", "star-discrepancy: time_limit: 'x' is no number"),
    ("unknown option 'tme-limit'", "unknown option 'tme_limit'"),
    ("did you mean 'time-limit'?", "did you mean 'time_limit'?"),
    ("known: half-angle, axis", "known: half_angle, axis"),
    ("known: star-discrepancy, poisson-disk", "known: star-discrepancy, poisson-disk"),
    ("iconv -f UTF-16 -t UTF-8 converts it; exp(-x), -r to r, a-d, x --- y", "iconv -f UTF-16 -t UTF-8 converts it; exp(-x), -r to r, a-d, x --- y"),
])
def test_options_become_arguments(message, sentence):
    assert _errors.in_python(message) == sentence
