// SPDX-License-Identifier: MIT
//
// Options for the distances between a set's points: straight, or in their box with opposite faces
// joined (torus); Euclidean, or in another norm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/domain.hpp"
#include "core/options.hpp"
#include "core/point_set.hpp"
#include "math/neighbors/kd_tree.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

inline constexpr Param<Choice> metric{
    .name = "metric",
    .choices = "torus|euclidean",
    .help =
        "torus: distances wrap across opposite faces of the points' unit cube or box; euclidean: "
        "straight distances; default: torus, and euclidean on domains without faces"};

/// The option --metric for analyzers that also support other norms.
inline constexpr Param<Choice> metric_of_any_norm{
    .name = "metric",
    .choices = "torus|euclidean|manhattan|chebyshev|torus-manhattan|torus-chebyshev",
    .help =
        "torus: distances wrap across opposite faces of the points' unit cube or box; others are "
        "straight. Norm: Euclidean, the sum of the distances along the axes (manhattan), or the "
        "largest (chebyshev); default: torus, and euclidean on domains without faces"};

struct Distances {
    bool torus;
    std::optional<Box> box;  ///< contains all points; nullopt if no such box is known
    Norm norm = Norm::euclidean;

    /// Name as a value of the option --metric.
    [[nodiscard]] std::string name() const;

    /// Periods for a search tree; empty for straight distances.
    [[nodiscard]] std::vector<double> sides() const;
};

/// Resolves `asked` (the name of a metric, or empty) for the points.
/// @throws Error(usage) for a torus of a domain that is not a box
/// @throws Error(input) for points outside the domain, unless straight distances are requested, and
///         for points (or a box) whose squared distances overflow or underflow float64
Distances distances_of(const PointSet& points, const std::string& asked);

/// Like distances_of(), for analyzers that need a box. @throws Error(input) also if no box is known
Distances distances_in_box(const PointSet& points, const std::string& asked, const char* analyzer);

double shortest_side(const Box& box);

/// Mean distance (V / n)^(1/d) of n points in the box.
double mean_distance(const Box& box, double n);

bool all_equal(const PointSet& points);

/// Requires at least two distinct points. @throws Error(input)
void require_places(const PointSet& points, const char* analyzer);

/// Nearest other point of every point. A single point is its own neighbour on the torus, across the
/// shortest side; for straight distances its distance is infinite. @throws Error(limit, cancelled)
std::vector<Neighbor> nearest_neighbors(const PointSet& points, const Distances& distances,
                                        const RunContext& run);

/// Two points with the smallest distance; of several such pairs, the one with the lowest indices.
struct ClosestPair {
    std::size_t first;
    Neighbor second;
};

ClosestPair closest_pair(const std::vector<Neighbor>& neighbors);

}  // namespace stipple::analyzers
