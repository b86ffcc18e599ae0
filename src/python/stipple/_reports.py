# SPDX-License-Identifier: MIT
"""Results of analyzers, pictures and pages."""

import html
import os
from collections.abc import Mapping

from ._errors import Error


class Report(Mapping):
    """Results of an analyzer by name, also as attributes: report["value"] is report.value.

    Numbers, flags and texts are Python objects; curves are arrays (k,), grids are arrays (rows,
    columns), and groups of results are Reports themselves. unmet lists the expectations that do not
    hold.
    """

    def __init__(self, values, text="", unmet=(), found=None):
        self._values = {
            name: Report(value) if isinstance(value, dict) else value
            for name, value in values.items()
        }
        self._text = text
        self.unmet = list(unmet)
        self._found = found  # what plot() draws

    def __getitem__(self, key):
        value = self._values
        for name in key.split(".") if key not in self._values else [key]:
            try:
                value = value[name]
            except (KeyError, TypeError, IndexError):
                raise KeyError(key) from None
        return value

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(f"the report has no {name}; it has {', '.join(self)}") from None

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def __repr__(self):
        return self._text.rstrip("\n") or repr(self._values)

    def _repr_html_(self):
        return f"<pre>{html.escape(repr(self))}</pre>"


class Picture:
    """A picture: displayed by notebooks, written by save(path); svg is its SVG text."""

    def __init__(self, drawing):
        self._drawing = drawing

    @property
    def svg(self):
        return self._drawing.bytes("svg").decode()

    def _repr_svg_(self):
        return self.svg

    def save(self, path):
        """Writes the picture to a file in the format of its extension: .svg, .pdf or .png."""
        extension = os.path.splitext(os.fspath(path))[1].lower()
        if extension not in (".svg", ".pdf", ".png"):
            raise Error(f"{os.fspath(path)} has no extension of a picture; expected .svg, .pdf or .png")
        with open(path, "wb") as file:
            file.write(self._drawing.bytes(extension[1:]))

    def __repr__(self):
        return f"<picture, {len(self.svg)} bytes as SVG>"


class Page:
    """An HTML page in a file; displayed by notebooks."""

    def __init__(self, path):
        self.path = path

    def _repr_html_(self):
        with open(self.path, encoding="utf-8") as file:
            page = html.escape(file.read())
        return f'<iframe srcdoc="{page}" width="100%" height="640"></iframe>'

    def __repr__(self):
        return f"<HTML page {self.path}>"
