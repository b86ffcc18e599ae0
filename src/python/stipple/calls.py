# SPDX-License-Identifier: MIT
"""The functions of the package."""

from __future__ import annotations

import difflib
import inspect
import json
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple, Never, TypeAlias, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _axes, _stipple
from ._arguments import (
    Bounds,
    Floats,
    Number,
    Option,
    Parameters,
    Path,
    Progress,
    Unit,
    Units,
    Whole,
    bounds_text,
    counted,
    flag,
    is_masked,
    listed,
    path as path_of,
    real,
    refuse,
    run_options,
    seed_of,
    settings_of,
    spec_text,
    text,
    whole,
    whole_or_none,
    wholes,
)
from ._arrays import Given, Points, alike, as_rows, given, given_table, matched, sets_of, with_meta
from ._errors import Error, Note, in_python
from ._frames import Frame, is_frame, is_word
from ._reports import Page, Picture, Report

PointsLike: TypeAlias = ArrayLike | Frame
Axes = TypeVar("Axes")
DIMENSIONS = 10**6
_how = run_options


def _only(call: Callable[..., object], unknown: Mapping[str, object]) -> None:
    """Refuses keyword arguments that a call without options does not have."""
    for name in unknown:
        known = [*inspect.signature(call).parameters][:-1]
        near = difflib.get_close_matches(name, known, n=1)
        hint = f"did you mean '{near[0]}'?" if near else f"known arguments: {', '.join(known)}"
        raise Error(f"{call.__name__}() has no argument '{name}'", hint=hint)


