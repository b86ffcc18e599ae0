# SPDX-License-Identifier: MIT
"""Runs README and the scripts of data/examples unchanged."""

import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_readme_runs():
    [block] = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)
    names = {}
    exec(block, names)
    assert names["points"].shape == (1024, 5)
    assert abs(names["found"].estimate - 0.25) < 5 * names["found"].standard_error + 1e-9


def test_guide_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("svg")
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "data/guide/python.md").read_text(), re.S)
    names = {}
    exec("\n".join(blocks), names)
    assert names["x"].shape == (1024, 5) and (tmp_path / "page.html").exists()
    assert abs(names["found"].estimate - 1) < 5 * names["found"].standard_error
    pyplot.close("all")


@pytest.mark.parametrize("script", sorted((ROOT / "data/examples").glob("*.py")), ids=lambda p: p.name)
def test_examples_run(script, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    cells = script.read_text().split("# %%")[1:]  # words and code in turn
    assert len(cells) > 3 and [cell.startswith(" [markdown]\n# ") for cell in cells] == [True, False] * (len(cells) // 2)
    runpy.run_path(str(script), run_name="__main__")
    assert capsys.readouterr().out
