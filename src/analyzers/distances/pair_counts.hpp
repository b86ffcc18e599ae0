// SPDX-License-Identifier: MIT
//
// Counts of pairs of points by their distance, in bins of equal width.
//
// Shape    2 <= n < 2^32 points of a box, d = 1, 2, 3. A pair at distance t is in bin
//          floor(t / width), as float64 computes it.
// Cost     O(n + pairs nearby), about 1.3 candidates per pair; 16 d + 8 bytes per point.
// Promise  every pair counts once. The same for any number of threads, sums of offsets to the bit.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analyzers/distances/distances.hpp"
#include "core/domain.hpp"

namespace stipple::analyzers {

struct PairCounts {
    std::vector<std::uint64_t> pairs;  ///< number of pairs in each bin

    /// Sums over a bin's pairs of (distance - middle of the bin) / width, and of its square; empty
    /// unless requested.
    std::vector<double> offsets;
    std::vector<double> squared_offsets;
};

/// Counts pairs by distance in bins of the given width; ignores distances beyond the last bin.
/// @throws Error(limit, cancelled)
PairCounts count_pairs(const PointSet& points, const Distances& distances, double width,
                       std::size_t bins, bool with_offsets, const RunContext& run);

// Probability that two independent uniform points of a box are at most r apart:
//
//     p(r) = 1 / V^2 * integral over |x| <= r of c(x) dx,
//
// where c is the box's set covariance: prod_k (L_k - |x_k|) for straight distances; on the torus, V
// if all |x_k| <= L_k / 2, else 0. The edges are accounted for exactly: n points have on average
// n (n - 1) / 2 * p(r) pairs at most r apart.
//
// Shape   a box of 1, 2 or 3 dimensions and positive sides; r >= 0; p in [0, 1].
// Cost    closed forms in 1-D and 2-D, an integral over one angle in 3-D.
// Promise within 1e-15 in 1-D and 2-D, 1e-12 in 3-D.
// Source  S. N. Chiu, D. Stoyan, W. S. Kendall, J. Mecke, "Stochastic Geometry and its
//         Applications", 3rd ed., Wiley 2013, section 4.7 (edge correction by the set covariance).

double pair_probability(const Box& box, bool torus, double r);

/// 1 - p(r) within 1e-9 of its size (1e-12 if all sides are equal), for r near the longest distance,
/// where 1 minus the rounded p(r) has lost digits; nullopt for smaller r, and for d = 1.
std::optional<double> pair_probability_beyond(const Box& box, bool torus, double r);

/// Largest possible distance of two points of the box.
double longest_distance(const Box& box, bool torus);

}  // namespace stipple::analyzers
