# SPDX-License-Identifier: MIT
"""Every argument of every public function, with every kind of wrong value."""

import inspect
import re

import numpy as np
import pytest

import stipple

X = stipple.generate("halton", 16, start=1)
ENDLESS = []
ENDLESS.append(ENDLESS)


class Closed:
    """Like a file."""

    def read(self):
        raise ValueError("I/O operation on closed file")


class Odd:
    """Of no use, even in a message."""

    def __repr__(self):
        raise RuntimeError("no name")


NOTHING = [None]
THINGS = [Odd(), {}, 1 + 2j, b"x", lambda: 0]
WHOLE = [-3, 10.0, "10", True, float("nan"), [1], np.array([1, 2]), np.float64(3), np.bool_(True), 2**70, *THINGS]
REAL = [-1, "1", True, float("nan"), float("inf"), [1.0], *THINGS]
TEXT = [3, "\ud800", "a\0b", ["a"], *THINGS]
FLAG = [1, 0, "yes", [True], np.array([True, False]), *THINGS]
PATH = [3, "", "a\0b", ["a"], Closed(), Odd(), {}, 1 + 2j]
UNIT = [3, "", "nothing", "faure:", ":", "[", "faure:[", "disk@", "disk@0", "a\0b", "\ud800", ("halton",),
        ("halton", 3), (3, {}), ("faure", {"base": Odd()}), ["halton", 3], *THINGS]
POINTS = [3, None, "points.csv", b"x", [], [[]], [1.0, 2.0], [[1, 2], [3]], [[0.5, float("nan")]], [[0.5, "x"]],
          [[None, 1]], np.zeros((2, 2, 2, 2)), np.zeros((0, 2)), np.zeros((2, 2), complex), np.zeros((2, 2), object),
          np.zeros((2, 2), bool), np.zeros(3, "f8,f8"), np.array([["2020-01-01"] * 2], "M8[D]"), [[1, [2]]],
          np.ma.array([[0.5, 0.5]], mask=[[True, False]]), Closed(), Odd(), {1: 2}, lambda: 0, [[10**400, 1]]]
SET = [*POINTS, np.zeros((2, 2, 2))]
BOUNDS = [3, "x", "1..0", (1, 0), (0, 1, 2), [(0, 1)] * 7, [(0, "x")], [(0, None)], (0, float("nan")),
          (0, float("inf")), (True, False), [[]], "\ud800", Odd(), {}, b"x"]
PARAMETERS = [3, "", "no/such/file.json", {}, {"parameters": 3}, {"parameters": []}, {"parameters": [{}]},
              {"parameters": [Odd()]}, {"parameters": [{"name": "a", "range": [0, float("nan")]}]}, {3: Odd()}, Odd(), []]
RUN = {"threads": WHOLE + NOTHING, "max_memory": REAL[:-1] + NOTHING, "progress": [3, "yes", [], Odd(), {}]}
FUNCTION = [3, "nothing", [], lambda x: x, lambda x: None, lambda x: "text", lambda x: x[:3, 0],
            lambda x: x[:, 0] * 1j, lambda x: np.nan * x[:, 0], lambda x: [Odd()] * len(x), lambda x: [[1], [2, 3]]]
OPTION = [Odd(), {}, b"x", [[[3]]], ENDLESS, 10**5000, lambda: 0, {3}, "\ud800", "a\0b", [], float("nan"), -3, 1 + 2j]

SPECS = [value for value in UNIT if not isinstance(value, tuple) or len(value) > 1] + [None, []]
SEED = WHOLE + NOTHING
GENERATE = {"generator": UNIT + NOTHING, "n": WHOLE, "d": WHOLE + [0, 10**5], "seed": SEED, "start": SEED, "sets": SEED + [0],
            "bounds": BOUNDS, "warp": UNIT, "parameters": PARAMETERS, "return_meta": FLAG + NOTHING,
            "as_frame": ["csv", 3, None, Odd(), []], "options": OPTION, **RUN}
