// SPDX-License-Identifier: MIT
//
// Objectives of the search for optimized sets, which are functions of the coordinates with a
// gradient; and the result of a search.
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

struct OptimizedRows {
    std::vector<double> rows;
    double value = 0;
    /// True if a stop request ended the search early, in a run that keeps the best set.
    bool stopped = false;
    bool certain = true;  ///< whether `value` is exact; otherwise it may be too small
};

class Objective {
  public:
    Objective() = default;
    Objective(const Objective&) = delete;
    Objective& operator=(const Objective&) = delete;
    virtual ~Objective() = default;

    /// Returns the value at points with coordinates in [0, 1] and sets the gradient. For a maximum,
    /// this is the gradient of a soft maximum: a term that is smaller by the fraction 1 / sharpness
    /// of the value has a weight smaller by a factor of e. An objective may reuse results of
    /// earlier calls.
    virtual double value(std::span<const double> rows, double sharpness, std::span<double> gradient,
                         const RunContext& run) = 0;

    /// Value by a more thorough search, at the points of the last value() call, which returned
    /// `known` but may have missed the worst box. The next value() call reuses the box found.
    virtual double certain_value(std::span<const double> /*rows*/, double known,
                                 const RunContext& /*run*/) {
        return known;
    }

    /// Cost of one value in elementary steps; a core does about 10^9 per second.
    [[nodiscard]] virtual double steps() const = 0;

    /// Value for reports: the square root of `value` for L2 objectives, `value` itself for others.
    [[nodiscard]] virtual double reported(double value) const { return value; }
};

/// Squared L2 discrepancy, summed over all pairs of points.
std::unique_ptr<Objective> l2_objective(l2::Kind kind, const l2::AxisWeights& weights,
                                        std::size_t count, std::size_t dimension);

/// Returns the rows in an order in which every prefix has a small L2 discrepancy; the first `kept`
/// rows keep their positions. O(n^2 d).
std::vector<double> in_even_order(const std::vector<double>& rows, std::size_t dimension,
                                  std::size_t kept, l2::Kind kind, const l2::AxisWeights& weights,
                                  const RunContext& run);

/// Star discrepancy in two or three dimensions, over all boxes.
std::unique_ptr<Objective> anchored_objective(const std::vector<double>& weights, std::size_t count,
                                              std::size_t dimension);

/// Bytes that it needs per thread: counts of points in a plane of boxes, and the worst boxes.
double anchored_memory(std::size_t count, std::size_t dimension);

struct Bounds {
    double lower;
    double upper;
};

/// Bounds of the largest discrepancy of a family of boxes or, if `empty`, of the volume of the
/// largest empty box, for points in the unit cube. They are equal unless finding the worst box
/// takes more than `work` comparisons.
Bounds bounds_of(const PointSet& points, discrepancy::Family family, bool empty,
                 const RunContext& run, std::uint64_t work = std::uint64_t{1} << 37);

/// Discrepancy or, if `empty`, dispersion, over a pool of boxes near the worst of a family.
std::unique_ptr<Objective> box_objective(discrepancy::Family family, bool empty,
                                         const std::vector<double>& weights, std::size_t count,
                                         std::size_t dimension);

}  // namespace stipple::optimized
