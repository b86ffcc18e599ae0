// SPDX-License-Identifier: MIT
//
// The lattice of n points with the largest minimum distance on a torus, a rectangle whose opposite
// sides are joined.
//
// The lattice is L / n, where L is a lattice of integer vectors with determinant n. The shortest
// vector u of L has |u|^2 <= 2 n / sqrt(3), with equality only for the hexagonal lattice. Vectors u
// are tried from the longest down. The second basis vector v solves u x v = n, with its component
// along u as close as possible to half of u. The first u with |v| >= |u| is the best. On a
// rectangle with sides in the ratio r, |(x, y)|^2 is r x^2 + y^2 / r.
//
// Shape   n in [1, 2^40].
// Cost    O(sqrt(n) log n); 0.2 s at 2^40.
// Promise no lattice has a larger minimum distance; on a rectangle, up to a relative 1e-12. Of
//         equally good lattices, always the same one.
#pragma once

#include <cstdint>

namespace stipple {

/// Points ((k shift + j n / row_points) mod n, k row_points) / n for k < n / row_points,
/// j < row_points; shift < n / row_points.
struct TorusPacking {
    std::uint64_t row_points;  ///< number of points on each row y = k row_points / n
    std::uint64_t shift;
    std::uint64_t shortest;  ///< |u|^2: the minimum distance is its root over n
};

TorusPacking densest_torus_packing(std::uint64_t n);

/// Packing on a rectangle: x is in units of its width, y in those of its height; `shortest` is 0.
/// @param ratio width divided by height, in [1e-3, 1e3]
TorusPacking densest_torus_packing(std::uint64_t n, double ratio);

}  // namespace stipple
