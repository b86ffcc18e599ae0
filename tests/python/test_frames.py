# SPDX-License-Identifier: MIT
"""Tables of pandas and polars as points, and points as tables."""

import json
import re
import sys
import types

import numpy as np
import pytest

import stipple

PARAMETERS = {"parameters": [{"name": "a", "range": [2, 3]}, {"name": "m", "levels": ["y", "x"]},
                             {"name": "k", "integers": [1, 4]}]}


class Series:
    """As of polars: strings are an array of objects, and an Enum has categories."""

    def __init__(self, name, values, dtype=None):
        self.name, self.values, self.dtype = name, list(values), dtype

    def to_numpy(self):
        words = any(isinstance(value, str) for value in self.values)
        return np.array(self.values, dtype=object if words else None)


class DataFrame:
    def __init__(self, columns):
        self.series = {series.name: series for series in columns}

    columns = property(lambda self: list(self.series))

    def to_numpy(self):
        return np.column_stack([series.to_numpy() for series in self.series.values()])

    def __getitem__(self, name):
        return self.series[name]


def stand_in():
    module = types.ModuleType("polars")
    module.Series, module.DataFrame = Series, DataFrame
    module.Enum = lambda words: types.SimpleNamespace(categories=words)
    return module


@pytest.fixture(params=["pandas", "stand-in", "polars"])
def library(request, monkeypatch):
    """The name for as_frame, and what makes a table of a dictionary of lists."""
    if request.param == "pandas":
        import pandas

        return "pandas", pandas.DataFrame
    if request.param == "stand-in":
        monkeypatch.setitem(sys.modules, "polars", stand_in())
        return "polars", lambda columns: DataFrame([Series(*column) for column in columns.items()])
    return "polars", pytest.importorskip("polars").DataFrame


def test_points_become_tables_and_back(library, tmp_path):
    kind, _ = library
    points = stipple.generate("sobol", 64, parameters=PARAMETERS, return_meta=True)
    table = stipple.generate("sobol", 64, parameters=PARAMETERS, as_frame=kind)
    assert list(table.columns) == ["a", "m", "k"]
    assert list(table["m"].to_numpy()) == [["y", "x"][int(place)] for place in points[:, 1]]
    assert np.array_equal(table["a"].to_numpy(), points[:, 0])
    stipple.write(tmp_path / "points.csv", points)
    stipple.write(tmp_path / "table.csv", table)
    lines = [(tmp_path / name).read_text() for name in ("points.csv", "table.csv")]
    assert lines[0] == lines[1] and lines[0].startswith("a,m,k\n2,y,1\n")
    stipple.write(tmp_path / "table.json", table)
    meta = json.loads((tmp_path / "table.json").read_text())["meta"]
    assert meta["columns"] == ["a", "m", "k"] and meta["levels"] == {"m": ["y", "x"]}
    domain = points.meta["domain"]
    for analyzer in ("moments", "chi-square"):
        assert stipple.analyze(analyzer, table, domain=domain) == stipple.analyze(analyzer, points)
    assert ">m<" in stipple.plot(table).svg
    words = repr(stipple.analyze("moments", table, domain=domain)).splitlines()[0]
    assert "a, m, k" in words


def test_tables_are_points_for_all_calls(library, tmp_path):
    kind, frame = library
    x = stipple.generate("halton", 32, start=1)
    table = frame({"u": x[:, 0], "v": x[:, 1]})
    disk = stipple.warp(table, "disk")
    assert np.array_equal(disk, stipple.warp(x, "disk")) and disk.meta["domain"] == "disk"
    assert np.array_equal(stipple.scramble(table, "owen"), stipple.scramble(x, "owen"))
    there = frame({"u": disk[:, 0], "v": disk[:, 1]})
    assert np.allclose(stipple.inverse(there, "disk"), x) and np.allclose(stipple.pdf(there, "disk"), 1 / np.pi)
    assert stipple.analyze("star-discrepancy", table) == stipple.analyze("star-discrepancy", x)
    stipple.write(tmp_path / "two.csv", [table, table])
    assert [set.meta["columns"] for set in stipple.read(tmp_path / "two.csv")] == [["u", "v"]] * 2
    assert "lt;html" in stipple.report(tmp_path / "a.html", {"a": table, "b": x})._repr_html_()
    assert ">u<" in stipple.plot(table).svg
    assert np.array_equal(stipple.warp(stipple.generate("halton", 32, start=1, as_frame=kind), "disk"), disk)
    frames = stipple.generate("random", 4, 5, sets=2, as_frame=kind)
    assert [list(one.columns) for one in frames] == [["x1", "x2", "x3", "x4", "x5"]] * 2


