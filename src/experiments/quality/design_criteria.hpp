// SPDX-License-Identifier: MIT
//
// Criteria for comparing designs of computer experiments, for points in the unit cube.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// A smallest or largest value, and the axes (from 0) at which it occurs.
struct AtAxes {
    double value = 0;
    std::vector<std::size_t> axes = {};
};

/// Criteria that are sums over all pairs of points.
struct PairCriteria {
    double phi_p = 0;
    double audze_eglais = 0;
    double maxpro = 0;
};

/// Smallest distance of two points, and the standard deviation divided by the mean of the distances
/// to the nearest neighbours.
struct Separation {
    double minimum = 0;
    double variation = 0;
};

Separation separation_of(const PointSet& points, const RunContext& run);

/// @param minimum the smallest distance; if it is 0, or if points share coordinates, criteria are
/// infinite
PairCriteria pair_criteria(const PointSet& points, double p, double minimum, const RunContext& run);

/// Largest absolute correlation of two coordinates, and root mean square of all correlations.
/// Constant coordinates are left out; nullopt if fewer than two others remain.
struct Correlation {
    AtAxes largest;
    double rms = 0;
};

std::optional<Correlation> correlation_of(const PointSet& points);

/// Smallest distance of two points in any projection to one axis.
AtAxes closest_on_axis(const PointSet& points);

/// Smallest distance of two points in any projection to two axes, in O(n log n) for each
/// projection.
AtAxes closest_on_plane(const PointSet& points, const RunContext& run);

}  // namespace stipple::analyzers
