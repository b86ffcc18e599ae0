"""Shared by the comparisons of tests/oracles: running the program, and counting cases.

A part is a file tests/oracles/PART.py with functions check_NAME(cases). The first line of such a function's docstring is
its title in the table. It calls cases.compare() or cases.expect() once for each case.
"""
import json
import math
import os
import subprocess


class Cases:
    """Cases of one check: compared, agreed, disagreed."""

    def __init__(self, program, title):
        self.program = program
        self.title = title
        self.agreed = 0
        self.failures = []
        self.worst = 0.0  # largest error over its tolerance, of the cases that agree

    def run(self, *words, text=None, ok=(0,)):
        """Standard output of `stipple WORDS...`, fed with `text`.

        Raises RuntimeError with the program's message if the exit code is not one of `ok`."""
        environment = dict(os.environ, LC_ALL="C")
        words = [str(word) for word in words]
        done = subprocess.run([self.program, *words], input=text, capture_output=True, text=True, env=environment)
        if done.returncode not in ok:
            raise RuntimeError(f"exit {done.returncode} of stipple {' '.join(words)}: {done.stderr.strip()}")
        return done.stdout

    def points(self, *words, text=None):
        """Rows of numbers that `stipple WORDS...` writes."""
        out = self.run(*words, "-f", "txt", text=text)
        return [[float(word) for word in line.split()] for line in out.splitlines() if not line.startswith("#")]

    def results(self, *words, text=None):
        """`results` of the report of `stipple analyze WORDS...`."""
        return json.loads(self.run("analyze", *words, "-f", "json", text=text))["results"]

    def expect(self, what, holds, seen=""):
        """Counts a case that holds or does not."""
        if holds:
            self.agreed += 1
        else:
            self.failures.append(f"{what}: {seen}" if seen != "" else what)

    def compare(self, what, ours, right, within, absolute=0.0):
        """Counts a number: it agrees within the relative error `within`, or the absolute error `absolute`."""
        ours, right = float(ours), float(right)
        if ours == right or (math.isnan(ours) and math.isnan(right)):
            self.agreed += 1
            return
        room = max(within * abs(right), absolute)
        error = abs(ours - right)
        if error <= room:
            self.agreed += 1
            self.worst = max(self.worst, error / room)
        else:
            self.failures.append(f"{what}: {ours!r}, should be {right!r} within {room:.3g}")
