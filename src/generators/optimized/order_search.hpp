// SPDX-License-Identifier: MIT
//
// Search over the orders of n points of the plane for the least star discrepancy.
//
// Starts    the orders of (i, (i phi + s) mod 1), phi the golden section, and of golden lattices,
//           stretched and cut out at random. Descents begin at all starts, lowest level (n times
//           the discrepancy) first, then at random starts changed by some swaps.
// Descents  swaps of neighbours by x or by y that do not raise the level, about a third of them on
//           the critical cycle, until 20 n swaps in a row gain nothing. Swaps that keep the level
//           are essential.
// Kicks     the best descents, 32, then 16, 8 and 4, are disturbed by up to 20 swaps that raise the
//           level by up to a fifth. They descend again, and the result is kept if it is no higher.
//
// Cost      the budget, in steps (comparisons of a bound): 1 to 2.5 10^9 a second on one core.
// Promise   depends only on the count, the seed and the budget, not on the number of threads.
#pragma once

#include <cstdint>

#include "generators/optimized/objective.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// @throws Error(limit, cancelled)
optimized::OptimizedRows least_star_discrepancy(std::size_t n, std::uint64_t seed, double budget,
                                                const RunContext& run);

}  // namespace stipple
