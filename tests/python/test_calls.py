# SPDX-License-Identifier: MIT
import io
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import stipple

UNITS = [
    ("sobol", {"scramble": "owen"}, 256, 5),
    ("halton", {}, 100, 3),
    ("latin-hypercube", {"centered": True}, 50, 4),
    ("poisson-disk", {}, 200, 2),
    ("random", {}, 1000, 7),
    ("rank1-lattice", {}, 128, 2),
]


@pytest.mark.parametrize("name,options,n,d", UNITS)
def test_points_are_those_of_the_program(run, name, options, n, d):
    flags = [f"--{key}" if value is True else f"--{key}={value}" for key, value in options.items()]
    out = run("generate", name, *flags, f"-n{n}", f"-d{d}", "--seed=3", "--format=npy")
    there = np.load(io.BytesIO(out))
    here = stipple.generate(name, n=n, d=d, seed=3, **options)
    assert here.dtype == np.float64 and here.shape == (n, d)
    assert here.tobytes() == there.tobytes()
    assert stipple.generate(name, n, d, seed=3, threads=1, **options).tobytes() == there.tobytes()


def test_sets_bounds_warps_and_parameters(run):
    out = run("generate", "jittered", "-n16", "--sets=3", "--bounds=-1..1,0..2", "--format=npy")
    sets = stipple.generate("jittered", 16, sets=3, bounds=[(-1, 1), (0, 2)])
    assert sets.shape == (3, 16, 2)
    assert sets.tobytes() == np.load(io.BytesIO(out)).tobytes()
    out = run("generate", "sobol", "-n64", "-w", "disk:method=polar", "--format=npy")
    disk = stipple.generate("sobol", 64, warp=("disk", {"method": "polar"}))
    assert disk.tobytes() == np.load(io.BytesIO(out)).tobytes()
    parameters = {"parameters": [{"name": "a", "range": [2, 3]}, {"name": "k", "integers": [1, 4]}]}
    points = stipple.generate("sobol", 64, parameters=parameters, return_meta=True)
    assert points[:, 0].min() >= 2 and set(points[:, 1]) == {1, 2, 3, 4}
    assert points.meta["columns"] == ["a", "k"]


def test_meta_is_kept_by_the_array_alone():
    points = stipple.generate("halton", 10, return_meta=True, warp="disk")
    assert points.meta["generator"] == "halton" and points.meta["domain"] == "disk"
    assert points.copy().meta == points.meta and (points + 0).meta is None
    assert not isinstance(stipple.generate("halton", 10), stipple.Points)
    both = stipple.generate("random", 4, sets=2, return_meta=True)
    assert [meta["seed"] for meta in both.meta] == [1, 2]
    moved = points.copy()
    moved /= 10  # is not on the disk's rim any more
    assert moved.meta is None and np.sort(points, axis=0).meta is None and points.meta is not None


# A part of the points has the same domain, but another recipe. Whole sets keep everything, and
# results that are not points have no provenance.
def test_some_of_the_points_keep_their_domain_names_and_levels():
    parameters = {"parameters": [{"name": "a", "range": [2, 3]}, {"name": "m", "levels": ["x", "y"]}]}
    points = stipple.generate("sobol", 64, parameters=parameters, return_meta=True)
    kept = {key: points.meta[key] for key in ("domain", "columns", "levels", "warps")}
    assert kept["columns"] == ["a", "m"] and kept["levels"] == {"m": ["x", "y"]}
    mask = points[:, 0] > 2.5
    indices = [3, 1, 1]
    for part in (points[:50], points[10:], points[::-3], points[mask], points[indices],
                 points[np.array(indices)], points[indices, :], points[..., :][:9], points[5:5],
                 points[mask, ...], points[:7, 0:2]):
        assert part.meta == kept, part.shape
    assert points[:].meta == points.meta and points[...].meta == points.meta
    for part in (points[0], points[:, 0], points[3, 0:2], points[None], points[points > 0], points[:5] * 2, points.T,
                 points[[1, 2], [0, 1]], points.reshape(32, 4)):
        assert getattr(part, "meta", None) is None, part.shape
    disk = stipple.warp(stipple.generate("sobol", 64), "disk")
    assert stipple.analyze("moments", disk[:50])._record[3] == "disk"
    assert stipple.analyze("nearest-neighbor", disk[disk[:, 0] > 0]).mean > 0
    with pytest.raises(stipple.Error, match="no points"):
        stipple.analyze("moments", disk[:0])
    sets = stipple.generate("random", 8, sets=3, warp="disk", return_meta=True)
    assert sets[1].meta == sets.meta[1] and sets[1:].meta == sets.meta[1:]
    assert sets[:, :4].meta == [{"domain": "disk", "warps": ["disk"]}] * 3
    assert sets[[2, 0]].meta == [sets.meta[2], sets.meta[0]]
    assert sets[0, :4].meta == sets[1:2, :4].meta[0] and sets[:, 0].meta is None


