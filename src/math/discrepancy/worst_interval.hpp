// SPDX-License-Identifier: MIT
//
// The worst interval of points on a line: a maximum-subarray problem. Consider boxes that contain
// all points of the line on the other axes. Let w be the weight of a point, and h the product of
// the box's sides on these axes times the scale of box_grid.hpp. With # points inside, the excess
// is h * length - w # if the box is open, and the negative of this if it is closed. Let P_i and Q_i
// be h * length - w # of the interval from 0 to point i, without and with the point itself:
//
//     P_i = h x_i - w #{before i},      Q_i = P_i - w;
//
// Then open intervals between two points have the excess P_j - Q_i, i < j, and closed ones P_i -
// Q_j, i <= j. On the circle, intervals that wrap have (h - w n) + P_i - Q_j, i <= j, if open, and
// (w n - h) + P_j - Q_i, i < j, if closed: the same two maxima. So one pass with the highest P and
// the lowest Q so far finds the worst interval. Points with equal coordinates can only make some
// excesses too small, never too large.
//
// Source  J. Bentley, "Programming pearls: algorithm design techniques", Comm. ACM 27 (1984)
//         865-873, doi:10.1145/358234.381162 (the pass, due to J. Kadane).
#pragma once

#include <cstddef>
#include <limits>

#include "math/discrepancy/box_grid.hpp"

namespace stipple::discrepancy {

/// Replaces the index of a point if an interval extends to an end of the line.
inline constexpr std::size_t line_end = std::numeric_limits<std::size_t>::max();

template <class Number>
struct WorstInterval {
    Number excess;
    std::size_t lower = line_end;
    std::size_t upper = line_end;
};

/// Parameters of a line, in doubles or in a type without rounding.
template <class Number>
struct LineTerms {
    Number all;     ///< h
    Number weight;  ///< w
    Number points;  ///< w n
    Side side;
    bool torus;
};

/// Worst interval of a line of n points, with height(i) = h x_i and before(i) = w #{before i}.
template <class Number, class Height, class Before>
WorstInterval<Number> worst_interval(std::size_t n, const LineTerms<Number>& line,
                                     const Height& height, const Before& before) {
    const bool open = line.side == Side::open;
    const bool torus = line.torus;
    const Number around = open ? line.all - line.points : line.points - line.all;
    WorstInterval<Number> best{around};
    // The circle cut at a point is at least as bad as uncut, which counts only without points.
    if (torus && n > 0) best.excess = -(line.all + line.points);
    Number highest = 0;
    Number lowest = 0;  // Q at the line's start, at which an open interval may begin
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