def test_words_without_categories_are_sorted_as_in_files(library, tmp_path):
    _, frame = library
    table = frame({"m": ["b", "c", "b", "a"], "n": [1, 2, 3, 4]})
    stipple.write(tmp_path / "a.csv", table)
    assert (tmp_path / "a.csv").read_text() == "m,n\nb,1\nc,2\nb,3\na,4\n"
    stipple.write(tmp_path / "a.json", table)
    with pytest.warns(stipple.Note, match="0 a, 1 b, 2 c"):
        read = stipple.read(tmp_path / "a.csv")
    assert np.array_equal(read, stipple.read(tmp_path / "a.json")) and read.meta["levels"] == {"m": ["a", "b", "c"]}


@pytest.mark.parametrize("columns,message", [
    ({"a": [0.5, float("nan")]}, r"x\[1, 0\] is nan"),
    ({"a": ["x", None]}, r"x\['a'\]\[1\] is None; expected a word"),
    ({"a": [True, False]}, r"x\['a'\] has elements of type bool; expected numbers or words"),
    ({}, "there are no points"),
    ({"a": []}, "no points|no array"),
])
def test_tables_of_other_things_are_refused(library, columns, message):
    _, frame = library
    with pytest.raises(stipple.Error, match=message) as caught:
        stipple.analyze("moments", frame(columns))
    assert caught.value.kind == "input"


def test_pandas_has_further_kinds_of_columns():
    import pandas

    x = stipple.generate("sobol", 16)
    numbers = pandas.DataFrame({"a": x[:, 0], "b": pandas.array(x[:, 1], "Float64")})
    assert stipple.analyze("moments", numbers) == stipple.analyze("moments", x)
    numbers.loc[3, "b"] = pandas.NA
    with pytest.raises(stipple.Error, match=r"x\['b'\]\[3\] is <NA>; expected a number"):
        stipple.analyze("moments", numbers)
    with pytest.raises(stipple.Error, match="x has two columns 'a'"):
        stipple.analyze("moments", pandas.DataFrame(x, columns=["a", "a"]))
    assert stipple.analyze("moments", pandas.DataFrame(x)) == stipple.analyze("moments", x)
    with pytest.raises(stipple.Error, match="shape"):
        stipple.analyze("moments", pandas.Series([1.0, 2.0]))
    times = pandas.DataFrame({"t": pandas.to_datetime(["2020-01-01", "2020-01-02"])})
    with pytest.raises(stipple.Error, match="expected numbers or words"):
        stipple.analyze("moments", times)


# pandas keeps attrs in selections of rows; other columns are another domain.
def test_tables_of_pandas_know_their_domain():
    table = stipple.generate("sobol", 64, warp="disk", as_frame=True)
    assert stipple.analyze("chi-square", table[:32])._record[3] == "disk"
    with pytest.raises(stipple.Error, match="outside the domain unit-cube"):
        stipple.analyze("moments", table[["y", "x"]])
    some = stipple.generate("sobol", 64, parameters=PARAMETERS, as_frame=True)[["k", "a"]]
    free = {"parameters": [PARAMETERS["parameters"][2], PARAMETERS["parameters"][0]]}
    domain = f"parameters:json=[{json.dumps(free)}]"
    assert stipple.analyze("chi-square", some) == stipple.analyze("chi-square", some.to_numpy(), domain=domain)
    assert stipple.warp(stipple.generate("random", 8), "sphere").to_pandas().columns.tolist() == ["x", "y", "z"]
    plain = stipple.Points((4, 2))
    plain[:] = 0.5
    assert plain.to_pandas().shape == (4, 2)
    with pytest.raises(stipple.Error, match="a table is of one set"):
        stipple.generate("random", 4, sets=2, return_meta=True).to_pandas()


