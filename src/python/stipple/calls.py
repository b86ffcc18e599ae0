# SPDX-License-Identifier: MIT
"""The functions of the package."""

import collections
import difflib
import inspect
import json
import os
import sys

import numpy as np

from . import _stipple
from ._arrays import (
    as_rows,
    bounds_text,
    domain_of,
    listed,
    meta_text,
    settings_of,
    spec_text,
    with_meta,
)
from ._errors import Error
from ._reports import Page, Picture, Report


def _bar(share):
    done = int(30 * share)
    end = "\r\033[K" if share >= 1 else ""
    sys.stderr.write(f"\r[{'=' * done}{' ' * (30 - done)}] {100 * share:3.0f} %{end}")
    sys.stderr.flush()


def _how(threads=0, max_memory=0, progress=None):
    shown = _bar if progress is True else progress or None
    return _stipple.How(threads, max_memory, shown)


def _take_how(options):
    """Removes the arguments common to all calls from the options and returns them."""
    return _how(*(options.pop(name, default) for name, default in
                  (("threads", 0), ("max_memory", 0), ("progress", None))))


def _only_how(call, options):
    """As _take_how(), for a call without units, which has no other options: refuses them."""
    how = _take_how(options)
    for name in options:
        known = [*inspect.signature(call).parameters][:-1] + ["threads", "max_memory", "progress"]
        near = difflib.get_close_matches(name, known, n=1)
        hint = f"did you mean '{near[0]}'?" if near else f"known arguments: {', '.join(known)}"
        raise Error(f"{call.__name__}() has no argument '{name}'", hint=hint)
    return how


def _parameters_spec(parameters):
    """The warp of a parameter file, given by its path or by its content."""
    if not isinstance(parameters, dict):
        with open(os.fspath(parameters), encoding="utf-8") as file:
            parameters = json.load(file)
    text = json.dumps({k: v for k, v in parameters.items() if k != "$schema"})
    return f"parameters:json=[{text}]"


def generate(generator, n=None, d=None, *, seed=1, start=0, sets=1, bounds=None, warp=None,
             parameters=None, return_meta=False, **options):
    """Points of a generator: an array (n, d) of float64, or (sets, n, d) for several sets.

    generator   name or spec: "halton", "sobol:scramble=owen"; list("generators") names all
    n, d        number of points and of coordinates; by default the generator decides
    seed        seed of the first set; the others have seed + 1, ...
    start       index of the first point, for sequences
    bounds      (low, high), or one pair for each coordinate: the box that the points fill
    warp        a warp or scramble, or a list of them: "disk:method=concentric"
    parameters  a parameter file, or a dictionary with the same content
    return_meta returns Points: arrays whose .meta is a dictionary with their provenance, from which
                analyze() takes the domain
    options     of the generator: scramble="owen"; and threads, max_memory, progress

    The numbers are bit for bit those of `stipple generate` with the same arguments. A single set is
    not copied. Sets of different sizes are returned as a list of arrays.
    """
    how = _take_how(options)
    warps = listed(warp)
    if parameters is not None:
        warps.append(_parameters_spec(parameters))
    asked = _stipple.Asked(
        generator, settings_of(options), n, d, seed, start, sets, bounds_text(bounds), warps
    )
    points, meta = _stipple.generate(asked, return_meta, how)
    if not return_meta:
        return points
    if isinstance(points, list):
        return [with_meta(one, each) for one, each in zip(points, meta)]
    return with_meta(points, meta[0] if sets == 1 else meta)


class Sequence:
    """Points of a sequence by index: s[10] is an array (d,), s[10:20] an array (10, d), and
    s.blocks(1000) yields blocks of 1000 points endlessly."""

    def __init__(self, generator, d=None, *, seed=1, **options):
        self._how = _take_how(options)
        self._points = _stipple.Indexed(generator, settings_of(options), d, seed)

    @property
    def d(self):
        """Number of coordinates."""
        return self._points.dimension

    def __getitem__(self, index):
        if isinstance(index, slice):
            first, step = index.start or 0, index.step or 1
            if index.stop is None or first < 0 or index.stop < 0 or step < 1:
                raise IndexError("a sequence has no end; slices are [first:last] with 0 <= first")
            rows = self._points.part(first, max(0, index.stop - first), self._how)
            return rows if step == 1 else rows[::step].copy()
        index = index.__index__()
        if index < 0:
            raise IndexError("a sequence has no end to count from")
        return self._points.part(index, 1, self._how)[0]

    def blocks(self, size, start=0):
        """Consecutive blocks of `size` points, from point `start` on."""
        if size < 1:
            raise Error("size: a block has one point or more")
        while True:
            yield self[start : start + size]
            start += size

    def __iter__(self):
        for block in self.blocks(1024):
            yield from block