# The naive disk has the density 1 / (2 pi r), which its points and parts of them tell of.
def test_meta_of_warped_points_is_that_of_generated_ones(results):
    x = stipple.generate("random", 4096, seed=3, return_meta=True)
    naive = stipple.warp(x, "disk", method="naive")
    made = stipple.generate("random", 4096, seed=3, warp="disk:method=naive", return_meta=True)
    assert np.array_equal(naive, made)
    assert {k: v for k, v in naive.meta.items() if k != "command"} == {k: v for k, v in made.meta.items() if k != "command"}
    ones = lambda points: np.ones(len(points))  # noqa: E731
    for points in (naive, made, naive[:2048]):
        there = stipple.analyze("integration", points, expression="1").expression
        here = stipple.analyze("integration", points, integrand=ones)["lambda"]
        assert here.estimate == pytest.approx(np.pi, rel=0.03) == there.estimate
    there = results("integration", "--expression=1", "--generate", "random", "-n4096", "--seed=3", "-w", "disk:method=naive")
    found = stipple.analyze("integration", made, expression="1").expression
    assert dict(found) == {key: there["expression"][key] for key in found}


def test_parameters_give_the_number_of_coordinates(run, tmp_path):
    file = tmp_path / "p.json"
    file.write_text('{"parameters": [{"name": "a", "range": [2, 3]}, {"name": "b", "range": [0, 1]}, {"name": "m", "levels": ["x", "y"]}]}')
    there = np.load(io.BytesIO(run("generate", "sobol", "-n8", "--parameters", str(file), "--format=npy")))
    for parameters in (file, str(file), json.loads(file.read_text())):
        assert np.array_equal(stipple.generate("sobol", 8, parameters=parameters), there) and there.shape == (8, 3)
    with pytest.raises(stipple.Error) as caught:
        stipple.generate("sobol", 8, 2, parameters=file)
    assert caught.value.kind in ("usage", "input")
    study = stipple.study("sobol", "moments", n=8, parameters=file)
    assert {row.dimension for row in study} == {3} and not any(row.failure for row in study)


def test_reports_say_of_how_many_points_they_are():
    report = stipple.analyze("moments", stipple.warp(stipple.generate("halton", 50, 3), "ball"))
    assert repr(report).startswith("moments of points (50 points, dimension 3, ball)\n")
    assert "0 points" not in repr(stipple.analyze("integration", stipple.generate("halton", 50),
                                                  integrand=lambda x: x[:, 0])).splitlines()[0]


def test_sequences_by_index_and_in_blocks():
    sequence = stipple.sequence("sobol", d=3, scramble="owen", seed=5)
    with pytest.warns(stipple.Note, match="power of two"):
        all_points = stipple.generate("sobol", 3000, 3, scramble="owen", seed=5)
    assert sequence.d == 3
    assert np.array_equal(sequence[0:3000], all_points)
    assert np.array_equal(sequence[1000:2000:7], all_points[1000:2000:7])
    assert np.array_equal(sequence[17], all_points[17])
    assert sequence[5:5].shape == (0, 3)
    blocks = sequence.blocks(1000)
    assert np.array_equal(np.concatenate([next(blocks) for _ in range(3)]), all_points)
    points = iter(sequence)
    assert np.array_equal([next(points) for _ in range(1100)], all_points[:1100])
    with pytest.raises(IndexError):
        sequence[-1]
    with pytest.raises(stipple.Error, match="not a sequence"):
        stipple.sequence("latin-hypercube")


def test_warps_go_there_and_back():
    x = stipple.generate("random", 1000)
    disk = stipple.warp(x, "disk", method="concentric")
    assert disk.shape == (1000, 2) and (np.hypot(*disk.T) <= 1).all()
    assert np.allclose(stipple.inverse(disk, "disk", method="concentric"), x, atol=1e-12)
    assert np.allclose(stipple.pdf(disk, "disk"), 1 / np.pi)
    assert stipple.pdf([[2.0, 0.0]], "disk")[0] == 0
    assert stipple.analyze("chi-square", disk).verdict == "uniform"
    sphere = stipple.warp(x, "sphere")
    assert sphere.shape == (1000, 3) and np.allclose((sphere**2).sum(axis=1), 1)
    assert np.allclose(stipple.inverse(np.array(sphere), "sphere"), x, atol=1e-12)
    assert np.allclose(stipple.pdf(sphere, "sphere"), 1 / (4 * np.pi))
    part = stipple.warp(stipple.generate("random", 10, 4), "sphere@2,3")
    assert part.shape == (10, 5)
    assert np.allclose(stipple.pdf(np.array(part), "sphere@2,3"), 1 / (4 * np.pi))
    two = stipple.warp(np.stack([x, x]), "disk")
    assert np.array_equal(two[0], stipple.warp(x, "disk")) and two.shape == (2, 1000, 2)