# Columns with the names of the parameters are inputs, all others are outputs, as for the program.
@pytest.mark.parametrize("order", ["amkuw", "wkuam"])
def test_outputs_are_added_to_tables_of_parameters(order, run, tmp_path):
    table = stipple.generate("sobol:scramble=owen", 128, parameters=PARAMETERS, as_frame=True)
    table["u"] = np.exp(3 * table["a"]) * table["k"] + table["m"].cat.codes
    table["w"] = table["a"].where(table["a"] > 2.1)
    table = table[[*order]].rename(columns={"w": "weight"})
    (tmp_path / "p.json").write_text(json.dumps(PARAMETERS))
    table.to_csv(tmp_path / "t.csv", index=False)
    out = run("analyze", "sensitivity", tmp_path / "t.csv", "--parameters", tmp_path / "p.json", "--json")
    right = json.loads(out)["results"]
    bare = table.assign(m=table["m"].astype(object))
    bare.attrs = {}
    file = str(tmp_path / "p.json")
    for one, told in ((table, {}), (bare, {"parameters": file}), (bare, {"parameters": PARAMETERS}),
                      (bare, {"domain": f"parameters:file={file}"})):
        with pytest.warns(stipple.Note, match="weight: .* runs failed"):
            found = stipple.analyze("sensitivity", one, **told)
        assert {*found} == {"u", "weight"}
        assert json.loads(json.dumps(found, default=dict)) == right
    assert stipple.plot(found).svg
    with pytest.raises(stipple.Error, match="parameters and domain: give one of them"):
        stipple.analyze("moments", bare, domain="disk", parameters=PARAMETERS)
    with pytest.raises(stipple.Error, match="the table has no column k for the inputs"):
        stipple.analyze("sensitivity", bare.drop(columns="k"), parameters=PARAMETERS)


def test_outputs_are_added_to_tables_without_parameters():
    for domain in ({}, {"bounds": (1, 3)}, {"warp": "disk"}):
        table = stipple.generate("sobol:scramble=owen", 64, 2, as_frame=True, **domain)
        table.insert(0, "u", table["x"] ** 2)
        table["v"] = table["y"]
        found = stipple.analyze("sensitivity:method=rank", table)
        assert {*found} == {"u", "v"} and "u" not in found.v and found.v.y.first > found.v.x.first


def test_missing_libraries_are_named(monkeypatch):
    for name in ("pandas", "polars"):
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(stipple.Error, match=f"the package {name}, which is not installed"):
            stipple.generate("random", 4, as_frame=name)


TYRES = {"parameters": [{"name": "tyre", "levels": ["dry", "wet", "snow"], "probabilities": [6, 3, 1]},
                        {"name": "speed", "range": [20, 90]}]}


# The numbers of words are those of the parameter, as for the program, whatever the table's own order.
def test_words_and_columns_are_matched_to_parameters_by_name(run, tmp_path):
    import pandas

    (tmp_path / "p.json").write_text(json.dumps(TYRES))
    domain = f"parameters:file={tmp_path / 'p.json'}"
    points = stipple.generate("random", 1000, parameters=TYRES, return_meta=True)
    table = points.to_pandas()
    table.to_csv(tmp_path / "q.csv", index=False)
    file = pandas.read_csv(tmp_path / "q.csv", float_precision="round_trip")
    out = run("analyze", "chi-square", tmp_path / "q.csv", "--parameters", tmp_path / "p.json", "--cells=30")
    right = stipple.analyze("chi-square:cells=30", points)
    assert right.statistic == float(re.search(rb'"statistic": ([\d.]+)', out)[1])
    with pytest.warns(stipple.Note, match="0 dry, 1 snow, 2 wet"):
        read = stipple.read(tmp_path / "q.csv")
    words = table["tyre"].cat
    told = [file, file[["speed", "tyre"]], file.assign(cost=1.0), read]
    known = [table, table.astype({"tyre": object}), table[["speed", "tyre"]],
             table.assign(tyre=words.reorder_categories(["snow", "dry", "wet"])),
             table.assign(tyre=words.set_categories(["ice", "wet", "snow", "dry"]))]
    for one in told + known:
        on = domain if any(one is each for each in told) else None
        assert stipple.analyze("chi-square:cells=30", one, domain=on).statistic == right.statistic
    for one in known + [file]:
        assert np.array_equal(stipple.inverse(one, domain), stipple.inverse(points, domain))
        stipple.write(tmp_path / "back.csv", one, domain=domain)
        assert (tmp_path / "back.csv").read_text() == (tmp_path / "q.csv").read_text()
    for one in known:
        assert stipple.plot(one).svg == stipple.plot(table).svg
    rainy = table[table["tyre"] != "dry"].astype({"tyre": object})
    assert {*stipple.inverse(rainy, domain)[:, 0]} == {*stipple.inverse(points[points[:, 0] > 0], domain)[:, 0]}


