// SPDX-License-Identifier: MIT
//
// Covering radius, or fill distance: the radius of the largest ball that contains no point, with
// its centre in the unit cube or box of the points:
//
//     radius = max over x of  min_i |x - x_i|.
//
// On the torus (the default) in 2-D it is the largest circumradius of a Delaunay triangle. With
// straight distances the centre may also be a corner of the domain, or a point where the boundary
// of a Voronoi cell meets a side of the domain (empty_ball.hpp).
//
//     mesh_ratio = radius / (minimum / 2),
//
// the covering radius divided by the packing radius, is smaller for more even points: at least 1,
// and at most 2 for a maximal Poisson-disk set. The report has no mesh_ratio if two points
// coincide, or for a single point with straight distances.
//
// Shape   points n x d, d <= 32.
// Cost    d <= 2: O(n log n) for sets that are not too uneven; 10^6 points in 2-D take 2.3 s on one
//         core. d >= 3: branch and bound; grows with the number of empty balls that are nearly as
//         large as the largest, and exponentially with d.
// Promise d <= 2: exact up to rounding. d >= 3: the radius is that of an empty ball, and no empty
//         ball is larger than `upper`, at most radius (1 + tolerance). Never depends on the number
//         of threads.
// Source  H. Niederreiter, "Random Number Generation and Quasi-Monte Carlo Methods", SIAM 1992,
//         chapter 6 (called dispersion there, also with the maximum norm).

#include <cmath>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "analyzers/distances/empty_ball.hpp"

namespace stipple::analyzers::coverage {
namespace {

constexpr Param<double> tolerance{
    .name = "tolerance",
    .fallback = 1e-6,
    .low = 1e-12,
    .high = 10,
    .help =
        "In 3 or more dimensions: largest relative excess of the upper bound over the lower one"};

constexpr Param<std::int64_t> max_boxes{
    .name = "max-boxes",
    .fallback = 100'000'000,
    .low = 1,
    .unit = "boxes",
    .help =
        "Give up once branch and bound (3 or more dimensions) has examined this many; 10^6 take "
        "about 10 seconds on one core"};

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Distances distances = distances_in_box(points, options[metric], "coverage");
    run.need_memory(
        static_cast<double>(points.count()) * (48 + 10 * static_cast<double>(points.dimension())),
        "the search for empty balls");
    const EmptyBall ball =
        largest_empty_ball(points, distances,
                           {.tolerance = options[tolerance],
                            .max_boxes = static_cast<std::uint64_t>(options[max_boxes])},
                           run.stage(0, 0.8));
    const auto neighbors = nearest_neighbors(points, distances, run.stage(0.8, 1));
    const double minimum = std::sqrt(closest_pair(neighbors).second.squared);
    Report results;
    results.add("radius", ball.radius);
    results.add("center", ball.center);
    results.add("lower", ball.radius);
    results.add("upper", ball.upper);
    results.add("exact", points.dimension() <= 2);
    if (minimum > 0 && std::isfinite(minimum)) results.add("mesh_ratio", 2 * ball.radius / minimum);
    results.add("metric", distances.name());
    return results;
}

/// Removes the ball's centre, which cannot be averaged.
void refine(Report& mean, std::size_t sets, const Values&) {
    if (sets > 1) drop(mean, {"center"});
}

}  // namespace

Analyzer unit() {
    return {.name = "coverage",
            .summary = "Covering radius: the largest empty ball, and where it is",
            .source = "Niederreiter 1992, chapter 6",
            .related = {"fill-distance", "minimax", "covering-radius", "mesh-norm"},
            .traits = {.max_dimension = 32, .unit_cube = false, .boxed = true},
            .options = Schema(metric, tolerance, max_boxes),
            .results = {lower({"radius", "radius of the largest ball without points"}),
                        {"center", "centre of that ball"},
                        {"lower", "radius of an empty ball that was found, a lower bound"},
                        {"upper", "upper bound of the radius of all empty balls"},
                        {"exact", "whether the two bounds are equal (up to 2 dimensions)", true,
                         true_or_false},
                        lower({"mesh_ratio",
                               "radius divided by half the smallest distance between two points"}),
                        {"metric", "torus or euclidean", true, "torus|euclidean"}},
            .analyze = analyze,
            .refine = refine};
}

}  // namespace stipple::analyzers::coverage