WARP = {"x": POINTS + [X - 1], "warp": UNIT + NOTHING + ["owens"], "options": OPTION, **RUN}
NAMED = POINTS + [{}, {3: X}, {"a": 3}, {"a": X, "b": X[:, :1]}]
CALLS = {  # function: arguments of a right call, the option that OPTION is for, and wrong arguments
    "generate": ({"generator": "faure", "n": 4}, "base", GENERATE),
    "sequence": ({"generator": "faure"}, "base", {**GENERATE, "generator": UNIT + NOTHING + ["poisson-disk"]}),
    "warp": ({"x": X, "warp": "disk"}, "radius", WARP),
    "inverse": ({"x": X - 0.5, "warp": "disk"}, "radius", {**WARP, "x": POINTS + [X + 9]}),
    "pdf": ({"x": X - 0.5, "warp": "disk"}, "radius", {**WARP, "x": POINTS}),
    "scramble": ({"x": X, "scramble": "owen"}, "base",
                 {"x": POINTS + [X - 1], "scramble": UNIT + NOTHING, "seed": SEED, "start": SEED, "options": OPTION, **RUN}),
    "analyze": ({"analyzer": "integration", "x": X, "integrand": "owen"}, "exact",
                {"analyzer": UNIT + NOTHING, "x": SET + [X - 1], "domain": [3, "", "nowhere", "box:", *TEXT, "disk:radius=-1"],
                 "integrand": FUNCTION + TEXT[:-1], "parameters": PARAMETERS, "options": OPTION, **RUN}),
    "integrate": ({"function": lambda x: x[:, 0], "generator": "random", "n": 4, "d": 2}, "nothing",
                  {**{key: GENERATE[key] for key in ("generator", "seed", "start", "options")}, "n": WHOLE, "d": WHOLE, "function": FUNCTION,
                   "replications": WHOLE + [None, 0, 1], "confidence": REAL + [0, 1, None], "warp": UNIT, "mean": FLAG, **RUN}),
    "read": ({"path": "no/such/file.csv"}, None,
             {"path": PATH + NOTHING + ["no/such/file.csv", b"\xff.csv", "."], "format": TEXT + ["nothing", None], "d": WHOLE + NOTHING,
              "single": FLAG + NOTHING, **RUN}),
    "write": ({"path": "a.csv", "x": X}, None,
              {"path": PATH + NOTHING + ["no/such/file.csv", "."], "x": POINTS, "domain": TEXT + ["nowhere"],
               "format": TEXT + ["nothing", None], "header": FLAG + NOTHING, "meta": FLAG + NOTHING, "single": FLAG + NOTHING,
               "precision": WHOLE, **RUN}),
    "study": ({"generators": "random", "analyzers": "moments", "n": 16}, None,
              {"generators": SPECS, "analyzers": SPECS, "n": [v for v in WHOLE if v is not None and
               not isinstance(v, (list, np.ndarray))] + [None, [], [1, 2.0], "1", [[1]], 0],
               "d": [0, -1, "2", 2.0, [2, True], [], Odd()], "seeds": SEED + [0], "seed": SEED, "warp": UNIT, "parameters": PARAMETERS,
               "keys": [3, [3], None, "nothing", Odd(), b"x"], **RUN}),
    "report": ({"path": "a.html", "x": X}, None, {"path": PATH + NOTHING + ["no/such/a.html"], "x": NAMED, **RUN}),
    "plot": ({"x": X}, None, {"x": NAMED, "ax": [3, "axes", [], [3], Odd()], "key": TEXT + NOTHING, "width": REAL + [1e300, None],
                              "height": REAL + [1e300, None], "title": TEXT, "labels": [3, [], ["a", "b"], [3], Odd()], **RUN}),
    "describe": ({"name": "halton"}, None, {"name": TEXT + NOTHING + ["nothing"]}),
    "list": ({"kind": "warps"}, None, {"kind": TEXT + ["nothing"]}),
}


def words_of(value):
    try:
        return repr(value)[:80]
    except Exception:
        return "Odd"


FOREIGN = "incompatible|Invoked|std::|pybind|basic_string|Unable to|Traceback|_stipple|--[a-z]"


def problem(call, where, named=""):
    """What is wrong with how a wrong call is refused; empty if it gets a sentence."""
    try:
        return f"{where} was taken: {words_of(call())}"
    except stipple.Error as error:
        sentence = str(error)
        wrong = re.search(FOREIGN, sentence) or "\n" in sentence or len(sentence) < 10 or named not in sentence
        return f"{where}: {sentence}" if wrong or error.kind not in ("usage", "input", "io", "limit") else ""
    except Exception as error:
        return f"{where}: {type(error).__name__}: {error}"


def all_refused(calls):
    problems = [found for found in (problem(*call) for call in calls) if found]
    assert not problems, "\n".join([f"{len(problems)} problems", *problems])


