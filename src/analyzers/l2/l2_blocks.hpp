// SPDX-License-Identifier: MIT
//
// Blocks of points and what is known of two of them on an axis, for the factors of l2_lanes.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace stipple::analyzers::l2 {

constexpr std::size_t block_width = 64;  ///< points of a block
constexpr std::size_t spread = 8;        ///< lanes of the widest vector

// Where the parabolas stand on their vertices.
constexpr double corner_of_bend = 0.5;
constexpr double corner_of_mixture = 0.75;

/// Doubles in one line of the cache, so that no vector lies across two.
struct alignas(64) Line {
    double at[spread] = {};
};

/// What is the same for all points on an axis: base = a + shift, where a factor may come near 0.
struct AxisConstants {
    double base = 0;
    double shift = 0;
    double lost = 0;  ///< of base
};

/// How a block's points lie to those of the rows on the axis of a factor.
enum class Lie : std::uint8_t {
    mixed,
    below,  ///< rows first in the axis's order; of the centered kernel: all of both up to 1/2
    above,  ///< rows last; all from 1/2
    apart   ///< on either side of 1/2
};

/// Least and greatest places of a block's points in the order of a factor's axis.
struct Range {
    double least = 1;
    double greatest = -1;
};

/// For kernels in which it matters who comes first.
inline Lie lie_in_order(const Range& rows, const Range& columns) {
    if (rows.greatest <= columns.least) return Lie::below;
    return columns.greatest <= rows.least ? Lie::above : Lie::mixed;
}

/// For kernels in which it matters who is on which side of 1/2.
inline Lie lie_around(const Range& rows, const Range& columns) {
    if (std::max(rows.greatest, columns.greatest) <= 0.5) return Lie::below;
    if (std::min(rows.least, columns.least) >= 0.5) return Lie::above;
    const bool apart = std::min(rows.greatest, columns.greatest) <= 0.5 &&
                       std::max(rows.least, columns.least) >= 0.5;
    return apart ? Lie::apart : Lie::mixed;
}

/// How a product takes a factor.
enum class Factor {
    exact,     ///< without a correction
    carried,   ///< with one
    over_one,  ///< as what it is more than 1, exactly
};

/// A factor that is to be worked out for each pair of points.
struct Step {
    std::size_t factor;
    Lie lie;
};

/// Products of the factors that belong to a point alone, of a block's points, or 0 where there is
/// none.
struct Weights {
    alignas(64) double value[block_width];
    alignas(64) double lost[block_width];
};

struct Sums {
    double sum[spread] = {};
    double lost[spread] = {};
};

}  // namespace stipple::analyzers::l2
