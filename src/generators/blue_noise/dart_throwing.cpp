// SPDX-License-Identifier: MIT
//
// Dart throwing: uniform random points of the box, one after the other, except those that are
// nearer than the radius to an earlier one.
//
// --radius R  the radius is fixed; the set ends when --misses darts in a row were rejected. If
//             --count is given, too, the set has exactly that many points, or the run fails.
// --count N   the radius shrinks: it starts at the largest distance in the box and is multiplied by
//             --shrink after every --misses darts in a row that were rejected. The first i points
//             keep the radius at which point i was placed, so that every prefix is well spread.
// --density   in the plane, darts follow the density. The radius is r at the largest density,
//             and r(x) = r sqrt(largest density / density(x)) elsewhere. The distance of two points
//             is at least the smaller of their radii.
//
// Shape   d = 1, ..., 6; distances are those in the box of --bounds, across its faces (torus) or
//         bounded.
// Cost    up to about --misses darts a point while the radius shrinks; 5 us a point in 2-D by
//         default, 12 us with a density. Memory in 2-D: 60 bytes a point, 120 with a density.
// Promise sum_k d_k^2 >= radius^2 for every pair, in float64, from the coordinates as stored;
//         d_k = |x_k - y_k|, on the torus min(d_k, side_k - d_k). The provenance has the radius,
//         the last one if it shrinks. Point i does not depend on the number of points.
// Beware  not maximal: after K rejected darts in a row, about one dart in K would still fit.
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927 (darts);
//         M. McCool, E. Fiume, Graphics Interface (1992) 94-105 (relaxing radius).

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "core/text.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "generators/varied_index.hpp"
#include "math/combinatorics/draws.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::generators::dart_throwing {
namespace {

constexpr Param<double> radius{.name = "radius",
                               .low = 0,
                               .low_open = true,
                               .optional = true,
                               .unit = "length",
                               .help =
                                   "Fixed minimum distance between points; without it, the "
                                   "distance shrinks until --count points are placed"};
constexpr Param<std::int64_t> misses{
    .name = "misses",
    .fallback = 200,
    .low = 1,
    .high = 1'000'000'000,
    .unit = "darts",
    .help = "Number of rejected darts in a row that ends the set, or shrinks the radius"};
constexpr Param<double> shrink{.name = "shrink",
                               .fallback = 0.99,
                               .low = 0.01,
                               .high = 0.999999,
                               .help = "Factor by which the radius shrinks"};

Plan plan(const Request& request, const Values& options) {
    Plan plan = plan_in_box(request, options);
    check_density(options, plan.dimension);
    if (!options.given(radius)) return plan;
    const double most = space_of(plan, !options[bounded_option]).largest_distance();
    if (!(options[radius] <= most))
        fail(ErrorKind::usage,
             "--radius: {} is outside (0, {}]; no two points of the box are farther apart",
             format_number(options[radius]), format_number(most));
    if (options.given(shrink))
        fail(ErrorKind::usage,
             "--shrink contradicts --radius, which fixes the radius; give one of them");
    if (!request.count) plan.count = 0;
    return plan;
}

/// Darts uniform in a box, with one radius for all.
template <std::size_t D>
class EvenDarts {
  public:
    EvenDarts(const BoxSpace& space, std::uint64_t seed)
        : space_(space), draw_(Rng(seed)), points_(space.box, space.torus) {}

    /// Adds a dart if it is far enough from the others; returns whether it was added.
    bool add(double r) {
        std::array<double, D> p;
        draw_.point(space_.box, p.data());
        if (points_.any_nearer(p.data(), r)) return false;
        points_.add(p.data());
        return true;
    }

    [[nodiscard]] std::size_t count() const { return points_.count(); }
    [[nodiscard]] const std::vector<double>& rows() const { return points_.rows(); }

  private:
    const BoxSpace& space_;
    DrawStream draw_;
    GrowingPoints<D> points_;
};

/// Darts that follow a density, with a radius of r at its maximum and larger radii elsewhere.
class DenseDarts {
  public:
    DenseDarts(const BoxSpace& space, const DensityMap& map, std::uint64_t seed)
        : space_(space), map_(map), least_(std::sqrt(map.largest())), draw_(Rng(seed)) {}

    bool add(double r) {
        Disk dart;
        draw_.point(space_.box, dart.at.data());
        const double times = least_ * follow(map_, space_.box, dart.at.data());
        dart.radius = r * times;
        if (!disks_ || r < indexed_ / 2) index(r);
        if (near(dart, r)) return false;
        disks_->add({dart.at, indexed_ * times});
        rows_.insert(rows_.end(), dart.at.begin(), dart.at.end());
        times_.push_back(times);
        return true;
    }

    [[nodiscard]] std::size_t count() const { return times_.size(); }
    [[nodiscard]] const std::vector<double>& rows() const { return rows_; }

    static constexpr double memory(double points) { return 120 * points; }

