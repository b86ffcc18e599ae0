// SPDX-License-Identifier: MIT
//
// How the distances between a set's points are measured: in the box that they live on with its
// opposite faces joined (torus), or straight; Euclidean, or in another norm.
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
        "Across opposite faces of the unit cube or box that the points live on, or straight; "
        "default: torus, and euclidean on domains without faces"};

/// The same for measures that make sense in other norms, too.
inline constexpr Param<Choice> metric_of_any_norm{
    .name = "metric",
    .choices = "torus|euclidean|manhattan|chebyshev|torus-manhattan|torus-chebyshev",
    .help =
        "Across opposite faces of the unit cube or box that the points live on (torus), or "
        "straight; Euclidean, the sum of the distances along the axes (manhattan), or the largest "
        "(chebyshev); default: torus, and euclidean on domains without faces"};

struct Distances {
    bool torus;
    std::optional<Box> box;  ///< where all points are; none if they are in no box that is known
    Norm norm = Norm::euclidean;

    /// As one asks for it.
    [[nodiscard]] std::string name() const;

    /// As a search tree takes them: none for straight distances.
    [[nodiscard]] std::vector<double> sides() const;
};

/// What `asked` (a metric's name, or nothing) means for the points.
/// @throws Error(usage) for a torus of what is no box
/// @throws Error(input) for points outside the domain, unless straight distances are asked for,
///         and for points (or their box) that float64 cannot hold the squared distances of
Distances distances_of(const PointSet& points, const std::string& asked);

/// The same for measures that need to know the box. @throws Error(input) as well without one
Distances distances_in_box(const PointSet& points, const std::string& asked, const char* analyzer);

double shortest_side(const Box& box);

/// Of so many points in the box: (V / n)^(1/d).
double mean_distance(const Box& box, std::size_t n);

/// Whether all points are at one place.
bool all_equal(const PointSet& points);

/// @throws Error(input) unless there are points at two places at least
void require_places(const PointSet& points, const char* analyzer);

/// Every point's nearest other one. A single point is its own neighbour on the torus, across the
/// shortest side; elsewhere it has none, at an infinite distance. @throws Error(limit, cancelled)
std::vector<Neighbor> nearest_neighbors(const PointSet& points, const Distances& distances,
                                        const RunContext& run);

/// Two points that have the smallest distance, those of lowest indices.
struct ClosestPair {
    std::size_t first;
    Neighbor second;
};

ClosestPair closest_pair(const std::vector<Neighbor>& neighbors);

}  // namespace stipple::analyzers
