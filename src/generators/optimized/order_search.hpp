// SPDX-License-Identifier: MIT
//
// A search over the orders of n points of the plane for the least star discrepancy.
//
// Starts    the orders of (i, i phi + s mod 1), phi the golden section, and of golden lattices turned
//           and cut out at random, solved; the best first, then any of them after some swaps.
// Descents  swaps of two neighbours by x or by y that do not raise the level, a third of them on the
//           critical cycle, until 20 n in a row gained nothing. Walking on a level is essential.
// Kicks     the best descents are disturbed by up to 20 swaps that raise the level by up to a fifth,
//           descend again, and are kept where they end no higher: 32 of them, then 16, 8, 4.
//
// Cost      the budget, in steps (comparisons of a bound): 1 to 2.5 10^9 a second on one core.
// Promise   a function of the count, the seed and the budget, for any number of threads.
#pragma once

#include <cstdint>
#include "generators/optimized/search_run.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// @throws Error(limit, cancelled)
optimized::OptimizedRows least_star_discrepancy(std::size_t n, std::uint64_t seed, double budget,
                                                const RunContext& run);

}  // namespace stipple