def test_scrambles_are_those_of_the_program(run):
    x = stipple.generate("sobol", 64, 2)
    moved = stipple.scramble(x, "owen", seed=7)
    faure = stipple.generate("faure", 25, 5, return_meta=True)  # in base 5
    even = stipple.scramble(faure, "owen")
    assert np.array_equal(even, stipple.scramble(np.asarray(faure), "owen", base=5))
    assert np.array_equal(even, stipple.generate("faure", 25, 5, warp="owen"))
    assert sorted(np.floor(25 * even[:, 4])) == list(range(25))
    csv = run("generate", "sobol", "-n64")
    out = run("warp", "owen", "--seed=7", "--format=npy", stdin=csv)
    assert moved.tobytes() == np.load(io.BytesIO(out)).tobytes()
    assert np.array_equal(stipple.scramble(x[32:], "owen", seed=7, start=32), moved[32:])


@pytest.mark.parametrize(
    "analyzer", ["star-discrepancy", "l2-discrepancy", "chi-square", "periodogram", "nearest-neighbor"]
)
def test_results_are_those_of_the_program(results, analyzer):
    there = results(analyzer, "--generate", "sobol", "-n128")
    here = stipple.analyze(analyzer, stipple.generate("sobol", 128))

    def compare(here, there):
        for key, value in there.items():
            if isinstance(value, dict):
                if key in here:
                    compare(here[key], value)
            elif key in here:
                assert np.array_equal(here[key], value), key

    assert set(here) <= set(there) | {"grid"} or set(there) <= set(here)
    compare(here, there)


def test_reports_are_mappings_with_attributes():
    report = stipple.analyze("star-discrepancy", [[0.5, 0.5]])
    assert report.value == report["value"] == 0.75
    assert "value" in repr(report) and "value" in list(report)
    with pytest.raises(KeyError):
        report["no_such_key"]
    with pytest.raises(AttributeError, match="no_such_key"):
        report.no_such_key
    spectrum = stipple.analyze("periodogram", stipple.generate("random", 64))
    assert isinstance(spectrum["radial.power"], np.ndarray)
    assert "<pre>" in report._repr_html_()


BAD = [
    ([[1, 2], [3]], "no array of points"),
    (np.array([["a", "b"]]), "type <U1"),
    (np.array([[None, 1]]), "type object"),
    ([1.0, 2.0], r"shape \(2,\)"),
    (np.zeros((0, 2)), "there are no points"),
    (np.zeros((3, 0)), "there are no points"),
    ([[0.5, np.nan]], r"x\[0, 1\] is nan"),
    ([[np.inf, 0.5]], r"x\[0, 0\] is inf"),
    (np.zeros((1, 2), complex), "type complex128"),
    (0.5, r"shape \(\)"),
    (None, "is None; expected points"),
    (np.ma.array([[0.5, 0.5]], mask=[[True, False]]), "masked"),
    ([np.ma.array([0.5, 0.5]), np.ma.array([0.5, 0.7], mask=[False, True])], "masked"),
]


@pytest.mark.parametrize("x,message", BAD)
def test_bad_arrays_are_refused(x, message):
    for call in (
        lambda: stipple.analyze("star-discrepancy", x),
        lambda: stipple.warp(x, "disk"),
        lambda: stipple.scramble(x, "owen"),
    ):
        with pytest.raises(stipple.Error, match=message) as caught:
            call()
        assert caught.value.kind == "input"


def test_other_arrays_are_converted():
    x = stipple.generate("sobol", 64, 2)
    value = stipple.analyze("star-discrepancy", x).value
    for same in (
        x.astype(">f8"),
        np.asfortranarray(x),
        np.repeat(x, 2, axis=0)[::2],
        x.astype(np.float32),
        x.tolist(),
        np.ma.array(x),
    ):
        assert stipple.analyze("star-discrepancy", same).value == value
    assert stipple.analyze("star-discrepancy", np.array([[0, 1], [1, 0]])).value == 1
    x.flags.writeable = False
    assert stipple.analyze("star-discrepancy", x).value == value


def test_errors_speak_of_arguments():
    with pytest.raises(stipple.Error, match="did you mean 'halton'") as caught:
        stipple.generate("haltn")
    assert caught.value.kind == "usage"
    with pytest.raises(stipple.Error) as caught:
        stipple.generate("multi-jittered", n=7, d=2, no_such_option=1)
    assert "--" not in str(caught.value)
    with pytest.raises(stipple.Error) as caught:
        stipple.generate("random", 10**9, 10, max_memory=10**6)
    assert caught.value.kind == "limit"
    with pytest.raises(stipple.Error) as caught:
        stipple.read("no/such/file.csv")
    assert caught.value.kind == "io"


def test_unknown_arguments_are_refused(tmp_path):
    x = stipple.generate("halton", 10)
    path = tmp_path / "a.csv"
    for call in (
        lambda: stipple.plot(x, nonsense=1),
        lambda: stipple.report(path, x, nonsense=3),
        lambda: stipple.study("random", "moments", nonsense=3),
        lambda: stipple.write(path, x, nonsense=3),
        lambda: stipple.read(path, nonsense=3),
    ):
        with pytest.raises(stipple.Error, match="no argument 'nonsense' .known arguments: ") as caught:
            call()
        assert caught.value.kind == "usage" and not path.exists()
    with pytest.raises(stipple.Error, match="did you mean 'seeds'"):
        stipple.study("random", "moments", sedes=3)
    with pytest.raises(stipple.Error, match="did you mean 'max_memory'"):
        stipple.plot(x, max_memroy=3)


