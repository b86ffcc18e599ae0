// SPDX-License-Identifier: MIT
//
// The order in which void-and-cluster fills the cells of a W x H torus. The energy of a cell is
//
//     E(c) = sum over filled cells f of  exp(-|c - f|^2 / (2 sigma^2)),
//
// with toroidal distances in cells and sigma = 1.5. If cells are not square, lengths are in units
// of the square root of a cell's area.
//
// First a random tenth of the cells is filled. The filled cell with the highest energy ("tightest
// cluster") moves to the empty one with the lowest ("largest void") until it would move back.
// Removing tightest clusters one by one then gives the ranks below a tenth, in decreasing order;
// filling largest voids gives those above. Ulichney's third phase looks for clusters of empty cells
// once more than half are filled. It picks the same cells, because the energies of empty and filled
// cells have a constant sum.
//
// While cells are removed, sigma doubles each time their number has fallen to a quarter. With the
// fixed sigma of the paper the last cells would not interact, and so the first ranks would be
// random.
//
// Shape   W, H >= 1, W H < 2^31; sides of a cell from 1 : 100 to 100 : 1, or sums could overflow.
// Cost    O(1) per cell, about 6 microseconds, and 45 bytes.
// Promise energies are whole multiples of 2^-38, so they do not drift, and the order is the
//         same on every machine. Ties are broken at random.
// Source  R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913
//         (1993) 332-343, doi:10.1117/12.152707.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

inline constexpr double most_stretch = 100;

/// Cells (x + W y) with ranks 0, 1, ..., wanted - 1.
/// @param stretch width of a cell divided by its height, in [1 / most_stretch, most_stretch]
/// @throws Error(limit), Error(cancelled)
std::vector<std::uint32_t> void_and_cluster_order(std::size_t width, std::size_t height,
                                                  std::size_t wanted, std::uint64_t seed,
                                                  const RunContext& run, double stretch = 1);

}  // namespace stipple
