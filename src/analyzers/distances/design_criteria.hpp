// SPDX-License-Identifier: MIT
//
// Criteria by which designs for computer experiments are compared, of points in the unit cube.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// A smallest or largest value, and the axes, from 0, where it is.
struct AtAxes {
    double value = 0;
    std::vector<std::size_t> axes = {};
};

/// Sums over all pairs of points.
struct PairCriteria {
    double phi_p = 0;
    double audze_eglais = 0;
    double maxpro = 0;
};

/// Smallest distance of two points, and the deviation of the distances to the nearest neighbours
/// over their mean.
struct Separation {
    double minimum = 0;
    double variation = 0;
};

Separation separation_of(const PointSet& points, const RunContext& run);

/// @param minimum the smallest distance; 0 and shared coordinates make criteria infinite
PairCriteria pair_criteria(const PointSet& points, double p, double minimum, const RunContext& run);

/// Largest absolute value of the correlations of two coordinates, and the root of their mean
/// square. Coordinates that are constant have none; nothing where fewer than two are left.
struct Correlation {
    AtAxes largest;
    double rms = 0;
};

std::optional<Correlation> correlation_of(const PointSet& points);

/// The least distance of two points among the projections to one axis.
AtAxes closest_on_axis(const PointSet& points);

/// The same to two axes; some n log n for each two of them.
AtAxes closest_on_plane(const PointSet& points, const RunContext& run);

}  // namespace stipple::analyzers