def sequence(generator, d=None, *, seed=1, **options):
    """Points of a sequence by index and in blocks; see Sequence. Works with generators whose points
    do not depend on their number."""
    return Sequence(generator, d, seed=seed, **options)


def _each_set(x, work):
    """Applies work(rows) to a set, or to each of several sets."""
    rows = as_rows(x, most=3)
    if rows.ndim == 2:
        return work(rows)
    return np.stack([work(one) for one in rows])


def warp(x, warp, **options):
    """Images of points of the unit cube: arrays (n, k); arrays (sets, n, d) are warped set by set.

    warp     name or spec: "disk", "triangle:method=fold", "disk@1,2"; list("warps") names all
    options  of the warp: method="concentric"; and threads, max_memory, progress

    Returns Points, whose meta has the domain for use by analyze() and inverse().
    """
    how = _take_how(options)
    settings = settings_of(options)
    text = spec_text(warp)
    before = domain_of(x, None)
    domains = []

    def image(rows):
        points, domain = _stipple.warp(text, settings, rows, before, False, how)
        domains.append(domain)
        return points

    return with_meta(_each_set(x, image), {"domain": domains[0]})


def inverse(x, warp, **options):
    """The points of the unit cube that a warp maps to x; arguments as for warp()."""
    how = _take_how(options)
    settings = settings_of(options)
    text = spec_text(warp)
    rows = as_rows(x, most=3)
    domain = domain_of(x, None)
    if domain == "unit-cube":
        domain = _stipple.domain_of_images(text, settings, rows.shape[-1])
    return _each_set(rows, lambda one: _stipple.warp(text, settings, one, domain, True, how)[0])


def pdf(x, warp, **options):
    """Density of a warp's image at each point, with respect to length, area, volume ... of its
    domain: an array (n,), or (sets, n); 0 outside the domain. Arguments as for warp()."""
    settings = settings_of(options)
    text = spec_text(warp)
    return _each_set(x, lambda rows: _stipple.warp_density(text, settings, rows))


def scramble(x, scramble, *, seed=1, start=0, **options):
    """Moves points of the unit cube at random, so that each becomes uniform and the set stays as
    evenly distributed.

    scramble  name or spec: "owen", "cranley-patterson"; list("scrambles") names all
    start     index of the first point, for parts of a sequence
    options   of the scramble. Digits have the bases of the generator if x has its meta, else base 2:
              for plain arrays of other bases, such as Halton's, pass base=[2, 3, 5]

    For several sets (sets, n, d), set k has the seed seed + k.
    """
    how = _take_how(options)
    settings = settings_of(options)
    text = spec_text(scramble)
    rows = as_rows(x, most=3)
    if rows.ndim == 2:
        return _stipple.scramble(text, settings, rows, meta_text(x), seed, start, how)
    return np.stack([_stipple.scramble(text, settings, one, meta_text(x[k]), seed + k, start, how)
                     for k, one in enumerate(rows)])


def analyze(analyzer, x, *, domain=None, integrand=None, **options):
    """Results of an analyzer for a set of points: a Report, which is a mapping with attributes.

    analyzer   name or spec: "star-discrepancy", "l2-discrepancy:kind=centered"
    x          points (n, d)
    domain     the points' domain, as for `stipple analyze --domain`; default: that of their meta, or
               the unit cube
    integrand  of the analyzer integration: a name, or a function from an array (n, d) to (n,)
    options    of the analyzer; and threads, max_memory, progress
    """
    how = _take_how(options)
    rows = as_rows(x)
    on = domain_of(x, domain)
    if callable(integrand):
        return _integral_of(integrand, rows, on, options)
    found = _stipple.analyze(
        analyzer, settings_of({"integrand": integrand, **options}), rows, on, how
    )
    return Report(*found)


