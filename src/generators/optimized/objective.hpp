// SPDX-License-Identifier: MIT
//
// What sets are optimised for, as functions of their coordinates that have a gradient.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/point_set.hpp"
#include "math/discrepancy/box_grid.hpp"
#include "math/l2/kinds.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

class Objective {
  public:
    Objective() = default;
    Objective(const Objective&) = delete;
    Objective& operator=(const Objective&) = delete;
    virtual ~Objective() = default;

    /// The value of points with coordinates in [0, 1], and its gradient. Of a maximum it is the
    /// gradient of its soft maximum, in which what is below the value by a part 1 / sharpness of it
    /// counts less by a factor of e. A measure may learn from one call what it uses in the next.
    virtual double value(std::span<const double> rows, double sharpness, std::span<double> gradient,
                         const RunContext& run) = 0;

    /// The value for sure of points whose value() came last and was `known`, where that may miss the
    /// worst; the next one knows then what that is.
    virtual double certain_value(std::span<const double> /*rows*/, double known,
                                 const RunContext& /*run*/) {
        return known;
    }

    /// Steps that one value takes, of which one core does some 10^9 a second.
    [[nodiscard]] virtual double steps() const = 0;

    /// The value of a report for that of value(): a root of it, as a rule.
    [[nodiscard]] virtual double reported(double value) const { return value; }
};

/// The square of an L2 discrepancy, by all pairs of points.
std::unique_ptr<Objective> l2_objective(l2::Kind kind, const l2::AxisWeights& weights,
                                        std::size_t count, std::size_t dimension);

/// The star discrepancy in two or three dimensions, by all boxes.
std::unique_ptr<Objective> anchored_objective(const std::vector<double>& weights, std::size_t count,
                                              std::size_t dimension);

struct Bounds {
    double lower;
    double upper;
};

/// Of points in the unit cube: the largest discrepancy of a family of boxes, or the volume of the
/// largest without a point; both bounds the same unless that takes more than so many comparisons.
Bounds bounds_of(const PointSet& points, discrepancy::Family family, bool empty,
                 const RunContext& run, std::uint64_t work = std::uint64_t{1} << 37);

/// A discrepancy or, of empty boxes, the dispersion, by the boxes of a family that are near the worst.
std::unique_ptr<Objective> box_objective(discrepancy::Family family, bool empty,
                                         const std::vector<double>& weights, std::size_t count,
                                         std::size_t dimension);

}  // namespace stipple::optimized
