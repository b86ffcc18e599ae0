// SPDX-License-Identifier: MIT
//
// Extreme and periodic discrepancy of n points in the unit cube:
//
//     extreme    sup over boxes [a,b) in [0,1]^d      of  | #{points in the box} / n  -  volume |,
//     periodic   the same on the torus, where 1 is 0 and each side of a box may wrap.
//
// Closed boxes count as limits of half-open ones, points on 1 included, as for the star
// discrepancy D*: so D* <= extreme <= 2^d D*, and extreme <= periodic. In one dimension, both are
// Kuiper's statistic.
//
// Shape   points n x d in [0, 1];  result in [1/n, 1].
// Cost    d = 1: O(n log n). d >= 2: branch and bound over cells of boxes. In 2-D O(n^2) cells at
//         worst, of a few points each. On one core 1024 points take 0.1 s (random) to 0.4 s
//         (Hammersley), 4096 points 0.5 s to 9 s; the periodic kind of even points takes ten times
//         as long. d > 2: up to n^(2(d - 1)) cells; 1000 random points in 3-D take 10 s, 128 in 5-D
//         5 s. It stops at --max-work or --time-limit, with bounds that hold; a first one of many
//         points in few dimensions is 2^d D* (periodic: (3^d - 1) D*).
// Promise exact: counts are integers, boxes are compared without rounding, and the value is the
//         double nearest to that of the box. Never depends on the number of threads.
// Source  W. J. Morokoff, R. E. Caflisch, SIAM J. Sci. Comput. 15 (1994) 1251-1279,
//         doi:10.1137/0915077 (the measures); N. H. Kuiper, Indag. Math. 22 (1960) 38-47.
#pragma once

#include "analyzers/discrepancy/extreme/extreme_box.hpp"
#include "analyzers/discrepancy/search_limits.hpp"
#include "core/options.hpp"
#include "core/report.hpp"

namespace stipple::analyzers::extreme {

inline constexpr Param<Choice> kind{
    .name = "kind",
    .fallback = "star",
    .choices = "star|extreme|periodic",
    .help =
        "Boxes from the origin, all axis-parallel boxes, or those of the torus, which may wrap"};

/// Value, bounds and worst box, as star-discrepancy reports them; the box's lower corner, too.
struct Findings {
    Report report;
    Bounds bounds;
};

Findings discrepancy(const PointSet& points, Space space, const SearchLimits& limits,
                     const RunContext& run);

/// No box of two and more dimensions has a larger discrepancy; found in milliseconds, or some more
/// of many points. Goes on when a stop is requested.
double quick_bound(const PointSet& points, Space space, const RunContext& run);

/// Bytes that a search with so many threads takes, the grid included.
double search_memory(const PointSet& points, unsigned threads);

}  // namespace stipple::analyzers::extreme
