# SPDX-License-Identifier: MIT
"""Copies and pickles, processes and threads."""

import copy
import multiprocessing
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import stipple

COPIES = [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x)),
          lambda x: pickle.loads(pickle.dumps(x, protocol=2))]
PARAMETERS = {"parameters": [{"name": "a", "range": [2, 3]}, {"name": "m", "levels": ["x", "y"]},
                             {"name": "k", "integers": [1, 4]}]}


@pytest.mark.parametrize("again", COPIES)
def test_points_are_copied_with_their_meta(again):
    points = stipple.generate("sobol", 8, parameters=PARAMETERS, return_meta=True)
    both = stipple.generate("random", 8, sets=2, warp="disk", return_meta=True)
    for x in (points, both, both[1], points[::2], points[:, ::2], points + 0):
        copied = again(x)
        assert type(copied) is stipple.Points and np.array_equal(copied, x) and copied.meta == x.meta
        assert not np.shares_memory(copied, x)
    again(points).meta["domain"] = "disk"
    assert points.meta["domain"].startswith("parameters:")


@pytest.mark.parametrize("again", COPIES)
def test_reports_are_copied(again):
    x = stipple.generate("random", 64)
    for analyzer in ("periodogram", "star-discrepancy", "chi-square", "moments"):
        report = stipple.analyze(analyzer, x)
        copied = again(report)
        assert copied == report and repr(copied) == repr(report) and copied.unmet == report.unmet
        assert copied != stipple.analyze(analyzer, x[:32])
    spectrum = stipple.analyze("periodogram", x)
    assert stipple.plot(again(spectrum)).svg == stipple.plot(spectrum).svg
    assert again(spectrum.radial) == spectrum.radial
    study = stipple.study("random", "moments", n=16, seeds=2)
    assert again(study) == study and again(study).means() == study.means()
    integral = stipple.integrate(lambda x: x[:, 0], "random", 4, 1)
    assert again(integral).estimate == integral.estimate


@pytest.mark.parametrize("again", COPIES)
def test_sequences_and_errors_are_copied(again):
    sequence = stipple.sequence(("halton", {"scramble": "owen"}), 3, seed=5, threads=1)
    assert np.array_equal(again(sequence)[10:20], sequence[10:20])
    with pytest.raises(stipple.Error) as caught:
        stipple.generate("haltn")
    error = again(caught.value)
    assert (str(error), error.kind, error.hint, error.message) == (
        str(caught.value), caught.value.kind, caught.value.hint, caught.value.message)


# Columns of a cube, a box, independent parameters and factors of a product have domains of their own.
def test_columns_keep_what_is_true_of_them():
    points = stipple.generate("sobol", 64, parameters=PARAMETERS, return_meta=True)
    some = points[:, [2, 1]]
    assert some.meta["columns"] == ["k", "m"] and some.meta["levels"] == {"m": ["x", "y"]}
    alone = stipple.generate("sobol", 64, parameters={"parameters": [PARAMETERS["parameters"][2]]}, return_meta=True)
    assert points[:, 2:].meta["domain"] == alone.meta["domain"] and "levels" not in points[:, 2:].meta
    given = {"parameters": [{"name": "a", "range": [2, 3]}, {"name": "b", "range": ["a", 5]}]}
    depends = stipple.generate("sobol", 16, parameters=given, return_meta=True)
    assert "domain" in depends[:, :1].meta and "domain" not in depends[:, 1:].meta
    box = stipple.generate("sobol", 16, 3, bounds=[(0, 1), (2, 3), (4, 5)], return_meta=True)
    assert box[:, [2, 0]].meta == {"domain": "box:bounds=[4..5,0..1]"}
    product = stipple.generate("random", 16, 4, warp=["disk@1,2", "normal@3"], return_meta=True)
    domains = {columns: product[:, list(columns)].meta.get("domain") for columns in
               ((0, 1), (2,), (0, 1, 2), (2, 0, 1), (0,), (3,), (3, 2), (0, 0))}
    assert domains == {(0, 1): "disk", (2,): "normal", (0, 1, 2): "disk@1,2 x normal@3", (2, 0, 1): "disk@2,3 x normal@1",
                       (0,): None, (3,): "unit-cube", (3, 2): "normal@2 x unit-cube@1", (0, 0): None}
    disk = stipple.generate("random", 16, warp="disk", return_meta=True)
    assert "domain" not in disk[:, :1].meta and disk[:4, :].meta["domain"] == "disk"
    sets = stipple.generate("random", 8, 3, sets=2, return_meta=True)
    assert [meta["domain"] for meta in sets[:, ::2, 1:].meta] == ["unit-cube"] * 2
    assert sets[1, :, :2].meta["domain"] == "unit-cube" and sets[0, 1:3, [0, 1]].meta is None