@pytest.mark.parametrize("change,message", [
    ({"tyre": ["wet", "ice"]}, r"x\['tyre'\]\[1\] is 'ice'; expected one of dry, wet, snow"),
    ({"speed": ["fast", "slow"]}, r"x\['speed'\]\[0\] is 'fast'; expected a number"),
    ({"tyre": None, "tire": ["wet", "dry"]}, "x has no column 'tyre', as the domain has; its columns are speed, tire"),
])
def test_tables_that_are_not_of_the_parameters_are_refused(library, change, message):
    _, frame = library
    columns = {"tyre": ["wet", "dry"], "speed": [30.0, 40.0]} | change
    table = frame({key: values for key, values in columns.items() if values})
    with pytest.raises(stipple.Error, match=message) as caught:
        stipple.analyze("moments", table, domain=f"parameters:json=[{json.dumps(TYRES)}]")
    assert caught.value.kind == "input"


@pytest.mark.parametrize("names,name", [(['a"b', "it's"], 'a"b'), (["1", "2"], "1"), ([1, 2], "1"), (["a", 7], "7"),
                                        (["set", "b"], "set")])
def test_names_that_files_cannot_hold_are_refused(names, name, tmp_path):
    import pandas

    table = pandas.DataFrame([[0.5, "u"], [0.25, "v"]], columns=names)
    for file in ("a.csv", "a.tsv.gz", "a.json", "a.jsonl"):
        with pytest.raises(stipple.Error, match=f"x has a column named '{re.escape(name)}', which a file cannot hold"):
            stipple.write(tmp_path / file, table)
    assert not list(tmp_path.iterdir())
    words = pandas.DataFrame({"m": pandas.Categorical(["1", "2"]), "n": [1, 2]})
    with pytest.raises(stipple.Error, match=r"x\['m'\] has the word '1', which a file cannot hold"):
        stipple.write(tmp_path / "a.csv", words)
    unnamed = pandas.DataFrame([[0.5, "u"], [0.25, "v"]])
    stipple.write(tmp_path / "a.csv", unnamed)
    assert (tmp_path / "a.csv").read_text() == "x,y\n0.5,u\n0.25,v\n"


def test_names_that_cannot_be_kept_are_replaced_singly(library):
    _, frame = library
    table = frame({"length": [0.1, 0.5, 0.9, 0.3], "nan": [0.2, 0.3, 0.4, 0.5]})
    with pytest.warns(stipple.Note, match="the column 'nan' is called y; a name is"):
        picture = stipple.plot(table).svg
    assert ">length<" in picture and "nan" not in picture
    runs = {"width": list(np.linspace(0, 1, 64)), "set": list(np.linspace(0, 1, 64) ** 2 % 0.3),
            "cost": list(np.linspace(1, 2, 64))}
    with pytest.warns(stipple.Note, match="the column 'set' is called y; a name is"):
        report = stipple.analyze("sensitivity", frame(runs))
    assert {"width", "y"} <= {*report.cost.keys()}


def test_words_become_numbers_with_a_note_only(library, tmp_path):
    _, frame = library
    table = frame({"m": ["u", "v"], "n": [1.0, 2.0]})
    for file in ("a.npy", "a.txt"):
        with pytest.warns(stipple.Note, match="written as numbers: m: 0 u, 1 v"):
            stipple.write(tmp_path / file, table)


def test_sets_shown_together_have_the_same_columns_and_words(tmp_path):
    import pandas

    first = pandas.DataFrame({"m": ["a", "b", "c"], "n": [1.0, 2.0, 3.0]})
    second = pandas.DataFrame({"n": [4.0, 5.0], "m": ["c", "d"]})
    alike = pandas.DataFrame({"m": [2, 3], "n": [4.0, 5.0]})
    plain = pandas.DataFrame({"m": [0, 1, 2], "n": [1.0, 2.0, 3.0]})
    circles = [stipple.plot(x).svg.count("<circle") for x in ({"a": first, "b": second}, {"a": plain, "b": alike})]
    assert circles[0] == circles[1]
    stipple.write(tmp_path / "two.csv", [first, second])
    assert (tmp_path / "two.csv").read_text().endswith("0,c,3\n1,c,4\n1,d,5\n")
    with pytest.raises(stipple.Error, match=r"x\['b'\] has the columns k, m, and x\['a'\] m, n; expected the same"):
        stipple.plot({"a": first, "b": second.rename(columns={"n": "k"})})