def _of_numpy(value: Any) -> Any:
    """Numbers and arrays of NumPy as JSON has them."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is no number, text or list")


def _parameters_of(parameters: Parameters) -> tuple[str, int]:
    """The warp of a parameter file, given by its path or by its content, and its dimension."""
    if not isinstance(parameters, Mapping):
        return _stipple.parameters(os.fsencode(path_of("parameters", parameters)))
    try:
        content = json.dumps({k: v for k, v in parameters.items() if k != "$schema"},
                             allow_nan=False, default=_of_numpy)
    except Exception as error:
        raise Error(f"parameters: no content of a parameter file: {error}") from None
    entries = parameters.get("parameters")
    dimension = len(entries) if isinstance(entries, (list, tuple)) else 1
    spec = f"parameters:json=[{content}]"
    _stipple.domain_of_columns(spec, dimension, [*range(dimension)])  # refuses wrong content
    return spec, dimension


def generate(
    generator: Unit,
    n: Whole | None = None,
    d: Whole | None = None,
    *,
    seed: Whole = 1,
    start: Whole = 0,
    sets: Whole = 1,
    bounds: Bounds = None,
    warp: Units | None = None,
    parameters: Parameters = None,
    return_meta: bool = False,
    as_frame: bool | str = False,
    threads: Whole = 0,
    max_memory: Number = 0,
    progress: Progress = None,
    **options: Option,
) -> Any:
    """Points of a generator: an array (n, d) of float64, or (sets, n, d) for several sets.

    generator   name or spec: "halton", "sobol:scramble=owen"; list("generators") names all
    n           number of points; by default the generator decides
    d           number of coordinates; by default that of the parameters, or the generator decides
    seed        seed of the first set, from 0 to 2^64 - 1; the others have seed + 1, ...
    start       index of the first point, for sequences
    sets        number of sets, 1 or more
    bounds      (low, high), or one pair for each coordinate: the box that the points fill
    warp        a warp or scramble, or a list of them: "disk:method=concentric"
    parameters  a parameter file, or a dictionary with the same content
    return_meta returns Points: arrays whose .meta is a dictionary with their provenance, from which
                analyze() takes the domain
    as_frame    returns a pandas.DataFrame, or with "polars" a polars.DataFrame: columns have the
                names of the parameters, and words as categories; several sets are a list of tables
    options     of the generator: scramble="owen"

    The numbers are bit for bit those of `stipple generate` with the same arguments. A single set is
    not copied. Sets of different sizes are returned as a list of arrays. Raises Error for unknown
    names and options, and for sizes that the generator cannot make or that need too much memory.
    """
    warps = listed("warp", warp)
    if parameters is not None:
        spec, dimension = _parameters_of(parameters)
        warps.append(spec)
        d = dimension if d is None else d
    if as_frame not in (False, True, "pandas", "polars"):
        refuse("as_frame", as_frame, 'True, "pandas" or "polars"')
    several = whole("sets", sets, 1, 10**9) > 1
    meta_needed = flag("return_meta", return_meta) or as_frame is not False
    asked = _stipple.Asked(
        spec_text("generator", generator), settings_of(options), whole_or_none("n", n),
        whole_or_none("d", d, 0, DIMENSIONS), seed_of(seed), whole("start", start), int(sets),
        bounds_text(bounds), warps,
    )
    points, meta = _stipple.generate(asked, meta_needed, run_options(threads, max_memory, progress))
    if as_frame:
        each = points if several else [points]
        frames = [with_meta(one, known).to_polars() if as_frame == "polars" else
                  with_meta(one, known).to_pandas() for one, known in zip(each, meta)]
        return frames if several else frames[0]
    if not meta_needed:
        return points
    if isinstance(points, list):
        return [with_meta(one, known) for one, known in zip(points, meta)]
    return with_meta(points, meta if several else meta[0])


class Sequence:
    """Points of a sequence by index: s[10] is an array (d,), s[10:20] an array (10, d), and
    s.blocks(1000) yields blocks of 1000 points endlessly. Made by sequence(); can be copied and
    pickled."""

    def __init__(self, generator: Unit, d: Whole | None = None, *, seed: Whole = 1, threads: Whole = 0,
                 max_memory: Number = 0, progress: Progress = None, **options: Option) -> None:
        self._made_by: tuple[Unit, Whole | None, dict[str, Any]] = generator, d, {**options}
        self._made_by[2].update(seed=seed, threads=threads, max_memory=max_memory, progress=progress)
        self._how = run_options(threads, max_memory, progress)
        self._points = _stipple.Indexed(
            spec_text("generator", generator), settings_of(options),
            whole_or_none("d", d, 0, DIMENSIONS), seed_of(seed),
        )

    def __reduce__(self) -> tuple[Callable[..., Sequence], tuple[Any, ...]]:
        return _again, self._made_by

    @property
    def d(self) -> int:
        """Number of coordinates."""
        return self._points.dimension

    def __getitem__(self, index: Whole | slice) -> Floats:
        if isinstance(index, slice):
            if index.stop is None or any(isinstance(part, int) and part < low for part, low in
                                         ((index.start, 0), (index.stop, 0), (index.step, 1))):
                raise IndexError("a sequence has no end; slices are [first:last] with 0 <= first")
            first, last, step = (whole("an index", 0 if part is None else part) for part in
                                 (index.start, index.stop, 1 if index.step is None else index.step))
            rows = self._points.part(first, max(0, last - first), self._how)
            return rows if step == 1 else rows[::step].copy()
        if isinstance(index, (int, np.integer)) and index < 0:
            raise IndexError("a sequence has no end to count from")
        one: Floats = self._points.part(whole("an index", index), 1, self._how)[0]
        return one

    def blocks(self, size: Whole, start: Whole = 0) -> Iterator[Floats]:
        """Consecutive blocks (size, d) of `size` >= 1 points, from point `start` >= 0 on."""
        step = whole("size", size, 1)

        def all_blocks(first: int) -> Iterator[Floats]:
            while True:
                yield self[first : first + step]
                first += step

        return all_blocks(whole("start", start))

    def __iter__(self) -> Iterator[Floats]:
        for block in self.blocks(1024):
            yield from block


def _again(generator: Unit, d: Whole | None, options: dict[str, Any]) -> Sequence:
    return Sequence(generator, d, **options)


def sequence(generator: Unit, d: Whole | None = None, *, seed: Whole = 1, threads: Whole = 0,
             max_memory: Number = 0, progress: Progress = None, **options: Option) -> Sequence:
    """Points of a sequence by index and in blocks; see Sequence. Works with generators whose points
    do not depend on their number; raises Error for others. Arguments as for generate()."""
    return Sequence(generator, d, seed=seed, threads=threads, max_memory=max_memory,
                    progress=progress, **options)


def _each_set(sets: tuple[list[Given], bool], work: Callable[[int, Given], Any]) -> Any:
    """Applies work(k, set) to a set, or to each of several sets."""
    results = [work(k, one) for k, one in enumerate(sets[0])]
    if not sets[1]:
        return results[0]
    return np.stack(results) if len({one.shape for one in results}) == 1 else results


def warp(x: PointsLike, warp: Unit, *, threads: Whole = 0, max_memory: Number = 0,
         progress: Progress = None, **options: Option) -> Any:
    """Images of points of the unit cube: Points (n, k); arrays (sets, n, d) are warped set by set.

    x        points (n, d) or (sets, n, d) in [0, 1], a table, or a list of sets
    warp     name or spec: "disk", "triangle:method=fold", "disk@1,2"; list("warps") names all
    options  of the warp: method="concentric"

    The meta of the result has the domain for use by analyze() and inverse(), and what x's meta told
    of its making. Raises Error for points outside the unit cube.
    """
    how = run_options(threads, max_memory, progress)
    settings, spec = settings_of(options), spec_text("warp", warp)
    meta: list[Any] = []

    def image(k: int, one: Given) -> Floats:
        points, known = _stipple.warp(spec, settings, one, False, how)
        meta.append(known)
        return points

    sets = sets_of(x)
    images = _each_set(sets, image)
    if isinstance(images, list):
        return [with_meta(one, known) for one, known in zip(images, meta)]
    return with_meta(images, meta if sets[1] else meta[0])


def _on_images(spec: str, settings: _stipple.Settings, one: Given) -> Given:
    """Points on the domain of a warp's images, unless they have a domain."""
    rows, domain, meta = one
    if domain != "unit-cube":
        return one
    return matched((rows, _stipple.domain_of_images(spec, settings, rows.shape[-1]), meta))


