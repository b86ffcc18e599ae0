# SPDX-License-Identifier: MIT
"""Types of the package, as mypy sees them. Stubs of pandas and polars are not needed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import stipple

PACKAGE = Path(stipple.__file__).parent
HERE = Path(__file__).parent


def mypy(*arguments, folder):
    """Output of mypy for users, who have installed the package."""
    paths = {**os.environ, "MYPY_CACHE_DIR": str(folder / "cache")}
    if PACKAGE.parent.name != "site-packages":  # not installed
        paths["MYPYPATH"] = str(PACKAGE.parent)
    return subprocess.run([sys.executable, "-m", *map(str, arguments)], env=paths, cwd=folder,
                          capture_output=True, text=True)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("types")


# Each line of the program that ends in "# error: CODE" is wrong, and no other.
def test_a_strict_program_uses_the_whole_interface(folder):
    program = HERE / "typed_program.py"
    expected = {f"{number}: {line.split('# error: ')[1]}" for number, line in
                enumerate(program.read_text().splitlines(), 1) if "# error: " in line}
    done = mypy("mypy", "--strict", "--show-error-codes", "--no-error-summary", program, folder=folder)
    found = {f"{line.split(':')[1]}: {line.rsplit('[', 1)[1].rstrip(']')}" for line in done.stdout.splitlines()
             if ": error: " in line}
    assert found == expected, done.stdout + done.stderr
    used = program.read_text()
    assert not [name for name in stipple.__all__ if f"stipple.{name}" not in used]


def test_the_program_runs(folder, monkeypatch):
    monkeypatch.chdir(folder)
    source = (HERE / "typed_program.py").read_text().split("# Wrong calls")[0]
    exec(compile(source, "typed_program.py", "exec"), {"__name__": "typed_program"})


def test_the_sources_are_strict(folder):
    files = [path for path in [*PACKAGE.glob("*.py"), *PACKAGE.glob("*.pyi")] if path.stem != "__init__"]
    done = mypy("mypy", "--strict", "--follow-imports=silent", PACKAGE / "__init__.pyi", *files, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_what_there_is(folder):
    # Modules with types in their sources have no stubs, and C++ has no signatures.
    (folder / "allowed").write_text(r"stipple\.(_\w+|calls|units|qmc)(\..*)?" + "\n")
    done = mypy("mypy.stubtest", "stipple", "--allowlist", folder / "allowed", "--ignore-unused-allowlist",
                folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