def _values(function, x):
    values = np.asarray(function(x), dtype=float)
    if values.shape != (len(x),):
        raise Error(
            f"the integrand gives the shape {values.shape} for {len(x)} points; expected "
            f"({len(x)},)", "input"
        )
    if not np.isfinite(values).all():
        i = int(np.argmin(np.isfinite(values)))
        raise Error(f"the integrand is {values[i]} at x[{i}]", "input")
    return values


def _integral_of(function, rows, domain, options):
    exact = options.pop("exact", None)
    mean = options.pop("mean", False)
    if options:
        raise Error(f"{next(iter(options))}: a function as integrand takes `exact` and `mean` only")
    values = _values(function, rows)
    if not mean:
        values = values / _stipple.density(domain, rows)
    estimate = float(np.mean(values))
    found = {"estimate": estimate}
    if exact is not None:
        found |= {"exact": float(exact), "error": estimate - float(exact)}
    name = getattr(function, "__name__", "integrand").strip("<>")
    text = "".join(f"{name}.{key}  {value:.6g}\n" for key, value in found.items())
    return Report({name: found}, text)


Integral = collections.namedtuple("Integral", "estimate standard_error low high estimates")
Integral.__doc__ = """Result of integrate(): the mean of the replications' estimates, its standard
error, the Student t confidence interval [low, high], and the estimates."""


def integrate(function, generator, n, d, *, replications=16, seed=1, confidence=0.95, warp=None,
              mean=False, **options):
    """Integral of a function over the unit cube, or over the domain of a warp: an Integral.

    function      takes an array (m, d) of points; returns an array (m,) of values
    generator     name or spec; its seeds must give independent sets: "sobol:scramble=owen"
    replications  number of sets of n points, with seeds seed, seed + 1, ...; at least 2
    warp          one warp; values are divided by the density of its images
    mean          estimate the mean of the values under the warp's distribution, such as an expected
                  value, instead of the integral over its domain
    options       of the generator; and threads, max_memory, progress
    """
    if replications < 2:
        raise Error("replications: an error needs two or more")
    estimates = []
    before = None
    for r in range(replications):
        x = generate(generator, n, d, seed=seed + r, warp=warp, **options)
        if np.array_equal(x, before):
            raise Error(f"{generator}: its points do not depend on the seed; scramble them")
        before = x
        values = _values(function, x)
        estimates.append(float(np.mean(values if warp is None or mean else values / pdf(x, warp))))
    rows = [("", "", d, n, r, "", value, "") for r, value in enumerate(estimates)]
    mean, low, high = _stipple.means(rows, confidence)[0][6:9]
    error = float(np.std(estimates, ddof=1) / np.sqrt(replications))
    return Integral(mean, error, low, high, np.array(estimates))


def read(path, *, format="", d=0, single=False, **options):
    """Points of a file: Points (n, d) with the file's meta; a list of them if the file has several
    sets. d and single (float32) are required for raw binary files."""
    sets = _stipple.read(os.fspath(path), format, d, single, _only_how(read, options))
    points = [with_meta(rows, meta) for rows, meta in sets]
    return points[0] if len(points) == 1 else points


def _given(x, domain=None):
    return as_rows(x), domain_of(x, domain), meta_text(x)


def write(path, x, *, domain=None, format="", header=True, meta=False, single=False,
          precision=None, **options):
    """Writes points (n, d), or several sets, to a file in the format of its extension: csv, txt,
    json, jsonl, npy, bin, utk, psa, ply, svg; .gz and .zst compress it."""
    how = _only_how(write, options)
    several = x if isinstance(x, list) and np.ndim(x[0]) == 2 else None
    if several is None:
        several = [x] if np.ndim(x) != 3 else list(x)
    _stipple.write(os.fspath(path), [_given(one, domain) for one in several], format, header, meta,
                   single, precision, how)


