// SPDX-License-Identifier: MIT
//
// Distance of each point to the nearest other one:
//
//     d_i = min over j != i of |x_i - x_j|;      minimum, mean, maximum and deviation over i.
//
// Distances are Euclidean, or in the Manhattan or Chebyshev norm.
//
// On the torus (the default on the unit cube and on boxes) distances wrap across opposite faces.
// The relative radius compares the minimum with the smallest distance of the densest packing of n
// points in the domain's volume V,
//
//     relative_radius = minimum / (2 (delta V / n)^(1/d)),
//
// where delta is the centre density (balls of radius 1 per volume) of the densest lattice, d <= 8:
// 1/2, 1/(2 sqrt 3), 1/(4 sqrt 2), 1/8, 1/(8 sqrt 2), 1/(8 sqrt 3), 1/16, 1/16. In 2-D that is
// minimum / sqrt(2 V / (sqrt 3 n)), as in the literature on blue noise. No set is denser for d = 1,
// 2, 3 and 8, so the ratio is at most 1 on the torus; for d = 4 to 7 no denser set is known. The
// ratio is left out for d > 8, for points without a box, and in other norms. On the torus a point
// is also a neighbour of its own copies: a minimum above the shortest side counts as that side.
//
// Shape   n >= 2 points of any dimension. A duplicate has distance 0.
// Cost    O(n log n) for few dimensions; on one core 10^6 even points take 0.3 s in 2-D, 0.6 s in
//         3-D; clustered points in 2-D, which a grid does not fit, 1 s.
// Promise exact: distances are the roots of sums of squares in float64, the same as by comparing
//         all pairs. The pair is the one of lowest indices with the smallest distance.
//         Never depends on the number of threads.
// Beware  straight distances have no wrap: near the faces neighbours are missing.
// Source  J. H. Conway, N. J. A. Sloane, "Sphere Packings, Lattices and Groups", 3rd ed., 1999,
//         table 1.2 (centre densities). A. Lagae, P. Dutre, Computer Graphics Forum 27 (2008)
//         114-129, doi:10.1111/j.1467-8659.2007.01100.x (relative radius).

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::analyzers::nearest_neighbor {
namespace {

/// Squares of the reciprocal centre densities for d = 1 to 8.
constexpr std::array<double, 8> packing = {4, 12, 32, 64, 128, 192, 256, 256};

/// Smallest distance of the densest known packing of n points in the box.
double packing_distance(const Box& box, double n) {
    return 2 * mean_distance(box, n * std::sqrt(packing[box.dimension() - 1]));
}

/// Smallest distance of two points or, on the torus, of a point and its copy.
double smallest(double minimum, const Distances& distances) {
    return distances.torus ? std::min(minimum, shortest_side(*distances.box)) : minimum;
}

/// Sum of term(distance) over points, block by block.
template <class Term>
double sum_up(const std::vector<Neighbor>& neighbors, const RunContext& run, const Term& term) {
    constexpr std::uint64_t size = 65536;
    std::vector<double> parts(block_count(neighbors.size(), size));
    for_each_block(silent(run), neighbors.size(), size, [&](const Block& b) {
        double sum = 0;
        for (std::uint64_t i = b.first; i < b.last; ++i)
            sum += term(std::sqrt(neighbors[i].squared));
        parts[b.index] = sum;
    });
    return std::accumulate(parts.begin(), parts.end(), 0.0);
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Distances distances = distances_of(points, options[metric_of_any_norm]);
    if (points.count() == 1)
        fail(ErrorKind::input, "nearest-neighbor needs at least two points; this is one");
    const auto neighbors = nearest_neighbors(points, distances, run);
    const ClosestPair closest = closest_pair(neighbors);
    const auto n = static_cast<double>(points.count());
    const double mean = sum_up(neighbors, run, [](double distance) { return distance; }) / n;
    const double deviations =
        sum_up(neighbors, run, [&](double d) { return (d - mean) * (d - mean); });
    const double minimum = std::sqrt(closest.second.squared);
    Report results;
    results.add("minimum", minimum);
    results.add("mean", mean);
    results.add("maximum", std::sqrt(std::ranges::max(neighbors, {}, &Neighbor::squared).squared));
    results.add("standard_deviation", std::sqrt(deviations / n));
    if (distances.box && distances.norm == Norm::euclidean && points.dimension() <= packing.size())
        results.add("relative_radius",
                    smallest(minimum, distances) / packing_distance(*distances.box, n));
    results.add("pair", Report::Integers{static_cast<std::int64_t>(closest.first),
                                         static_cast<std::int64_t>(closest.second.index)});
    results.add("duplicates", std::int64_t{std::ranges::count(neighbors, 0.0, &Neighbor::squared)});
    results.add("metric", distances.name());
    return results;
}

/// Removes the pair, which cannot be averaged.
void refine(Report& mean, std::size_t sets, const Values&) {
    if (sets > 1) drop(mean, {"pair"});
}

}  // namespace

Analyzer unit() {
    return {
        .name = "nearest-neighbor",
        .summary = "Distances to the nearest other point: minimum, mean, relative radius",
        .source = "Lagae, Dutre 2008, doi:10.1111/j.1467-8659.2007.01100.x (relative radius)",
        .related = {"minimum-distance", "mindist", "maximin", "separation", "closest-pair",
                    "distances"},
        .traits = {.unit_cube = false},
        .options = Schema(metric_of_any_norm),
        .results = {higher({"minimum", "smallest distance between two points"}),
                    higher({"mean", "mean distance to the nearest neighbour"}),
                    {"maximum", "largest distance to a nearest neighbour"},
                    {"standard_deviation",
                     "standard deviation of these distances, over all n points"},
                    {.key = "relative_radius",
                     .help = "minimum divided by that of the densest known packing (hexagonal in "
                             "2-D); absent above 8 dimensions and for other norms",
                     .better = Better::higher,
                     .any_count = true},
                    {"pair", "two points (from 0) with the smallest distance"},
                    {.key = "duplicates",
                     .help = "number of points at the same place as another",
                     .better = Better::lower,
                     .any_count = true},
                    {"metric",
                     "torus, euclidean, manhattan, chebyshev, torus-manhattan or torus-chebyshev",
                     true, metric_of_any_norm.choices}},
        .part = PagePart::distances,
        .page = {{"Nearest neighbours",
                  {{"minimum", "Smallest distance"},
                   {"mean", "Mean nearest distance"},
                   {"relative_radius", "Relative radius"},
                   {"duplicates", "Duplicates"}}}},
        .pairs = {.above = 8, .steps = 5},
        .analyze = analyze,
        .refine = refine};
}

}  // namespace stipple::analyzers::nearest_neighbor