def measured(seed):
    points = stipple.generate("sobol", 256, 2, scramble="owen", seed=seed, warp="disk", return_meta=True)
    return points, stipple.analyze("chi-square", points)


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_pools_of_processes_give_the_same(method):
    here = [measured(seed) for seed in range(4)]
    with multiprocessing.get_context(method).Pool(2) as pool:
        there = pool.map(measured, range(4))
        with pytest.raises(stipple.Error, match="did you mean 'halton'"):
            pool.apply(stipple.generate, ["haltn"])
        assert np.array_equal(pool.apply(stipple.sequence("halton", 2).__getitem__, [7]), stipple.sequence("halton", 2)[7])
    for (points, report), (points2, report2) in zip(here, there):
        assert np.array_equal(points, points2) and points.meta == points2.meta and report == report2


def work(k):
    """Numbers from calls that use several threads, oneTBB, FFTW and all kinds of units."""
    x = stipple.generate("random", 6000, 3, seed=k)
    disk = stipple.warp(stipple.generate("poisson-disk", 300, seed=k), "disk")
    return (x.tobytes(), disk.tobytes(), stipple.analyze("l2-discrepancy", x)["centered.squared"],
            stipple.analyze("periodogram", x[:, :2])["radial.power"].tobytes(),
            stipple.analyze("chi-square", disk).statistic, stipple.scramble(x, "owen", seed=k).tobytes(),
            stipple.integrate(lambda x: x[:, 0], "random", 100, 2, seed=k).estimate)


def test_eight_threads_give_the_same():
    alone = [work(k) for k in range(4)]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(work, [k % 4 for k in range(16)])) == alone * 4


FORKS = """
import os, signal, sys, threading
from concurrent.futures import ThreadPoolExecutor
sys.path.insert(0, sys.argv[1])
from test_processes import work
here = work(0)
over = threading.Event()

def calls(k):
    while not over.is_set():
        work(k)

def forks(k):
    failed = 0
    for _ in range(3):
        child = os.fork()
        if child == 0:
            signal.alarm(100)
            grandchild = os.fork()
            if grandchild == 0:
                signal.alarm(100)
                os._exit(work(0) != here)
            os._exit(work(0) != here or os.waitpid(grandchild, 0)[1] != 0)
        failed += os.waitpid(child, 0)[1] != 0
    return failed

busy = [threading.Thread(target=calls, args=(k,)) for k in range(8 if sys.argv[2] == "busy" else 0)]
for thread in busy:
    thread.start()
with ThreadPoolExecutor(4) as pool:
    failed = sum(pool.map(forks, range(4)))
over.set()
for thread in busy:
    thread.join()
print(failed, "failed")
"""


# Children and their children are as able as the process, whether its other threads wait or call.
@pytest.mark.parametrize("state", ["calm", "busy"])
def test_forks_from_pools_of_threads(state):
    done = subprocess.run([sys.executable, "-c", FORKS, Path(__file__).parent, state], timeout=580,
                          capture_output=True, text=True)
    assert done.stdout == "0 failed\n", done.stderr[-2000:]
