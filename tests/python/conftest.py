# SPDX-License-Identifier: MIT
"""Shared by the tests of the Python module."""

import json
import os
import subprocess

import pytest


@pytest.fixture(scope="session")
def run():
    """Runs the program; returns its output."""

    def call(*arguments, stdin=None):
        return subprocess.run(
            [os.environ["STIPPLE_PROGRAM"], *arguments], input=stdin, capture_output=True, check=True
        ).stdout

    return call


@pytest.fixture(scope="session")
def results(run):
    """Results of `stipple analyze`, as a dictionary."""

    def call(*arguments):
        return json.loads(run("analyze", *arguments, "--json"))["results"]

    return call
