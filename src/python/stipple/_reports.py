# SPDX-License-Identifier: MIT
"""Results of analyzers, pictures and pages."""

from __future__ import annotations

import html
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np

from . import _stipple
from ._arguments import Path, path as path_of
from ._errors import Error

Record: TypeAlias = tuple[str, int, int, str]
"""Analyzer, number of points, dimension and domain."""


class Report(Mapping[str, Any]):
    """Results of an analyzer by name, also as attributes: report["value"] is report.value.

    Numbers, flags and texts are Python objects; curves are arrays (k,), grids are arrays (rows,
    columns), and groups of results are Reports themselves. report["worst_box.volume"] is the result
    of a group; KeyError and AttributeError name what there is not. unmet lists the expectations that
    do not hold. Reports can be compared, copied and pickled.
    """

    unmet: list[str]

    def __init__(self, values: Mapping[str, Any], text: str = "", unmet: Iterable[str] = (),
                 record: Record | None = None) -> None:
        self._values = {
            name: Report(value) if isinstance(value, dict) else value
            for name, value in values.items()
        }
        self._text = text
        self.unmet = list(unmet)
        self._record = record  # None for a group of results

    def __getitem__(self, key: str) -> Any:
        value: Any = self._values
        for name in key.split(".") if isinstance(key, str) and key not in self._values else [key]:
            try:
                value = value[name]
            except (KeyError, TypeError, IndexError):
                raise KeyError(key) from None
        return value

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(f"the report has no {name}; it has {', '.join(self)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Report) and list(self) == list(other) and all(
            np.array_equal(value, other[key], equal_nan=value.dtype.kind == "f")
            if isinstance(value, np.ndarray) else value == other[key] or value != value
            for key, value in self._values.items()
        )

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __repr__(self) -> str:
        return self._text.rstrip("\n") or repr(self._values)

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(repr(self))}</pre>"

    def _plain(self) -> dict[str, Any]:
        return {key: value._plain() if isinstance(value, Report) else value
                for key, value in self._values.items()}


class Picture:
    """A picture: displayed by notebooks, written by save(path); svg is its SVG text."""

    def __init__(self, drawing: _stipple.Drawing) -> None:
        self._drawing = drawing

    @property
    def svg(self) -> str:
        """The picture as SVG text."""
        return self._drawing.bytes("svg").decode()

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: Path) -> None:
        """Writes the picture to a file in the format of its extension: .svg, .pdf or .png. Raises
        Error for another extension, and OSError if the file cannot be written."""
        name = path_of("path", path)
        extension = os.path.splitext(name)[1].lower()
        if extension not in (".svg", ".pdf", ".png"):
            raise Error(f"{name} has no extension of a picture; expected .svg, .pdf or .png")
        with open(name, "wb") as file:
            file.write(self._drawing.bytes(extension[1:]))

    def __repr__(self) -> str:
        return f"<picture, {len(self.svg)} bytes as SVG>"


class Page:
    """An HTML page in a file; displayed by notebooks. path is its name."""

    def __init__(self, path: str) -> None:
        self.path = path

    def _repr_html_(self) -> str:
        with open(self.path, encoding="utf-8") as file:
            page = html.escape(file.read())
        return f'<iframe srcdoc="{page}" width="100%" height="640"></iframe>'

    def __repr__(self) -> str:
        return f"<HTML page {self.path}>"