def inverse(x: PointsLike, warp: Unit, *, threads: Whole = 0, max_memory: Number = 0,
            progress: Progress = None, **options: Option) -> Floats:
    """The points of the unit cube that a warp maps to x: an array (n, d) or (sets, n, d). Arguments
    as for warp(); raises Error for points outside the warp's domain."""
    how = run_options(threads, max_memory, progress)
    settings, spec = settings_of(options), spec_text("warp", warp)

    def preimage(k: int, one: Given) -> Floats:
        return _stipple.warp(spec, settings, _on_images(spec, settings, one), True, how)[0]

    found: Floats = _each_set(sets_of(x), preimage)
    return found


def pdf(x: PointsLike, warp: Unit, **options: Option) -> Floats:
    """Density of a warp's image at each point, with respect to length, area, volume ... of its
    domain: an array (n,), or (sets, n); 0 outside the domain. Arguments as for warp()."""
    settings, spec = settings_of(options), spec_text("warp", warp)
    found: Floats = _each_set(
        sets_of(x),
        lambda k, one: _stipple.warp_density(
            spec, settings, (_on_images(spec, settings, one) if one[2] else one)[0]),
    )
    return found


def scramble(x: PointsLike, scramble: Unit, *, seed: Whole = 1, start: Whole = 0, threads: Whole = 0,
             max_memory: Number = 0, progress: Progress = None, **options: Option) -> Floats:
    """Moves points of the unit cube at random, so that each becomes uniform and the set stays as
    evenly distributed: an array (n, d) or (sets, n, d).

    x         points (n, d) or (sets, n, d) in [0, 1)
    scramble  name or spec: "owen", "cranley-patterson"; list("scrambles") names all
    seed      from 0 to 2^64 - 1; for several sets, set k has the seed seed + k
    start     index of the first point, for parts of a sequence
    options   of the scramble. Digits have the bases of the generator if x has its meta, else base 2:
              for plain arrays of other bases, such as Halton's, pass base=[2, 3, 5]

    Raises Error for points outside the unit cube.
    """
    how = run_options(threads, max_memory, progress)
    settings, spec = settings_of(options), spec_text("scramble", scramble)
    first = seed_of(seed)
    at = whole("start", start)

    def scrambled(k: int, one: Given) -> Floats:
        rows, _, meta = one
        outside = np.flatnonzero(((rows < 0) | (rows > 1)).any(axis=1))
        if outside.size:
            raise Error(f"x[{outside[0]}] is {rows[outside[0]].tolist()}, outside the unit cube", "input")
        return _stipple.scramble(spec, settings, rows, meta, (first + k) % 2**64, at, how)

    found: Floats = _each_set(sets_of(x), scrambled)
    return found