def test_every_function_and_argument_is_tried():
    public = {name for name in stipple.__all__ if inspect.isfunction(getattr(stipple, name))}
    assert public == set(CALLS)
    for name, (_, option, wrong) in CALLS.items():
        there = set(inspect.signature(getattr(stipple, name)).parameters) - {"unknown"}
        assert there <= set(wrong), name


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.filterwarnings("ignore::stipple.Note")
def test_wrong_arguments_get_a_sentence(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call = getattr(stipple, name)
    right, option, wrong = CALLS[name]
    calls = []
    for argument, values in wrong.items():
        key = option if argument == "options" else argument
        for value in values if argument in inspect.signature(call).parameters else []:
            plain = isinstance(value, (type(None), bool, float, complex, Odd)) and argument not in ("x", "function", "integrand")
            calls.append((lambda key=key, value=value: call(**{**right, key: value}), f"{name}({key}={words_of(value)})",
                          key if plain else ""))
    all_refused(calls)


def test_wrong_arguments_of_methods_get_a_sentence(tmp_path):
    sequence = stipple.sequence("halton", 2)
    picture = stipple.plot(X)
    study = stipple.study("random", "moments", n=16, seeds=2)
    all_refused([
        *((lambda at=at: sequence[at], f"sequence[{words_of(at)}]") for at in
          ("a", 1.0, None, True, [1], Odd(), slice(0, 1.0), slice(0, "a"), slice(0, 4, True), (0, 1), 2**70)),
        *((lambda size=size: sequence.blocks(size), f"blocks({size})") for size in (0, -1, 1.0, "a", None, True)),
        (lambda: sequence.blocks(3, -1), "blocks(3, -1)"),
        *((lambda path=path: picture.save(path), f"save({words_of(path)})") for path in [*PATH, None, tmp_path / "a.gif"]),
        *((lambda level=level: study.means(level), f"means({words_of(level)})") for level in [*REAL, 0, 1, None]),
        *((lambda part=part, wrong=wrong: stipple.plot([study[0]._replace(**{part: wrong})]), f"{part}={words_of(wrong)}")
          for part in stipple.StudyValue._fields for wrong in (Odd(), b"x", -1.5, [3]) if (part, wrong) != ("value", -1.5)),
        *((lambda rows=rows: stipple.Study(rows).means(), f"Study({rows})") for rows in ([3], ["a"], [("a",) * 8])),
    ])


def test_wrong_metas_get_a_sentence():
    x = stipple.generate("halton", 8, return_meta=True)

    def measured(meta):
        x.meta = meta
        return stipple.analyze("moments", x)

    all_refused([(lambda meta=meta: measured(meta), f"meta {list(meta)}") for meta in
                 ({"domain": 3}, {"domain": Odd()}, {"domain": "nowhere"}, {"odd": Odd()})])


def test_sentences_name_argument_value_and_expectation():
    for call, sentence in [
        (lambda: stipple.generate("halton", -3), "n is -3; expected a whole number from 0 to 2^53"),
        (lambda: stipple.generate("halton", 10.0),
         "n is 10.0; expected a whole number from 0 to 2^53 (write 10, or int(...) around the computation)"),
        (lambda: stipple.generate("halton", True), "n is True; expected a whole number from 0 to 2^53"),
        (lambda: stipple.generate("halton", seed=None), "seed is None; expected a whole number from 0 to 2^64 - 1 "
         "(equal seeds give equal points; for others each time, pass secrets.randbits(63))"),
        (lambda: stipple.generate(None), 'generator is None; expected the name of a unit, such as "sobol:order=gray", '
         'or ("sobol", {"order": "gray"})'),
        (lambda: stipple.generate("faure", base={}),
         "base is {}; expected a number, a text, True or False, or a list of these"),
        (lambda: stipple.analyze("moments", "points.csv"),
         "x is 'points.csv'; expected points (n, d) (read() returns the points of a file)"),
        (lambda: stipple.write("a.csv", X, header=1), "header is 1; expected True or False"),
        (lambda: stipple.analyze("moments", None), "x is None; expected points (n, d)"),
        (lambda: stipple.warp({1: 2}, "disk"), "x is {1: 2}; expected points (n, d) or (sets, n, d)"),
        (lambda: stipple.generate("halton", bounds=(1, 0)), "bounds is (1, 0); expected low < high, both finite"),
        (lambda: stipple.warp(X, "cone", half_angl=3), "unknown option 'half_angl' (did you mean 'half_angle'?)"),
        (lambda: stipple.analyze("integration", X, integrand=lambda x: 3),
         "the integrand gives the shape () for 16 points; expected (16,)"),
    ]:
        with pytest.raises(stipple.Error) as caught:
            call()
        assert str(caught.value) == sentence


def test_lists_of_names_are_not_split_at_commas_of_names():
    settings = stipple._arguments.settings_of({"inputs": ["a, b", 1], "response": ['y "1"']})
    assert settings == [("inputs", '"a, b","1"'), ("response", '"y ""1"""')]


def test_numbers_of_numpy_are_numbers():
    same = stipple.generate("halton", 8, 2, seed=3)
    for n in (np.int8(8), np.uint64(8), np.array(8)):
        assert np.array_equal(stipple.generate("halton", n, np.int32(2), seed=np.int64(3)), same)
    assert stipple.generate("random", 4, seed=2**64 - 1).shape == (4, 2)
    with pytest.raises(stipple.Error) as caught:
        stipple.generate("random", 2**50, 10)
    assert caught.value.kind == "limit"
