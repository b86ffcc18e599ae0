// SPDX-License-Identifier: MIT
//
// Verifies that a set is a maximal Poisson-disk set of radius R:
//
//     spaced    |x_i - x_j| >= R for all pairs;
//     maximal   min_i |x - x_i| <= R for all places x of the unit cube or box.
//
// R is --radius; otherwise the radius that the points were made with, if their provenance has one;
// otherwise the smallest distance of the set, so that the set is spaced. Distances wrap across
// opposite faces unless --metric or the provenance (bounded) says otherwise. Sets made with a
// density, a map of radii or a mask are rejected without --radius.
//
// The largest empty ball decides whether the set is maximal (empty_ball.hpp). The last gaps that a
// generator should fill may be lost in rounding, so a largest empty ball with a radius of at most R
// (1 + tolerance) is accepted. Such a gap is tiny: the centre of a disk in it can move only by
// about the tolerance times R.
//
// Shape   points n x d, d <= 32.
// Cost    that of `coverage`; 10^6 points in 2-D take 3 s on one core. Counting conflicts takes
//         O(n^(2 - 1/d)) at worst.
// Promise spaced: exact, comparing sums of squares with R^2 in float64. maximal: for d <= 2 as
//         exact as coverage; for d >= 3 certain: boxes are divided until no box can contain the
//         centre of an empty ball larger than R (1 + tolerance), or such a ball is found. Never
//         depends on the number of threads.
// Beware  a single point has no conflict, even if the torus is narrower than R.
// Source  M. S. Ebeida et al., Computer Graphics Forum 31 (2012) 785-794,
//         doi:10.1111/j.1467-8659.2012.03059.x (maximal Poisson-disk sampling).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "analyzers/distances/empty_ball.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"