def analyze(analyzer: Unit, x: PointsLike, *, domain: str | None = None, parameters: Parameters = None,
            integrand: str | Callable[[Floats], ArrayLike] | None = None, threads: Whole = 0,
            max_memory: Number = 0, progress: Progress = None, **options: Option) -> Report:
    """Results of an analyzer for a set of points: a Report, which is a mapping with attributes.

    analyzer   name or spec: "star-discrepancy", "l2-discrepancy:kind=centered"
    x          points (n, d), or a table; each number is finite, but NaN may mark failed runs for the
               analyzer sensitivity. Its inputs are the columns with the names of the domain's
               coordinates, and its outputs all others
    domain     the points' domain, as for `stipple analyze --domain`; default: that of their meta, or
               the unit cube
    parameters a parameter file, or a dictionary with the same content, instead of a domain
    integrand  of the analyzer integration: a name, or a function from an array (n, d) to (n,)
    options    of the analyzer

    Raises Error for points outside the domain, and for what the analyzer cannot measure.
    """
    how = run_options(threads, max_memory, progress)
    spec = spec_text("analyzer", analyzer)
    if parameters is not None:
        if domain is not None:
            raise Error("parameters and domain: give one of them")
        domain = _parameters_of(parameters)[0]
    one = given_table(x, "x", domain) if _stipple.takes_table(spec) else given(x, domain=domain)
    if callable(integrand):
        if spec != "integration":
            raise Error(f"integrand: {spec} takes no function; the analyzer integration does")
        return _integral_of(integrand, one, options)
    if integrand is not None:
        text("integrand", integrand, "the name of an integrand, or a function")
    return Report(*_stipple.analyze(spec, settings_of({"integrand": integrand, **options}), one, how))


def _values(function: Callable[[Floats], ArrayLike], x: Floats) -> Floats:
    found = function(x)
    try:
        values = np.asarray(found)
        if values.dtype.kind not in "fiub" or is_masked(found):
            raise TypeError
    except Exception:
        raise Error(f"the integrand gives {type(found).__name__} for {counted(len(x), 'point')}; "
                    f"expected an array ({len(x)},) of real numbers", "input") from None
    if values.shape != (len(x),):
        raise Error(
            f"the integrand gives the shape {values.shape} for {counted(len(x), 'point')}; "
            f"expected ({len(x)},)", "input"
        )
    if not np.isfinite(values).all():
        i = int(np.argmin(np.isfinite(values)))
        raise Error(f"the integrand is {values[i]} at x[{i}]", "input")
    return values.astype(np.float64)


def _in_unit(values: Floats, find: Callable[[Floats], Any]) -> float:
    """A mean or a deviation, found in units of a power of two: sums of the largest numbers, and
    squares of tiny and huge ones, leave float64."""
    if not np.isfinite(values).all():
        raise Error("an estimate is beyond float64", "input")
    unit = 2.0 ** (int(np.frexp(np.abs(values).max())[1]) - 1)
    return float(find(values / unit) * unit)


def _integral_of(function: Callable[[Floats], ArrayLike], one: Given,
                 options: dict[str, Any]) -> Report:
    exact = options.pop("exact", None)
    mean = flag("mean", options.pop("mean", False))
    if options:
        raise Error(f"{next(iter(options))}: a function as integrand takes `exact` and `mean` only")
    values = _values(function, one[0])
    if not mean:
        values = values / _stipple.density(one)
    found = {"estimate": _in_unit(values, np.mean)}
    if exact is not None:
        number = real("exact", exact, -np.inf, np.inf, "a number")
        found |= {"exact": number, "error": found["estimate"] - number}
    name = getattr(function, "__name__", "integrand").strip("<>")
    lines = "".join(f"{name}.{key}  {value:.6g}\n" for key, value in found.items())
    return Report({name: found}, lines)


class Integral(NamedTuple):
    """Result of integrate(): the mean of the replications' estimates, its standard error, the
    Student t confidence interval [low, high], and the estimates, an array (replications,)."""

    estimate: float
    standard_error: float
    low: float
    high: float
    estimates: Floats


