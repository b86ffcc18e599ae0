// SPDX-License-Identifier: MIT
//
// The worst interval of points on a line: a maximum-subarray problem. A box with these points
// inside on all other axes, where its volume is h, has the excess h x length - w points. Let P_i
// and Q_i be that of the open interval from 0 to point i, without the points at and before i's own
// place in the line, and with them:
//
//     P_i = h x_i - w #{before i},      Q_i = P_i - w;
//
// then the open intervals between two points have P_j - Q_i, i < j, the closed ones P_i - Q_j, i <=
// j. On the circle, those that wrap have (h - w n) + P_i - Q_j, i <= j, and (w n - h) + P_j - Q_i,
// i < j: the same two maxima. So one pass with the highest P and the lowest Q so far finds the
// worst. Points at the same place only make some of these less than the truth, never more.
//
// Source  J. Bentley, "Programming pearls: algorithm design techniques", Comm. ACM 27 (1984)
//         865-873, doi:10.1145/358234.381162 (the pass, due to J. Kadane).
#pragma once

#include <cstddef>
#include <limits>

#include "math/discrepancy/box_grid.hpp"

namespace stipple::discrepancy {

/// One end of the line, in place of one of its points.
inline constexpr std::size_t line_end = std::numeric_limits<std::size_t>::max();

template <class Number>
struct WorstInterval {
    Number excess;
    std::size_t lower = line_end;
    std::size_t upper = line_end;
};

/// What is known of a line, in a type without rounding or in doubles.
template <class Number>
struct LineTerms {
    Number all;     ///< h
    Number weight;  ///< w
    Number points;  ///< w n
    Side side;
    bool torus;
};

/// The worst interval of the line of n points; height(i) = h x_i and before(i) = w times the number
/// of points before i.
template <class Number, class Height, class Before>
WorstInterval<Number> worst_interval(std::size_t n, const LineTerms<Number>& line,
                                     const Height& height, const Before& before) {
    const bool open = line.side == Side::open;
    const bool torus = line.torus;
    const Number around = open ? line.all - line.points : line.points - line.all;
    WorstInterval<Number> best{around};
    // On the circle, the whole is no worse than the best of the intervals cut at a point.
    if (torus && n > 0) best.excess = -(line.all + line.points);
    Number highest = 0;
    Number lowest = 0;  // of the beginning, where an open interval may start
    std::size_t at_highest = line_end;
    std::size_t at_lowest = line_end;
    const auto take = [&](Number excess, std::size_t lower, std::size_t upper) {
        if (excess > best.excess) best = {std::move(excess), lower, upper};
    };
    for (std::size_t i = 0; i < n; ++i) {
        const Number p = height(i) - before(i);
        const Number q = p - line.weight;
        if (open && (!torus || i > 0)) take(p - lowest, at_lowest, i);
        if (!open && torus && i > 0) take(around + (p - lowest), i, at_lowest);
        if (i == 0 || p > highest) {
            highest = p;
            at_highest = i;
        }
        if (!open) take(highest - q, at_highest, i);
        if (open && torus) take(around + (highest - q), i, at_highest);
        if (q < lowest || (i == 0 && (torus || !open))) {
            lowest = q;
            at_lowest = i;
        }
    }
    if (open && !torus) take((line.all - line.points) - lowest, at_lowest, line_end);
    return best;
}

}  // namespace stipple::discrepancy
