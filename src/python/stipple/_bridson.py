# SPDX-License-Identifier: MIT
"""Poisson-disk points one after the other, in any dimension: Bridson's algorithm.

Candidates lie around a random point of the pool, at distances from r to 2 r, uniformly in this
shell or on its inner surface. The first candidate that is r or more from all points becomes a
point and joins the pool. A point whose candidates all fail leaves the pool. When the pool is empty,
candidates lie anywhere in the box; if they fail, too, the set is full, except for small gaps.

Cost     O(log n) for each candidate in few dimensions.
Promise  distances are r or more; the points do not depend on how many are drawn at once.
Source   R. Bridson, SIGGRAPH 2007, doi:10.1145/1278780.1278807.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.spatial import KDTree  # type: ignore[import]
from scipy.spatial.distance import cdist  # type: ignore[import]

Rows = npt.NDArray[np.float64]


class Bridson:
    def __init__(self, box: tuple[Rows, Rows], radius: float, surface: bool, candidates: int,
                 seed: int) -> None:
        self._low, self._high = box
        self._radius, self._surface, self._candidates = radius, surface, candidates
        self._random = np.random.default_rng(seed)
        self._pool: list[Rows] = []
        self._tree: KDTree | None = None
        self._recent: list[Rows] = []  # points that the tree does not have
        self._full = False

    def draw(self, n: float) -> Rows:
        """The next n points, or as many as there are."""
        points: list[Rows] = []
        while len(points) < n and not self._full:
            point = self._next()
            if point is None:
                self._full = True
            else:
                points.append(point)
        return np.array(points).reshape(-1, len(self._low))

    def _next(self) -> Rows | None:
        while self._pool:
            k = int(self._random.integers(len(self._pool)))
            point = self._first_free(self._around(self._pool[k]))
            if point is not None:
                return point
            self._pool[k] = self._pool[-1]
            self._pool.pop()
        return self._first_free(self._random.uniform(self._low, self._high, (4096, len(self._low))))

    def _around(self, point: Rows) -> Rows:
        d = len(point)
        steps = self._random.standard_normal((self._candidates, d))
        shell = 1 + (2.0**d - 1) * self._random.random(self._candidates)
        length = np.full(len(shell), 1 + 1e-9) if self._surface else shell ** (1 / d)
        around = point + steps * (self._radius * length / np.linalg.norm(steps, axis=1))[:, None]
        inside: Rows = around[((self._low <= around) & (around < self._high)).all(axis=1)]
        return inside

    def _first_free(self, candidates: Rows) -> Rows | None:
        """Makes the first candidate with enough room a point; None if there is none."""
        free = np.ones(len(candidates), dtype=bool)
        if self._tree is not None and len(candidates) > 0:
            nearest = self._tree.query(candidates, distance_upper_bound=self._radius)[0]
            free &= nearest >= self._radius
        if self._recent:
            free &= (cdist(candidates, self._recent) >= self._radius).all(axis=1)
        if not free.any():
            return None
        point: Rows = candidates[np.argmax(free)]
        self._pool.append(point)
        self._recent.append(point)
        old = 0 if self._tree is None else self._tree.n
        if len(self._recent) > max(100, math.isqrt(64 * old)):
            before = [] if self._tree is None else [self._tree.data]
            self._tree, self._recent = KDTree(np.concatenate([*before, self._recent])), []
        return point