def integrate(function: Callable[[Floats], ArrayLike], generator: Unit, n: Whole, d: Whole | None, *,
              replications: Whole = 16, seed: Whole = 1, start: Whole = 0,
              confidence: Number = 0.95, warp: Unit | None = None, mean: bool = False,
              threads: Whole = 0, max_memory: Number = 0, progress: Progress = None, **options: Option) -> Integral:
    """Integral of a function over the unit cube, or over the domain of a warp: an Integral.

    function      takes an array (m, d) of points; returns an array (m,) of finite values
    generator     name or spec; its seeds must give independent sets: "sobol:scramble=owen"
    n, d          number of points of each set, and of their coordinates
    replications  number of sets of n points, with seeds seed, seed + 1, ...; at least 2
    start         index of the first point, for sequences
    confidence    of the interval, in (0, 1)
    warp          one warp; values are divided by the density of its images
    mean          estimate the mean of the values under the warp's distribution, such as an expected
                  value, instead of the integral over its domain
    options       of the generator

    Raises Error if sets do not depend on their seeds; exceptions of the function are passed on.
    """
    if not callable(function):
        refuse("function", function, "a function of an array of points")
    if whole("replications", replications, 0) < 2:
        raise Error("replications: an error needs two or more")
    for name in options:
        if name in generate.__kwdefaults__:
            raise Error(f"integrate() has no argument {name!r}; a warp moves the points to another domain")
    spec = spec_text("generator", generator)
    mapping = None if warp is None else spec_text("warp", warp)
    plain = flag("mean", mean) or mapping is None
    confidence = real("confidence", confidence, 0, 1, "a number between 0 and 1")
    estimates: list[float] = []
    before: Floats | None = None
    made_by: dict[str, Any] = {**options, "start": start, "threads": threads, "max_memory": max_memory,
                               "progress": progress}
    for r in range(replications):
        x = generate(spec, n, d, seed=seed_of(seed) + r, warp=mapping, **made_by)
        if before is not None and np.array_equal(x, before):
            raise Error(f"{spec}: its points do not depend on the seed; scramble them")
        before = x
        values = _values(function, x)
        estimates.append(_in_unit(values if plain else values / pdf(x, mapping or ""), np.mean))
    rows = [("", "", 0, 0, r, "", value, "") for r, value in enumerate(estimates)]
    centre, low, high = _stipple.means(rows, confidence)[0][6:9]
    replicates = np.array(estimates)
    error = _in_unit(replicates, lambda values: np.std(values, ddof=1) / np.sqrt(replications))
    return Integral(centre, error, low, high, replicates)


def read(path: Path, *, format: str = "", d: Whole = 0, single: bool = False, threads: Whole = 0,
         max_memory: Number = 0, progress: Progress = None,
         **unknown: Never) -> Points | list[Points]:
    """Points of a file: Points (n, d) with the file's meta; a list of them if the file has several
    sets.

    format  name of a format, list("formats"); default: the file tells
    d       number of coordinates, for raw binary files without a file FILE.meta.json beside them
    single  raw binary files have float32 numbers

    Raises Error for files that cannot be read.
    """
    _only(read, unknown)
    sets = _stipple.read(os.fsencode(path_of("path", path)), text("format", format),
                         whole("d", d, 0, DIMENSIONS), flag("single", single),
                         run_options(threads, max_memory, progress))
    points = [with_meta(rows, meta) for rows, meta in sets]
    return points[0] if len(points) == 1 else points


def _check_names(x: Any, sets: list[Given], format: str, header: bool, meta: bool) -> None:
    """Refuses names and words that would not be read back; warns of words that the format cannot hold."""
    tables = x if isinstance(x, (list, tuple)) else [x]
    for table, (rows, _, told) in zip(tables, sets):
        known = json.loads(told) if told else {}
        names, levels = known.get("columns") or [], known.get("levels") or {}
        if is_frame(table) and len([*table.columns]) > rows.shape[1]:
            raise Error(f"x has the columns {', '.join(map(str, table.columns))}, and its domain only "
                        f"{', '.join(names)}; write these alone", "input")
        texts = format in ("csv", "tsv")
        for name in names if texts and header or meta or format in ("json", "jsonl") else []:
            if not is_word(name) or name in ("set", "pdf", "weight"):
                raise Error(f"x has a column named {name!r}, which a file cannot hold as a name; rename it",
                            "input")
        for name, word in ((name, word) for name in names for word in levels.get(name, [])):
            if (texts or meta or format in ("json", "jsonl")) and not is_word(word):
                raise Error(f"x[{name!r}] has the word {word!r}, which a file cannot hold as a word", "input")
        if is_frame(table) and levels and not (texts or meta or format in ("json", "jsonl")):
            places = "; ".join(f"{name}: {', '.join(f'{k} {word}' for k, word in enumerate(words))}"
                               for name, words in levels.items())
            warnings.warn(f"the file has no words, which are written as numbers: {places}", Note, 3)


