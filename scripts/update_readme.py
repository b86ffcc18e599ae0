#!/usr/bin/python3
"""Renews README's tables from the program in PATH: what stands between `<!-- COMMAND -->` and `<!-- end -->`."""
import pathlib
import re
import subprocess

readme = pathlib.Path(__file__).resolve().parent.parent / "README.md"


def table(match):
    command = match.group(1)
    text = subprocess.run(command.split(), check=True, capture_output=True, text=True).stdout
    return f"<!-- {command} -->\n{text}<!-- end -->"


text = readme.read_text(encoding="utf-8")
readme.write_text(
    re.sub(r"<!-- (stipple list [^>]*?) -->\n.*?<!-- end -->", table, text, flags=re.DOTALL), encoding="utf-8"
)
