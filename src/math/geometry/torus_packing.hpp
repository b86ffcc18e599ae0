// SPDX-License-Identifier: MIT
//
// The lattice of n points on a torus, a rectangle whose opposite sides are joined, whose points keep
// farthest from each other.
//
// Such a lattice is L / n, L a lattice of whole-number vectors with determinant n. Of its shortest
// vector u, |u|^2 <= 2 n / sqrt(3), with equality for the hexagonal one alone. Vectors u are tried
// from the longest down; a second basis vector v solves u x v = n, and is as near as can be to half
// of u along it. The first u than which v is not shorter is the best there is. On a rectangle of
// sides in the ratio r, |(x, y)|^2 is r x^2 + y^2 / r.
//
// Shape   n in [1, 2^40].
// Cost    O(sqrt(n) log n); 0.2 s at 2^40.
// Promise no lattice has a larger smallest distance, on a rectangle up to 1e-12 of it. Of those that are as good, always the same.
#pragma once

#include <cstdint>

namespace stipple {

/// Points ((k shift + j n / row_points) mod n, k row_points) / n for k < n / row_points,
/// j < row_points; shift < n / row_points.
struct TorusPacking {
    std::uint64_t row_points;  ///< on each of the rows y = k row_points / n
    std::uint64_t shift;
    std::uint64_t shortest;  ///< |u|^2: the smallest distance is its root over n
};

TorusPacking densest_torus_packing(std::uint64_t n);

/// The same on a rectangle: x is in units of its width, y in those of its height; `shortest` is 0.
/// @param ratio of the width to the height, from 1e-3 to 1e3
TorusPacking densest_torus_packing(std::uint64_t n, double ratio);

}  // namespace stipple