def write(path: Path, x: PointsLike | Iterable[PointsLike], *, domain: str | None = None,
          format: str = "", header: bool = True, meta: bool = False, single: bool = False,
          precision: Whole | None = None, threads: Whole = 0, max_memory: Number = 0,
          progress: Progress = None, **unknown: Never) -> None:
    """Writes points to a file in the format of its extension: csv, tsv, txt, json, jsonl, npy, bin,
    utk, ply, svg; .gz and .zst compress it.

    x          points (n, d) or (sets, n, d), a table, whose names and words are kept, or a list of
               sets
    domain     of the points; default: that of their meta, or the unit cube
    format     instead of the extension's, such as "psa": list("formats") names all
    header     write names of columns, where the format has them
    meta       write the provenance, where the format does so only on request
    single     write float32 numbers, where the format is binary
    precision  digits after the point, from 0 to 1000

    Raises Error for formats that cannot hold the points, and for files that cannot be written.
    """
    _only(write, unknown)
    digits = whole_or_none("precision", precision, 0, 1000)
    name, format = path_of("path", path), text("format", format)
    sets, several = sets_of(x, "x", domain)
    sets = alike([(f"x[{k}]" if several else "x", one) for k, one in enumerate(sets)])
    _check_names(x, sets, format or name.removesuffix(".gz").removesuffix(".zst").rpartition(".")[2].lower(),
                 flag("header", header), flag("meta", meta))
    _stipple.write(os.fsencode(name), sets, format,
                   flag("header", header), flag("meta", meta), flag("single", single), digits,
                   run_options(threads, max_memory, progress))


class StudyValue(NamedTuple):
    """A number of a study. value is None and failure says why if the analyzer failed."""

    generator: str
    analyzer: str
    dimension: int
    count: int  # type: ignore[assignment]
    seed: int
    key: str
    value: float | None
    failure: str


class StudyMean(NamedTuple):
    """The mean of a result over `sets` seeds, with its confidence interval and the root mean square,
    which is the usual mean of errors."""

    generator: str
    analyzer: str
    dimension: int
    count: int  # type: ignore[assignment]
    key: str
    sets: int
    mean: float
    low: float
    high: float
    rms: float


class Study(list[StudyValue]):
    """The numbers of a study, each a StudyValue; means() averages them over seeds. A table of pandas
    is pandas.DataFrame(study)."""

    def means(self, confidence: Number = 0.95) -> list[StudyMean]:
        """Means over the seeds with Student's t confidence intervals of this level in (0, 1): a list
        of StudyMean."""
        level = real("confidence", confidence, 0, 1, "a number between 0 and 1")
        return [StudyMean(*row) for row in _stipple.means(_rows(self), level)]

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{name}</th>" for name in StudyValue._fields)
        body = "".join(
            "<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in self[:100]
        )
        return f"<table><tr>{head}</tr>{body}</table>"


def _rows(study: Iterable[StudyValue]) -> list[tuple[Any, ...]]:
    rows: list[tuple[Any, ...]] = []
    for i, row in enumerate(study):
        if not isinstance(row, StudyValue):
            refuse(f"study[{i}]", row, "a StudyValue")
        value = None if row.value is None else real("value", row.value, -np.inf, np.inf, "a number")
        rows.append((
            text("generator", row.generator), text("analyzer", row.analyzer),
            whole("dimension", row.dimension), whole("count", row.count), seed_of(row.seed),
            text("key", row.key), value, text("failure", row.failure),
        ))
    return rows