def test_notes_are_warnings():
    with pytest.warns(stipple.Note, match="does not use the seed"):
        stipple.generate("hammersley", 8, sets=2)


def test_files_are_read_and_written(tmp_path):
    x = stipple.generate("halton", 20, 3, return_meta=True)
    for name in ("a.csv", "a.json", "a.npy", "a.csv.gz"):
        stipple.write(tmp_path / name, x)
        assert np.array_equal(stipple.read(tmp_path / name), x)
    assert stipple.read(tmp_path / "a.json").meta["generator"] == "halton"
    stipple.write(tmp_path / "beside.bin", x, meta=True)
    beside = stipple.read(tmp_path / "beside.bin")
    assert np.array_equal(beside, x) and beside.meta["generator"] == "halton"
    stipple.write(tmp_path / "sets.csv", np.stack([x, x]))
    assert len(stipple.read(tmp_path / "sets.csv")) == 2


def test_integrals_have_errors():
    found = stipple.integrate(
        lambda x: x[:, 0] * x[:, 1], "sobol", 256, 2, scramble="owen", replications=32
    )
    assert found.low < 0.25 < found.high and found.standard_error < 1e-3
    assert len(found.estimates) == 32
    area = stipple.integrate(lambda x: np.ones(len(x)), "random", 16, 2, warp="disk", replications=2)
    assert area.estimate == pytest.approx(np.pi)
    square = stipple.integrate(lambda x: x[:, 0] ** 2, "sobol:scramble=owen", 1024, 2, warp="normal", mean=True)
    assert square.estimate == pytest.approx(1, abs=0.02)
    for warp in (None, "sphere"):
        with pytest.raises(stipple.Error, match="do not depend on the seed"):
            stipple.integrate(lambda x: x[:, 0], "halton", 16, 2, warp=warp)
    with pytest.raises(stipple.Error, match="shape"):
        stipple.integrate(lambda x: x, "random", 16, 2)
    with pytest.raises(ZeroDivisionError):
        stipple.integrate(lambda x: 1 // 0, "random", 16, 2)
    with pytest.raises(stipple.Error, match="MaskedArray"):
        stipple.integrate(lambda x: np.ma.array(x[:, 0], mask=x[:, 0] < 0.5), "random", 16, 2)


# Squares of the estimates, or their sums, are beyond float64.
@pytest.mark.parametrize("power", [-1010, -700, 700, 1022])
def test_integrals_have_any_size(power):
    there = stipple.integrate(lambda x: x[:, 0], "random", 16, 2)
    found = stipple.integrate(lambda x: x[:, 0] * 2.0**power, "random", 16, 2)
    assert found.estimate == there.estimate * 2.0**power
    assert found.standard_error == pytest.approx(there.standard_error * 2.0**power, rel=1e-12)
    with pytest.raises(stipple.Error, match="beyond float64"):
        stipple.integrate(lambda x: np.full(len(x), 1e308), "random", 16, 2, warp="disk:radius=1e3")


def test_integrands_are_functions():
    x = stipple.generate("sobol", 1024, 2)

    def product(x):
        return x[:, 0] * x[:, 1]

    found = stipple.analyze("integration", x, integrand=product, exact=0.25)
    there = stipple.analyze("integration", x, expression="x*y", exact=0.25)
    assert found.product.estimate == pytest.approx(there.expression.estimate, abs=1e-15)
    assert found.product.error == pytest.approx(there.expression.error, abs=1e-15)
    disk = stipple.warp(x, "disk")
    ones = stipple.analyze("integration", disk, integrand=lambda x: np.ones(len(x)))
    assert ones["lambda"].estimate == pytest.approx(np.pi)
    assert stipple.analyze("integration", disk, integrand=lambda x: np.ones(len(x)), mean=True)["lambda"].estimate == 1


def test_studies_are_tables(run):
    study = stipple.study(["random", "sobol:scramble=owen"], "star-discrepancy", n=[16, 64], seeds=3)
    assert len({row.key for row in study}) >= 1
    rows = [row for row in study if row.key == "value"]
    assert [(row.generator, row.count, row.seed) for row in rows][:4] == [
        ("random", 16, 1), ("random", 16, 2), ("random", 16, 3), ("random", 64, 1)
    ]
    value = stipple.analyze("star-discrepancy", stipple.generate("random", 16, seed=2)).value
    assert rows[1].value == value
    mean = [m for m in study.means() if m.key == "value"][0]
    assert mean.sets == 3 and mean.low <= mean.mean <= mean.high
    assert "<table>" in study._repr_html_()
    assert [row for row in stipple.study(["random", "sobol:scramble=owen"], "star-discrepancy",
                                         n=[16, 64], seeds=3, keys="value")] == rows
    with pytest.raises(stipple.Error, match="^keys: no measure .* 'vlue' .*did you mean 'value'"):
        stipple.study("random", "star-discrepancy", keys=["vlue"])


def test_pictures_have_the_given_title_and_labels():
    x = stipple.generate("halton", 50)
    assert ">halton.csv<" not in stipple.plot(x).svg
    assert ">my title<" in stipple.plot(x, title="my title").svg
    assert "50 points" not in stipple.plot(x, title="").svg
    both = {"a": x, "b": x}
    named = stipple.plot(both, labels=["first", "second"]).svg
    assert ">first<" in named and ">second<" in named and ">a<" not in named
    with pytest.raises(stipple.Error, match="labels: 1 name for 2 sets"):
        stipple.plot(both, labels="first")
    study = stipple.study(["random", "sobol:scramble=owen"], "star-discrepancy", n=[16, 64], seeds=2)
    for rows in (study, list(study)):
        svg = stipple.plot(rows, labels=["noise", "net"]).svg
        assert ">noise" in svg and ">net" in svg and ">random" not in svg
    assert study[0].generator == "random"
    with pytest.raises(stipple.Error, match="labels: 1 name for 2 generators"):
        stipple.plot(study, labels="noise")
    with pytest.raises(stipple.Error, match=r"study\[1\] is 3"):
        stipple.plot([study[0], 3], labels=["noise", "net"])
    spectrum = stipple.analyze("periodogram", x)
    assert ">my spectrum<" in stipple.plot({"a": spectrum, "b": spectrum}, title="my spectrum").svg


def test_lists_of_sets_and_reports_have_their_numbers_as_names(tmp_path):
    sets = stipple.generate("random", 16, sets=2, warp="disk", return_meta=True)
    named = stipple.plot({"0": sets[0], "1": sets[1]})
    for several in (sets, list(sets), tuple(sets), [one.to_pandas() for one in sets]):
        assert stipple.plot(several).svg == named.svg
    spectra = [stipple.analyze("moments", x) for x in sets]
    assert stipple.plot(spectra).svg == stipple.plot(dict(zip("01", spectra))).svg
    assert ">first<" in stipple.plot(list(sets), labels=["first", "second"]).svg
    page = stipple.report(tmp_path / "a.html", list(sets))
    assert "16 points" in (tmp_path / "a.html").read_text() and page.path
    rows = [[0.1, 0.2], [0.3, 0.4]]
    assert stipple.plot(rows).svg == stipple.plot([np.array(row) for row in rows]).svg
    with pytest.raises(stipple.Error, match="is moments of points .*; expected points"):
        stipple.plot([sets[0], spectra[0]])


def test_formats_of_write_are_those_of_the_library(tmp_path):
    formats = stipple.units.records()["formats"]
    named = re.search(r"its\s+extension: ([^;]*);", stipple.write.__doc__)[1].replace(",", " ").split()
    assert sorted(named) == sorted(name for name, unit in formats.items() if unit["traits"]["extensions"])
    for name in named:
        stipple.write(tmp_path / f"a.{name}", stipple.generate("halton", 16))


# Any two doubles as coordinates give a picture without NaN or infinity, or an error.
def test_pictures_of_all_kinds_of_pairs():
    random = np.random.default_rng(3)
    pairs = list(random.integers(0, 2**64, (60, 2), dtype=np.uint64).view(np.float64))
    pairs += [(x, np.nextafter(x, np.inf)) for x in (0.0, 1.0, 1e15, 1e300, -1e-300, 5e-324)]
    pairs += [(x, x) for x in (0.0, 1e-320, -1e307)] + [(-1e307, 1e307), (1e-300, 1e300), (-1e308, 1e308)]
    refused = 0
    for pair in pairs:
        if not np.isfinite(pair).all():
            continue
        for d in (1, 2, 3, 4):
            x = np.array([[pair[(i + k) % 2] for k in range(d)] for i in range(2)])
            try:
                svg = stipple.plot(x).svg
            except stipple.Error as error:
                assert "an axis can show" in str(error) and abs(x).max() > 6e306
                refused += 1
                continue
            assert len(svg) < 100_000 and not re.search(r"[ \"(ML,](-?nan|-?inf)[ \")<,]", svg), pair
    assert 0 < refused < 100


def test_pictures_and_pages(tmp_path):
    x = stipple.generate("halton", 50)
    picture = stipple.plot({"halton": x, "disk": stipple.generate("random", 50)})
    assert picture._repr_svg_().startswith("<svg") or "<svg" in picture.svg[:200]
    for name, magic in (("a.svg", b"<?xml"), ("a.pdf", b"%PDF-1.4"), ("a.PNG", b"\x89PNG")):
        picture.save(tmp_path / name)
        assert (tmp_path / name).read_bytes().startswith(magic)
    assert (tmp_path / "a.svg").read_text(encoding="utf-8") == picture.svg
    for name in ("a.gif", "a", "svg"):
        with pytest.raises(stipple.Error, match="expected .svg, .pdf or .png"):
            picture.save(tmp_path / name)
        assert not (tmp_path / name).exists()
    page = stipple.report(tmp_path / "a.html", {"halton": x, "random": stipple.generate("random", 50)})
    assert "<html" in (tmp_path / "a.html").read_text()[:500]
    assert "srcdoc=" in page._repr_html_() and "&lt;html" in page._repr_html_()
    spectra = {name: stipple.analyze("periodogram", stipple.generate(name, 64)) for name in ("halton", "random")}
    for drawn in (stipple.plot(spectra), stipple.plot(spectra["halton"])):
        assert "<svg" in drawn.svg[:200] and "radial power" in drawn.svg
    stars = {str(n): stipple.analyze("star-discrepancy", stipple.generate("halton", n)) for n in (8, 16, 64)}
    assert "<svg" in stipple.plot(stars).svg[:200]
    with pytest.raises(stipple.Error, match="no_such"):
        stipple.plot(spectra, key="no_such")
    with pytest.raises(stipple.Error, match="part of a report"):
        stipple.plot(spectra["halton"].radial)
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("svg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots()
    assert stipple.plot(x, axes) is axes and len(axes.collections) == 1
    pyplot.close(figure)


def test_charts_on_axes_have_what_pictures_have():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("svg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(2, 3)
    spectra = {name: stipple.analyze("periodogram", stipple.generate(name, 64)) for name in ("halton", "random")}
    assert stipple.plot(spectra, ax=axes[0, :2]) is not None and stipple.plot(spectra["random"], axes[1, 2]) is axes[1, 2]
    for ax, key in zip(axes[0], ("power", "anisotropy_db")):
        curves = {line.get_label(): line for line in ax.lines}
        for name, spectrum in spectra.items():
            assert np.array_equal(curves[name].get_xdata(), spectrum.radial.frequency)
            assert np.array_equal(curves[name].get_ydata(), spectrum.radial[key])
        assert {"halton", "random"} <= {text.get_text() for text in ax.get_legend().get_texts()}
    assert axes[0, 0].get_ylabel() == "radial power" and axes[0, 1].get_xlabel() == "frequency"
    study = stipple.study(["random", "sobol:scramble=owen"], "star-discrepancy", n=[16, 64, 256], seeds=5)
    stipple.plot(study, ax=axes[1, 0], key="value", title="a study")
    means = [mean for mean in study.means() if mean.key == "value" and mean.generator == "random"]
    [curve] = [line for line in axes[1, 0].lines if line.get_label().startswith("random")]
    assert list(curve.get_xdata()) == [16, 64, 256] and np.allclose(curve.get_ydata(), [mean.mean for mean in means])
    assert axes[1, 0].get_xscale() == axes[1, 0].get_yscale() == "log" and axes[1, 0].get_title() == "a study"
    same = {str(seed): stipple.analyze("star-discrepancy", stipple.generate("random", 64, seed=seed)) for seed in range(8)}
    stipple.plot(same, ax=axes[1, 1])
    assert len(axes[1, 1].patches) == 1 and axes[1, 1].get_ylabel() == "sets"
    underscored = {"_a": spectra["halton"], "b_": spectra["random"]}
    for x in (underscored, {name: stipple.generate("halton", 8) for name in underscored}):
        ax = stipple.plot(x, pyplot.figure().add_subplot())
        assert {" _a", "b_"} <= {text.get_text() for text in ax.get_legend().get_texts()}
        pyplot.close(ax.figure)
    with pytest.raises(stipple.Error, match="ax has 3 axes; the picture has 2 panels"):
        stipple.plot(spectra, ax=axes[0])
    with pytest.raises(stipple.Error, match="show 2 coordinates"):
        stipple.plot(stipple.generate("random", 8, 3), ax=axes[0, 0])
    pyplot.close(figure)


def test_studies_have_pictures_as_the_program_draws_them(run, tmp_path):
    study = stipple.study(["random", "sobol:scramble=owen"], "star-discrepancy", n=[16, 64, 256], seeds=5)
    table = tmp_path / "study.csv"
    run("study", "--generators", "random,sobol:scramble=owen", "--analyze", "star-discrepancy", "-n", "16,64,256", "--seeds", "5",
        "-o", str(table))
    run("plot", str(table), "-o", str(tmp_path / "there.svg"))
    there = (tmp_path / "there.svg").read_text()
    for picture in (stipple.plot(study), stipple.plot([row for row in study if row.key == "value"])):
        assert re.findall("<path[^>]* d=.*?>", picture.svg) == re.findall("<path[^>]* d=.*?>", there)
    with pytest.raises(stipple.Error, match="key"):
        stipple.plot(study, key="nothing")
    with pytest.warns(stipple.Note, match="key selects one"):
        stipple.plot(stipple.study("random", "nearest-neighbor", n=[16, 64]))


# A name that a result has draws this result; a part of a name draws all that have it.
def test_a_key_draws_what_it_names():
    study = stipple.study("random", ["star-discrepancy", "l2-discrepancy"], n=[16, 64])
    one = stipple.plot(study, key="value").svg
    assert one == stipple.plot([row for row in study if row.key == "value"]).svg
    assert "discrepancy<" in one and "centered" not in one
    both = stipple.plot(study, key="centered").svg
    assert ">centered<" in both and ">centered squared<" in both


def test_sets_beyond_the_memory_are_refused_at_once():
    for arguments, options in (((4,), {"sets": 10**9}), ((10**6, 10), {"sets": 100, "max_memory": 2 * 10**8})):
        with pytest.raises(stipple.Error, match="the array of all sets needs .* memory.* limit is .*raise the limit with max_memory") as caught:
            stipple.generate("random", *arguments, **options)
        assert caught.value.kind == "limit"
    with pytest.raises(stipple.Error, match="the point set needs .* of memory") as caught:
        stipple.generate("random", 2**50, 10)
    assert caught.value.kind == "limit"


LOGS = {"parameters": [{"name": "a", "range": [1, 1000], "scale": "log"},
                       {"name": "b", "distribution": "log-uniform", "low": 1, "high": 1000}, {"name": "c", "range": [1, 1000]}]}


def test_parameters_on_a_log_scale_have_log_axes(run, tmp_path):
    x = stipple.generate("sobol", 64, parameters=LOGS, return_meta=True)
    (tmp_path / "p.json").write_text(json.dumps({"parameters": LOGS["parameters"][:2]}))
    run("generate", "sobol", "-n", "64", "--parameters", str(tmp_path / "p.json"), "-o", str(tmp_path / "x.json"))
    run("plot", str(tmp_path / "x.json"), "-o", str(tmp_path / "there.svg"))

    def decades(svg):
        return sorted(text for text in re.findall(r">(\d+)</text>", svg) if set(text) <= {"0", "1"})

    assert decades(stipple.plot(x[:, :2]).svg) == decades((tmp_path / "there.svg").read_text()) == sorted(["1", "10", "100", "1000"] * 2)
    assert decades(stipple.plot(x[:, [2, 1]]).svg).count("10") == 1 and decades(stipple.plot(np.asarray(x[:, :2])).svg).count("10") == 0
    pyplot = pytest.importorskip("matplotlib.pyplot")
    for columns, scales in (([0, 1], ("log", "log")), ([2, 0], ("linear", "log"))):
        figure, axes = pyplot.subplots()
        stipple.plot(x[:, columns], axes)
        assert (axes.get_xscale(), axes.get_yscale()) == scales
        pyplot.close(figure)


def test_units_are_listed_and_described():
    assert "halton" in stipple.list("generators") and "disk" in stipple.list()["warps"]
    text = stipple.describe("sobol")
    assert "scramble" in text and "Source" in text
    with pytest.raises(stipple.Error):
        stipple.list("no such kind")


def test_progress_is_shown(capsys):
    shares = []
    stipple.analyze("star-discrepancy", stipple.generate("random", 3000, 4),
                    progress=shares.append)
    assert shares[-1] == 1 and shares == sorted(shares)

    def fail(share):
        raise RuntimeError("no more")

    with pytest.raises(RuntimeError, match="no more"):
        stipple.analyze("star-discrepancy", stipple.generate("random", 400, 7), progress=fail)


def test_whoever_shows_progress_may_call():
    x = stipple.generate("random", 3000, 4)
    inner = []
    outer = stipple.analyze("star-discrepancy", x, progress=lambda share: inner.append(
        stipple.analyze("star-discrepancy", x[:100, :2]).value))
    assert outer.value == stipple.analyze("star-discrepancy", x).value
    assert set(inner) == {stipple.analyze("star-discrepancy", x[:100, :2]).value}


FORKED = """
import os, sys, stipple
here = stipple.generate("random", 5, 2, threads=1)
child = os.fork()
if child == 0:
    sys.exit(0 if (stipple.generate("random", 5, 2, threads=1) == here).all() else 1)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


def test_forked_processes_have_a_worker_of_their_own():
    assert subprocess.run([sys.executable, "-c", FORKED], timeout=120).returncode == 0


def test_interrupts_stop_long_work():
    x = stipple.generate("random", 2000, 12)  # takes hours
    sent = []

    def interrupt():
        time.sleep(0.3)
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        stipple.analyze("star-discrepancy", x)
    assert time.monotonic() - sent[0] < 2  # a tenth of that where nothing else runs
    assert stipple.analyze("star-discrepancy", [[0.5]]).value == 0.5


def test_other_threads_run_meanwhile():
    counted = []
    over = threading.Event()

    def count():
        while not over.is_set():
            counted.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    stipple.analyze("star-discrepancy", stipple.generate("random", 300, 5), threads=1)
    ended = time.monotonic()
    over.set()
    thread.join()
    assert len([t for t in counted if began < t < ended]) > 3 or ended - began < 0.01


WRONG = [
    lambda: stipple.generate("halton", -1), lambda: stipple.generate("nothing", 5), lambda: stipple.generate("halton", 1e300),
    lambda: stipple.generate("optimized", 5, 2, objective="nothing"), lambda: stipple.generate("subset", 5, 2, by=[1]),
    lambda: stipple.generate("halton", 5, 2, warps=["disk:radius=-1"]), lambda: stipple.generate("halton", 5, 0),
    lambda: stipple.analyze("moments", [[float("nan"), 1]]), lambda: stipple.analyze("moments", [[]]),
    lambda: stipple.analyze("moments", "nowhere.csv"), lambda: stipple.analyze("sensitivity", [[1, 2]]),
    lambda: stipple.analyze("star-discrepancy", np.zeros((2, 2, 2))), lambda: stipple.analyze("moments", object()),
    lambda: stipple.analyze("moments", [[0.5, "x"]]), lambda: stipple.analyze("kernel-discrepancy", [[0.5]], bandwidth=1),
]  # fmt: skip


def test_wrong_calls_from_eight_threads_are_refused_in_each():
    here = stipple.generate("random", 50, 2, seed=3, threads=1)
    wrong = []

    def call(first):
        for i in range(3 * len(WRONG)):
            try:
                WRONG[(first + i) % len(WRONG)]()
                wrong.append(f"{(first + i) % len(WRONG)} was taken")
            except (stipple.Error, ValueError, TypeError, OSError, OverflowError, MemoryError):
                pass
            except BaseException as error:
                wrong.append(repr(error))
            if (stipple.generate("random", 50, 2, seed=3, threads=1) != here).any():
                wrong.append("other points")

    threads = [threading.Thread(target=call, args=(2 * k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_arrays_of_numpy_are_counts_and_contents_of_parameters():
    counts, dimensions = np.array([16, 32]), np.array([2, 3])
    assert stipple.study("random", "moments", n=counts, d=dimensions) == stipple.study(
        "random", "moments", n=[16, 32], d=[2, 3])
    with pytest.raises(stipple.Error, match=r"n\[0\] is 16.0"):
        stipple.study("random", "moments", n=np.array([16, 0.5]))
    entry = {"name": "a", "range": [2, 3]}
    given = {"parameters": [entry | {"range": np.array([2, 3])}, {"name": "k", "integers": [np.int64(1), 4]}]}
    plain = {"parameters": [entry, {"name": "k", "integers": [1, 4]}]}
    assert np.array_equal(*(stipple.generate("sobol", 8, parameters=one) for one in (given, plain)))


def test_what_is_measured_is_on_the_domain_that_is_named():
    triangle = stipple.generate("random", n=64, warp="triangle", return_meta=True)
    for analyzer in ("star-discrepancy", "l2-discrepancy", "t-value"):
        with pytest.raises(stipple.Error, match="requires points of the unit cube"):
            stipple.analyze(analyzer, triangle)
        stipple.analyze(analyzer, np.asarray(triangle))
    with pytest.raises(stipple.Error, match="requires points of the unit cube"):
        stipple.analyze("star-discrepancy", np.asarray(triangle), domain="disk")


@pytest.mark.parametrize("name,value", [("bounds", (0, 2)), ("sets", 3), ("as_frame", True), ("return_meta", True)])
def test_integrate_takes_no_arguments_that_would_change_its_domain(name, value):
    with pytest.raises(stipple.Error, match=name):
        stipple.integrate(lambda x: np.ones(len(x)), "random", 16, 2, **{name: value})


def test_studies_beyond_the_memory_are_refused():
    with pytest.raises(stipple.Error, match="memory"):
        stipple.study("random", "star-discrepancy", n=4, seeds=10**9)


# What a call wrote is made again by its command, with each generator and whatever was asked of it.
def test_the_program_reproduces_what_calls_wrote(run, tmp_path):
    calls = [(unit, {"n": n, "d": d}) for unit in stipple.list("generators") for n, d in ((16, 2), (9, 2), (9, 3), (27, 3))]
    calls += [("poisson-disk:radius=0.1", {}), ("latin-hypercube:optimize=maximin", {"n": 9}), ("halton", {"n": 9, "start": 5}),
              ("jittered", {"n": 16, "bounds": [(-1, 1), (0, 2)]}), ("random", {"n": 9, "sets": 3}),
              ("sobol", {"n": 8, "d": 4, "warp": ["disk@2,3", "owen:seed=9", "normal@1"]}),
              ("halton", {"n": 8, "warp": "triangle:vertices=[0,0 1,0 0,1]"}),
              ("random", {"parameters": {"parameters": [{"name": "a", "range": [2, 3]}, {"name": "k", "levels": ["x y", "it's"]}]}})]
    made = 0
    for number, (unit, given) in enumerate(calls):
        try:
            points = stipple.generate(unit, seed=4, return_meta=True, **given)
        except stipple.Error:
            continue  # another dimension or number of points, or a file
        file = str(tmp_path / f"{number}.json")
        stipple.write(file, points)
        assert b"identical" in run("reproduce", file), (unit, given)
        made += 1
    assert made > 90
