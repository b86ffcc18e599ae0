// SPDX-License-Identifier: MIT
//
// The order in which void-and-cluster fills the cells of a W x H torus. The energy of a cell is
//
//     E(c) = sum over filled cells f of  exp(-|c - f|^2 / (2 sigma^2)),
//
// by toroidal distances in cells, sigma = 1.5. Cells may be wider than high, or higher than wide:
// lengths are then in units of the root of a cell's area.
//
// A random tenth of the cells is filled, and its fullest cell ("tightest cluster") moves to the
// emptiest ("largest void") until it would move back. Ranks downwards from a tenth go to the
// fullest cells, one taken away after the other; ranks upwards to the emptiest, one filled after
// the other. Ulichney's third phase, which looks for clusters of what is empty once more than half
// is filled, picks the same cells, since the energies of empty and filled cells have a constant
// sum.
//
// Where cells are taken away, sigma doubles each time their number has fallen to a quarter: with
// the fixed sigma of the paper the last ones would feel nothing of each other, and so the first
// ranks would lie at random.
//
// Shape   W, H >= 1, W H < 2^31; cells of 1 : 100 to 100 : 1, beyond which sums could overflow.
// Cost    O(1) a cell, some 6 microseconds, and 45 bytes.
// Promise energies are whole numbers (multiples of 2^-38), so they do not drift, and the order is
//         the same on every machine; equal energies are told apart at random.
// Source  R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913
//         (1993) 332-343, doi:10.1117/12.152707.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

inline constexpr double most_stretch = 100;

/// Cells (x + W y) of ranks 0, 1, ..., wanted - 1.
/// @param stretch a cell's width over its height, in [1 / most_stretch, most_stretch]
/// @throws Error(limit), Error(cancelled)
std::vector<std::uint32_t> void_and_cluster_order(std::size_t width, std::size_t height,
                                                  std::size_t wanted, std::uint64_t seed,
                                                  const RunContext& run, double stretch = 1);

}  // namespace stipple