  private:
    /// Indexes the points with their radii for this r; while r shrinks, these are upper bounds.
    void index(double r) {
        indexed_ = r;
        disks_.emplace(space_, r, times_.size());
        for (std::size_t i = 0; i < times_.size(); ++i)
            disks_->add({{rows_[2 * i], rows_[2 * i + 1]}, r * times_[i]});
    }

    [[nodiscard]] bool near(const Disk& dart, double r) const {
        constexpr double rounded = 1 + 0x1p-50;
        const double share = r == indexed_ ? 1 : r / indexed_ * rounded;
        return disks_->any_near(dart.at, dart.at, dart.radius, [&](const Disk& other) {
            return disks_->too_near(dart, {other.at, other.radius * share});
        });
    }

    const BoxSpace& space_;
    const DensityMap& map_;
    double least_;
    DrawStream draw_;
    std::vector<double> rows_;
    std::vector<double> times_;  ///< radius of each point as a multiple of r
    std::optional<VariedIndex> disks_;
    double indexed_ = 0;  ///< value of r for which the index was made
};

/// @throws Error(limit) if the points exceed the memory limit or 32-bit indices
void check_size(double points, double memory, const RunContext& run) {
    const std::string what = fmt::format("{:.4g} points", points);
    run.need_memory(memory, what);
    if (points >= 0xffff'fff0) fail(ErrorKind::limit, "{} are more than 2^32", what);
}

/// Throws darts until there are enough points or, if the radius is fixed, until --misses darts in a
/// row were rejected. Returns the points and their radius; `expected` is their approximate number.
template <class Darts>
std::pair<std::vector<double>, double> throw_all(Darts darts, const BoxSpace& space,
                                                 const Plan& plan, const Values& options,
                                                 double expected, const RunContext& run) {
    const std::uint64_t wanted = plan.count ? plan.start + plan.count : 0;
    const auto total = static_cast<std::uint64_t>(expected);
    const std::int64_t patience = options[misses];
    const bool stays = options.given(radius);
    double r = stays ? options[radius] : space.largest_distance();
    std::int64_t missed = 0;  // number of darts rejected in a row
    for (std::uint64_t thrown = 1; wanted == 0 || darts.count() < wanted; ++thrown) {
        if (thrown % 4096 == 0) run.tick(std::min<std::uint64_t>(darts.count(), total), total);
        missed = darts.add(r) ? 0 : missed + 1;
        if (missed < patience) continue;
        if (stays) break;
        r *= options[shrink];
        space.check_resolution(r, "a radius");
        missed = 0;
    }
    if (darts.count() < wanted || darts.count() <= plan.start)
        fail(ErrorKind::limit,
             "only {} points were placed with a radius of {} before {} darts in a row were "
             "rejected; {} were requested",
             darts.count(), format_number(r), patience, std::max(wanted, plan.start + 1));
    return {darts.rows(), r};
}

template <std::size_t D>
PointSet make_in(const Plan& plan, const Values& options, const RunContext& run) {
    const BoxSpace space = space_of(plan, !options[bounded_option]);
    const auto map = given_density(options, run);
    const double expected = plan.count
                                ? static_cast<double>(plan.start + plan.count)
                                : space.expected_points(saturated_density[D], options[radius]) /
                                      (map ? map->largest() : 1);
    check_size(expected, map ? DenseDarts::memory(expected) : GrowingPoints<D>::memory(expected),
               run);
    auto [rows, r] =
        map ? throw_all(DenseDarts(space, *map, plan.seed), space, plan, options, expected, run)
            : throw_all(EvenDarts<D>(space, plan.seed), space, plan, options, expected, run);
    run.tick(1, 1);
    PointSet points = set_in_box(std::move(rows), plan);
    auto& notes = points.provenance.options;
    notes = {{"radius", format_number(r)}, {"misses", std::to_string(options[misses])}};
    if (!options.given(radius)) notes.emplace_back("shrink", format_number(options[shrink]));
    notes.emplace_back(space.torus ? "torus" : "bounded", "true");
    note_density(options, points);
    return points;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    return with_dimension<most_directions>(
        plan.dimension, [&]<std::size_t D>() { return make_in<D>(plan, options, run.rising()); });
}

}  // namespace

Generator unit() {
    return {.name = "dart-throwing",
            .summary = "Random points with a minimum distance, which shrinks until all are placed",
            .source = "McCool, Fiume 1992, Graphics Interface, 94-105",
            .related = {"hard-disks", "random-sequential-addition", "matern"},
            .traits = {.max_dimension = most_directions, .sequence = false, .boxed = true},
            .options = Schema(radius, misses, shrink, density_option, invert_option, torus_option,
                              bounded_option),
            .aliases = {"darts", "relaxation-dart-throwing"},
            .plan = plan,
            .set = make};
}

}  // namespace stipple::generators::dart_throwing