StudyValue = collections.namedtuple(
    "StudyValue", "generator analyzer dimension count seed key value failure"
)
StudyMean = collections.namedtuple(
    "StudyMean", "generator analyzer dimension count key sets mean low high rms"
)


class Study(list):
    """The numbers of a study, each a StudyValue; means() averages them over seeds."""

    def means(self, confidence=0.95):
        """Means over the seeds with Student's t confidence intervals: a list of StudyMean."""
        return [StudyMean(*row) for row in _stipple.means([tuple(row) for row in self], confidence)]

    def _repr_html_(self):
        head = "".join(f"<th>{name}</th>" for name in StudyValue._fields)
        body = "".join(
            "<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in self[:100]
        )
        return f"<table><tr>{head}</tr>{body}</table>"


def study(generators, analyzers, *, n=(1024,), d=(2,), seeds=1, seed=1, warp=None, keys=(),
          **options):
    """Measures every generator at every count and dimension, with several seeds, by every analyzer.
    Returns a Study: a list of StudyValue, ordered by generator, dimension, count, seed and
    analyzer. keys are the results to keep, as for `stipple study --keys`: "value", "mean[0]"."""
    how = _only_how(study, options)
    counts = [n] if np.isscalar(n) else [int(k) for k in n]
    dimensions = [d] if np.isscalar(d) else [int(k) for k in d]
    rows = _stipple.study(listed(generators), listed(analyzers), listed(warp), counts, dimensions,
                          seed, seeds, [keys] if isinstance(keys, str) else list(keys), how)
    return Study(StudyValue(*row) for row in rows)


def _named(x):
    sets = x if isinstance(x, dict) else {"points": x}
    return [(name, _given(one)) for name, one in sets.items()]


def report(path, x, **options):
    """Writes a self-contained HTML page that compares up to 12 sets of one dimension: points, or a
    dictionary of points by name. Returns a Page, which notebooks display."""
    _stipple.report(os.fspath(path), _named(x), _only_how(report, options))
    return Page(os.fspath(path))


def _relabelled(x, labels):
    """The sets or reports with these names."""
    labels = [labels] if isinstance(labels, str) else list(labels)
    values = list(x.values()) if isinstance(x, dict) else [x]
    if len(labels) != len(values) or len(set(labels)) != len(labels):
        raise Error(f"labels: {len(labels)} names for {len(values)} sets; expected one for each, "
                    "all different")
    return dict(zip(labels, values))


def plot(x, ax=None, *, key="", width=0, height=0, title=None, labels=None, **options):
    """A picture of points, or of a dictionary of points by name. 1-D points give a histogram; 2-D
    and 3-D points are shown with the outline of their domain; others as pairs of coordinates.
    Reports of one analyzer are shown by their curves; if they have none, by one number (chosen by
    key) against the number of points. Notebooks display the picture; save(path) writes it as .svg,
    .pdf or .png. With matplotlib axes as ax, draws points (n, 2) there and returns ax.

    title   replaces the title; "" leaves out title and subtitle
    labels  names of the sets in the legend; default: the keys of the dictionary
    """
    how = _only_how(plot, options)
    if labels is not None:
        x = _relabelled(x, labels)
    reports = x if isinstance(x, dict) else {"report": x}
    if ax is None and reports and all(isinstance(one, Report) for one in reports.values()):
        found = [(name, one._found) for name, one in reports.items()]
        if any(one is None for _, one in found):
            raise Error("a part of a report, or an integral of a function, has no picture", "input")
        return Picture(_stipple.report_picture(found, key, width, height, title))
    if ax is None:
        return Picture(_stipple.picture(_named(x), width, height, title, how))
    for name, one in (x if isinstance(x, dict) else {None: x}).items():
        rows = as_rows(one)
        if rows.shape[1] != 2:
            raise Error(f"matplotlib axes show 2 coordinates; the points have {rows.shape[1]}",
                        "input")
        ax.scatter(rows[:, 0], rows[:, 1], s=max(1, 4000 / len(rows)), label=name)
    ax.set_aspect("equal")
    if title is not None:
        ax.set_title(title)
    if isinstance(x, dict):
        ax.legend()
    return ax