def study(generators: Units, analyzers: Units, *, n: Whole | Iterable[Whole] = (1024,),
          d: Whole | Iterable[Whole] | None = None, seeds: Whole = 1, seed: Whole = 1,
          warp: Units | None = None, parameters: Parameters = None,
          keys: str | Iterable[str] = (), threads: Whole = 0, max_memory: Number = 0,
          progress: Progress = None, **unknown: Never) -> Study:
    """Measures every generator at every count and dimension, with several seeds, by every analyzer.
    Returns a Study: a list of StudyValue, ordered by generator, dimension, count, seed and analyzer.

    generators, analyzers  one name or spec, or several
    n, d        numbers of points, and of coordinates; default of d: that of the parameters, or 2
    seeds       number of sets of each kind, with the seeds seed, seed + 1, ...
    warp        a warp or scramble of all sets, or a list of them
    parameters  a parameter file, or a dictionary with the same content
    keys        the results to keep, as for `stipple study --keys`: "value", "mean[0]"

    Raises Error for unknown names and keys; failures of analyzers are recorded in the rows.
    """
    _only(study, unknown)
    warps = listed("warp", warp)
    if parameters is not None:
        spec, dimension = _parameters_of(parameters)
        warps.append(spec)
        d = dimension if d is None else d
    specs = listed("generators", generators), listed("analyzers", analyzers)
    for name, given_specs in zip(("generators", "analyzers"), specs):
        if not given_specs:
            raise Error(f"{name}: expected one or more names or specs")
    kept = [keys] if isinstance(keys, (str, bytes)) or not isinstance(keys, Iterable) else list(keys)
    rows = _stipple.study(
        *specs, warps, wholes("n", n),
        wholes("d", 2 if d is None else d, 1, DIMENSIONS), seed_of(seed),
        whole("seeds", seeds, 1, 10**9), [text("keys", key, "the key of a result") for key in kept],
        run_options(threads, max_memory, progress),
    )
    return Study(StudyValue(*row)._replace(failure=in_python(row[-1])) for row in rows)


def _by_name(x: Any) -> Any:
    """Sets of an array (sets, n, d), or sets or reports of a list, by name: their index in x."""
    items = x if isinstance(x, (list, tuple)) or isinstance(x, np.ndarray) and x.ndim == 3 else []
    several = len(items) > 0 and all(
        isinstance(one, Report) or is_frame(one) or isinstance(one, np.ndarray) and one.ndim == 2
        for one in items)
    return {str(k): one for k, one in enumerate(items)} if several else x


def _named(x: Any) -> list[tuple[str, Given]]:
    sets = x if isinstance(x, Mapping) else {"points": x}
    if not sets:
        raise Error("x is empty; expected points, or a dictionary of points by name")
    names = [text("a name in x", name) for name in sets]
    places = [f"x[{name!r}]" if sets is x else "x" for name in sets]
    found = [(place, given(one, place)) for place, one in zip(places, sets.values())]
    dimensions = {one[0].shape[1] for _, one in found}
    if len(dimensions) > 1:
        raise Error(f"x has sets of {' and '.join(map(str, sorted(dimensions)))} coordinates; "
                    "expected sets of one dimension", "input")
    return list(zip(names, alike(found)))


def report(path: Path, x: PointsLike | Mapping[str, PointsLike] | Iterable[Frame], *,
           threads: Whole = 0, max_memory: Number = 0, progress: Progress = None, **unknown: Never) -> Page:
    """Writes a self-contained HTML page that compares up to 12 sets of one dimension: points, or a
    dictionary of points by name, or a list of them, named 0, 1, ... Returns a Page, which notebooks
    display. Raises Error for sets that cannot be compared, and if the file cannot be written."""
    _only(report, unknown)
    name = path_of("path", path)
    _stipple.report(os.fsencode(name), _named(_by_name(x)), run_options(threads, max_memory, progress))
    return Page(name)


def _relabelled(x: Any, labels: str | Iterable[str]) -> Any:
    """The sets or reports with these names, or the study with these names of its generators."""
    names = [labels] if isinstance(labels, str) or not isinstance(labels, Iterable) else list(labels)
    names = [text("labels", name, "names") for name in names]
    generators = list(dict.fromkeys(row[0] for row in _rows(x))) if _is_study(x) else []
    values = generators or (list(x.values()) if isinstance(x, dict) else [x])
    if len(names) != len(values) or len(set(names)) != len(names):
        of = counted(len(values), "generator" if generators else "set")
        raise Error(f"labels: {counted(len(names), 'name')} for {of}; expected one for each, all different")
    found = dict(zip(generators or names, names if generators else values))
    return [row._replace(generator=found[row.generator]) for row in x] if generators else found


