# SPDX-License-Identifier: MIT
"""The scripts that draw figures."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
pytest.importorskip("matplotlib")


def script(name, *arguments):
    return subprocess.run([sys.executable, SCRIPTS / name, *map(str, arguments)], capture_output=True, text=True)


def drawn(name, *arguments):
    """Words of the picture."""
    done = script(name, *arguments)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    words = re.findall("<text[^>]*>(.*?)</text>", Path(arguments[-1]).read_text(), re.S)
    return "\n".join(re.sub("<[^>]*>|\n *", "", word) for word in words).replace("\xa0", " ")


# A grid of m x m cells has the star discrepancy 1/m - 1/(4 m^2): nearly n^-0.49 here.
def test_convergence_has_a_curve_with_its_slope_for_each_generator(tmp_path):
    words = drawn("plot_convergence.py", "star-discrepancy", "random", "grid", "-n", 64, 256, 1024,
                  "-o", tmp_path / "a.svg")
    for word in ("star-discrepancy of 5 sets, 2-D", "random, n−0.", "grid, n−0.49", "number of points n", "value"):
        assert word in words


def test_convergence_of_errors_is_of_their_root_mean_square(tmp_path):
    words = drawn("plot_convergence.py", "integration:integrand=owen", "random", "sobol:scramble=owen",
                  "-n", 16, 64, "-m", 3, "-o", tmp_path / "a.svg")
    assert "RMS owen.error" in words


@pytest.mark.parametrize("arguments, why", [
    (["nobody", "random", "-o", "a.svg"], "unknown analyzer 'nobody'"),
    (["moments", "random", "-o", "a.svg", "--key", "valeu"], "no numbers above 0 are 'valeu'"),
    (["moments", "random", "-o", "a.txt"], "'a.txt' does not end in"),
])
def test_convergence_refuses_what_cannot_be_drawn(arguments, why):
    done = script("plot_convergence.py", *arguments)
    assert done.returncode == 2 and why in done.stderr


def test_overview_is_drawn(tmp_path):
    assert "test on the disk: stratified" in drawn("overview.py", tmp_path / "a.svg")
