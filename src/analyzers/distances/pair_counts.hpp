// SPDX-License-Identifier: MIT
//
// Pairs of points counted by their distance, in bins of one width.
//
// Shape    2 <= n < 2^32 points of a box, d = 1, 2, 3. A pair at distance t is in bin
//          floor(t / width), as float64 computes it.
// Cost     O(n + pairs nearby), about 1.3 candidates a pair; 16 d + 8 bytes a point.
// Promise  every pair counts once. The same for any number of threads, sums of offsets to the bit.
#pragma once

#include <cstdint>
#include <vector>

#include "analyzers/distances/distances.hpp"

namespace stipple::analyzers {

struct PairCounts {
    std::vector<std::uint64_t> pairs;  ///< of each bin

    /// Sums over a bin's pairs of (distance - its middle) / width, and of its square; empty unless
    /// they were asked for.
    std::vector<double> offsets;
    std::vector<double> squared_offsets;
};

/// @throws Error(limit, cancelled)
PairCounts count_pairs(const PointSet& points, const Distances& distances, double width,
                       std::size_t bins, bool with_offsets, const RunContext& run);

}  // namespace stipple::analyzers