def _is_study(x: Any) -> bool:
    return isinstance(x, list) and bool(x) and isinstance(x[0], StudyValue)


def _chart_of(x: Any, key: str) -> _stipple.Chart | None:
    """The chart of a study, or of reports; None for points."""
    if isinstance(x, Study) or _is_study(x):
        return _stipple.study_chart(_rows(x), key)
    reports = x if isinstance(x, dict) else {"report": x}
    if not reports or not all(isinstance(one, Report) for one in reports.values()):
        return None
    if any(one._record is None for one in reports.values()):
        raise Error("a part of a report, or an integral of a function, has no picture", "input")
    return _stipple.report_chart(
        [(text("a name in x", name), one._record, one._plain()) for name, one in reports.items()],
        key,
    )


Plotted: TypeAlias = (
    PointsLike | Report | Study | Mapping[str, PointsLike] | Mapping[str, Report] | list[StudyValue]
    | Iterable[Report] | Iterable[Frame]
)


@overload  # type: ignore[misc]  # None is not meant by Axes
def plot(x: Plotted, ax: None = None, *, key: str = "", width: Number = 0, height: Number = 0,
         title: str | None = None, labels: str | Iterable[str] | None = None, threads: Whole = 0,
         max_memory: Number = 0, progress: Progress = None, **unknown: Never) -> Picture: ...
@overload
def plot(x: Plotted, ax: Axes, *, key: str = "", width: Number = 0, height: Number = 0,
         title: str | None = None, labels: str | Iterable[str] | None = None, threads: Whole = 0,
         max_memory: Number = 0, progress: Progress = None, **unknown: Never) -> Axes: ...
def plot(x: Any, ax: Any = None, *, key: str = "", width: Number = 0, height: Number = 0,
         title: str | None = None, labels: str | Iterable[str] | None = None, threads: Whole = 0,
         max_memory: Number = 0, progress: Progress = None, **unknown: Never) -> Any:
    """A picture of points, of reports, or of a study.

    x       points, or a dictionary of points by name. 1-D points give a histogram; 2-D and 3-D points
            are shown with the outline of their domain; others as pairs of coordinates.
            A Report, or a dictionary of Reports of one analyzer by name: they are shown by their
            curves; if they have none, by one number against the number of points.
            Lists of sets or Reports, and arrays (sets, n, d), have the names 0, 1, ...
            A Study, or a list of its rows: means against the number of points
    ax      axes of Matplotlib, to draw there: points (n, 2), or a chart. A list of axes has one for
            each panel of the chart; single axes show the first panel
    key     the result to draw, of reports and studies; if there is none of this name, all that have
            it as a part: "centered" draws "centered.value" and "centered.squared"
    width, height  of the picture; 0: automatic
    title   replaces the title; "" leaves out title and subtitle
    labels  names in the legend, of the sets, or of a study's generators; default: the keys of the
            dictionary, or the specs of the generators

    Returns ax if given, else a Picture, which notebooks display; its save(path) writes it as .svg,
    .pdf or .png. Raises Error for what cannot be drawn.
    """
    _only(plot, unknown)
    how = run_options(threads, max_memory, progress)
    if title is not None:
        text("title", title)
    width = real("width", width, 0, 1e6, "a length; 0: automatic")
    height = real("height", height, 0, 1e6, "a length; 0: automatic")
    x = _by_name(x)
    if labels is not None:
        x = _relabelled(x, labels)
    chart = _chart_of(x, text("key", key))
    if ax is None:
        drawing = (chart.drawing(width, height, title) if chart else
                   _stipple.picture(_named(x), width, height, title, how))
        return Picture(drawing)
    axes = _axes.axes_of(ax)
    if chart:
        _axes.draw_chart(axes, chart, title)
        return ax
    sets = _named(x)
    logs = _stipple.log_axes(sets[0][1]) if sets[0][1][0].shape[1] == 2 else []
    _axes.draw_points(axes[0], [(name, one[0]) for name, one in sets], title,
                      isinstance(x, Mapping), logs)
    return ax