namespace stipple::analyzers::poisson_disk {
namespace {

constexpr Param<double> radius{.name = "radius",
                               .low = 0,
                               .low_open = true,
                               .optional = true,
                               .unit = "length",
                               .help =
                                   "Radius to verify: smallest distance between points, and "
                                   "largest distance from any place to the nearest point; default: "
                                   "that of the points' provenance, else their smallest distance"};

constexpr Param<double> tolerance{
    .name = "tolerance",
    .fallback = 1e-9,
    .low = 1e-12,
    .high = 1,
    .help = "A gap counts if its radius exceeds the set's by more than this fraction"};

constexpr Param<Choice> expect{
    .name = "expect",
    .choices = "valid",
    .help = "Fail (exit code 1) if points are too close or the set is not maximal"};

/// Value of a generator's option in the points' provenance; nullopt if unknown or after warps.
std::optional<std::string> option_of(const PointSet& points, std::string_view option) {
    if (!points.provenance.warps.empty()) return std::nullopt;
    for (const auto& [name, text] : points.provenance.options)
        if (name == option) return text;
    return std::nullopt;
}

std::string metric_of(const PointSet& points, const Values& options) {
    if (!options.given(metric) && option_of(points, "bounded") == "true") return "euclidean";
    return options[metric];
}

/// @throws Error(input) for sets whose radius varies or that leave out a part of the box
void require_one_radius(const PointSet& points) {
    for (const char* option : {"density", "radius-map", "mask"})
        if (const auto file = option_of(points, option); file && !file->empty())
            fail_with_hint(ErrorKind::input, "--radius R verifies one radius nevertheless",
                           "the points were made with --{}: {}", option,
                           std::string_view(option) == "mask" ? "a part of the box is excluded"
                                                              : "their radius varies");
}

/// The radius R to verify, for a set with this smallest squared distance.
double radius_of(const PointSet& points, const Values& options, double squared) {
    if (options.given(radius)) return options[radius];
    require_one_radius(points);
    if (const auto text = option_of(points, "radius"))
        if (const auto number = parse_number(*text); number && *number > 0) return *number;
    if (!std::isfinite(squared))
        fail(ErrorKind::usage,
             "--radius: a single point has no distance from which to take the radius; give one");
    const double root = std::sqrt(squared);
    return root * root <= squared ? root : std::nextafter(root, 0.0);
}

/// Number of pairs closer than R, and the indices of the first pair.
struct Conflicts {
    std::uint64_t count = 0;
    Report::Integers first = {};
};

/// Counts the pairs whose squared distance is below `squared`. The first pair is the one with the
/// lowest i and, for this i, the lowest j.
Conflicts find_conflicts(const PointSet& points, const Distances& distances,
                         const std::vector<Neighbor>& neighbors, double squared,
                         const RunContext& run) {
    const KdTree tree(points.flat(), points.dimension(), distances.sides(), run.stage(0, 0.2));
    constexpr std::uint64_t size = 64;
    std::vector<std::uint64_t> parts(block_count(points.count(), size));
    for_each_block(run.stage(0.2, 1), points.count(), size, [&](const Block& b) {
        for (std::uint64_t i = b.first; i < b.last; ++i)
            // The tree counts the point itself, too.
            parts[b.index] += tree.count_nearer(points[i], squared) - 1;
    });
    Conflicts found{.count = std::accumulate(parts.begin(), parts.end(), std::uint64_t{0}) / 2};
    const auto too_near = [&](const Neighbor& neighbor) { return neighbor.squared < squared; };
    const auto i =
        static_cast<std::size_t>(std::ranges::find_if(neighbors, too_near) - neighbors.begin());
    const KdTree itself(points[i], points.dimension(), distances.sides(), {});
    std::size_t j = i + 1;
    while (!too_near(itself.nearest(points[j]))) ++j;
    found.first = {static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)};
    return found;
}

/// Sentence on why the set is not a maximal Poisson-disk set of radius r.
std::string complaint(double r, const Conflicts& conflicts, const EmptyBall& ball, bool maximal) {
    std::vector<std::string> reasons;
    if (conflicts.count > 0)
        reasons.push_back(fmt::format("{} pairs are closer, the first is {}", conflicts.count,
                                      join(conflicts.first, ", ")));
    if (!maximal)
        reasons.push_back(fmt::format("({}) is {} from the nearest point", join(ball.center, ", "),
                                      format_number(ball.radius)));
    return fmt::format("the set is not a maximal Poisson-disk set of radius {}: {}",
                       format_number(r), join(reasons, "; "));
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Distances distances =
        distances_in_box(points, metric_of(points, options), "poisson-disk");
    const auto neighbors = nearest_neighbors(points, distances, run.stage(0, 0.2));
    const ClosestPair closest = closest_pair(neighbors);
    const double r = radius_of(points, options, closest.second.squared);
    Conflicts conflicts;
    if (points.count() > 1 && closest.second.squared < r * r)
        conflicts = find_conflicts(points, distances, neighbors, r * r, run.stage(0.2, 0.5));
    const double most = r * (1 + options[tolerance]);
    const EmptyBall ball =
        largest_empty_ball(points, distances, {.enough = most}, run.stage(0.5, 1));
    const bool maximal = ball.radius <= most;
    const bool valid = maximal && conflicts.count == 0;
    Report results;
    results.add("radius", r);
    if (std::isfinite(closest.second.squared))
        results.add("minimum", std::sqrt(closest.second.squared));
    results.add("coverage_radius", ball.radius);
    results.add("center", ball.center);
    results.add("conflicts", conflicts.count);
    results.add("first_conflict", conflicts.first);
    results.add("maximal", maximal);
    results.add("valid", valid);
    results.add("metric", distances.name());
    if (!valid && options.given(expect)) results.unmet(complaint(r, conflicts, ball, maximal));
    return results;
}

/// Removes positions and pairs, which cannot be averaged. The mean is valid if all sets are.
void refine(Report& mean, std::size_t sets, const Values& options) {
    const auto* item = mean.find("valid");
    const bool* valid = item ? std::get_if<bool>(item) : nullptr;
    if (options.given(expect) && !(valid && *valid))
        mean.unmet(fmt::format("of {} sets, not all are maximal Poisson-disk sets", sets));
    if (sets > 1) drop(mean, {"center", "first_conflict"});
}

}  // namespace

Analyzer unit() {
    return {
        .name = "poisson-disk",
        .summary = "Verifies that a set is a maximal Poisson-disk set of a radius",
        .source = "Ebeida et al. 2012, doi:10.1111/j.1467-8659.2012.03059.x",
        .related = {"maximality"},
        .traits = {.max_dimension = 32, .unit_cube = false, .boxed = true},
        .options = Schema(radius, metric, tolerance, expect),
        .results = {{"radius", "radius that was verified"},
                    {"minimum", "smallest distance between two points"},
                    {"coverage_radius",
                     "radius of the largest ball without points; in 3 or more dimensions, of the "
                     "largest found if none is too large"},
                    {"center", "centre of that ball"},
                    {"conflicts", "number of pairs of points closer than the radius"},
                    {"first_conflict", "first such pair (points from 0); empty if there is none"},
                    {"maximal", "whether every place is within the radius of a point", true,
                     true_or_false},
                    {"valid", "whether the set is maximal and has no conflicts", true,
                     true_or_false},
                    {"metric", "torus or euclidean", true, "torus|euclidean"}},
        .analyze = analyze,
        .refine = refine};
}

}  // namespace stipple::analyzers::poisson_disk
