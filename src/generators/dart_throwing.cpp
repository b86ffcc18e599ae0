// SPDX-License-Identifier: MIT
//
// Dart throwing: points uniform in the box, one after the other; one that is nearer than the radius
// to an earlier one is thrown away.
//
// --radius R  the radius stays; the set is as large as it is when --misses darts in a row were
//             thrown away. With --count too, exactly so many points, or none.
// --count N   the radius relaxes: it starts as the largest distance of the box, and after --misses
//             darts in a row without a place it is multiplied by --shrink. The first i points keep
//             the radius at which point i was placed, so that every prefix is well spread.
//
// Shape   d = 1, ..., 6; distances hold in the box of --bounds, across its faces too (torus) or
// not. Cost    about --misses darts a point while the radius relaxes, fewer in tight places;
//         5 us a point in 2-D by default. 60 bytes a point in 2-D.
// Promise sum_k d_k^2 >= radius^2 for every pair, in float64, from the coordinates as stored;
//         d_k = |x_k - y_k|, on the torus min(d_k, side_k - d_k). The provenance has the radius,
//         the last one where it relaxes. Point i does not depend on the number of points.
// Beware  not maximal: with K misses, places are left for one dart in about K.
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927 (darts);
//         M. McCool, E. Fiume, Graphics Interface (1992) 94-105 (relaxing radius).

#include <fmt/format.h>

#include "core/text.hpp"
#include "generators/box_space.hpp"
#include "generators/generator.hpp"
#include "math/draws.hpp"
#include "math/point_grid.hpp"

namespace stipple::generators {
namespace {

constexpr Param<double> radius{.name = "radius",
                               .low = 0,
                               .low_open = true,
                               .optional = true,
                               .unit = "length",
                               .help =
                                   "Least distance of two points, which stays; without it, it "
                                   "shrinks until --count points have found a place"};
constexpr Param<std::int64_t> misses{
    .name = "misses",
    .fallback = 200,
    .low = 1,
    .high = 1'000'000'000,
    .unit = "darts",
    .help = "Darts in a row without a place that end the set, or shrink the radius"};
constexpr Param<double> shrink{.name = "shrink",
                               .fallback = 0.99,
                               .low = 0.01,
                               .high = 0.999999,
                               .help = "What the radius is multiplied by when it shrinks"};

constexpr double packed = 0.8;  // points to r^d when hardly one more finds a place; rather too many

Plan plan(const Request& request, const Values& options) {
    Plan plan = plan_in_box(request, options);
    if (!options.given(radius)) return plan;
    const double most = space_of(plan, !options[bounded_option]).largest_distance();
    if (!(options[radius] <= most))
        fail(ErrorKind::usage,
             "--radius: {} is outside (0, {}]; no two points of the box are farther apart",
             format_number(options[radius]), format_number(most));
    if (options.given(shrink))
        fail(ErrorKind::usage, "--shrink: a radius given by --radius stays; give one of them");
    if (!request.count) plan.count = 0;
    return plan;
}

/// Throws until a dart finds a place, and so on.
template <std::size_t D>
class Thrower {
  public:
    using Point = typename GridFrame<D>::Point;

    Thrower(const BoxSpace& space, std::uint64_t seed, std::uint64_t patience,
            const RunContext& run)
        : space_(space),
          run_(run),
          misses_(patience),
          draw_(Rng(seed)),
          points_(space.box, space.torus) {}

    /// Adds a point. False if `misses` darts have found no place.
    bool add(double r) {
        Point p;
        for (std::uint64_t left = misses_; left > 0; --left) {
            if (++darts_ % 4096 == 0) run_.tick(std::min(points_.count(), wanted_), wanted_);
            draw_.point(space_.box, p.data());
            if (points_.any_nearer(p.data(), r)) continue;
            points_.add(p.data());
            return true;
        }
        return false;
    }

    /// Adds points that keep `r`, `count` of them unless that is 0; how many there are.
    std::size_t fill(double r, std::uint64_t count) {
        wanted_ = count ? count : static_cast<std::uint64_t>(space_.expected_points(packed, r));
        while ((count == 0 || points_.count() < count) && add(r)) {
        }
        return points_.count();
    }

    /// Adds points until there are `count`; the radius that they keep.
    double relax(std::uint64_t count, double factor) {
        wanted_ = count;
        double r = space_.largest_distance();
        while (points_.count() < count)
            if (!add(r)) r *= factor;
        return r;
    }

    [[nodiscard]] const std::vector<double>& rows() const { return points_.rows(); }

  private:
    const BoxSpace& space_;
    const RunContext& run_;
    std::uint64_t misses_;
    DrawStream draw_;
    GrowingPoints<D> points_;
    std::uint64_t wanted_ = 1;  ///< points, as far as one knows
    std::uint64_t darts_ = 0;
};

/// @throws Error(limit) when the points do not fit the memory, or the indices.
template <std::size_t D>
void check_size(double points, const std::string& what, const RunContext& run) {
    run.need_memory(GrowingPoints<D>::memory(points), what);
    if (points >= 0xffff'fff0) fail(ErrorKind::limit, "{} are more than 2^32", what);
}

template <std::size_t D>
PointSet make_in(const Plan& plan, const Values& options, const RunContext& run) {
    const BoxSpace space = space_of(plan, !options[bounded_option]);
    const std::uint64_t wanted = plan.count ? plan.start + plan.count : 0;
    double r = options.given(radius) ? options[radius] : 0;
    const double expected = wanted ? static_cast<double>(wanted) : space.expected_points(packed, r);
    check_size<D>(expected, fmt::format("{:.4g} points", expected), run);

    const auto patience = static_cast<std::uint64_t>(options[misses]);
    Thrower<D> thrower(space, plan.seed, patience, run);
    if (r > 0) {
        const std::size_t found = thrower.fill(r, wanted);
        if (found < wanted || found <= plan.start)
            fail(ErrorKind::limit,
                 "only {} points keep a radius of {} before {} darts in a row have missed; {} were "
                 "asked for",
                 found, format_number(r), patience, std::max(wanted, plan.start + 1));
    } else {
        r = thrower.relax(wanted, options[shrink]);
    }
    run.tick(1, 1);
    PointSet points = set_in_box(thrower.rows(), plan);
    points.provenance.options = {{"radius", format_number(r)},
                                 {"misses", std::to_string(patience)}};
    if (!options.given(radius))
        points.provenance.options.emplace_back("shrink", format_number(options[shrink]));
    points.provenance.options.emplace_back(space.torus ? "torus" : "bounded", "true");
    return points;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    return with_dimension(plan.dimension,
                          [&]<std::size_t D>() { return make_in<D>(plan, options, run.rising()); });
}

}  // namespace

Generator dart_throwing() {
    return {.name = "dart-throwing",
            .summary = "Random points that keep a distance, which shrinks as they become many",
            .source = "McCool, Fiume 1992, Graphics Interface, 94-105",
            .traits = {.max_dimension = most_directions, .sequence = false, .boxed = true},
            .options = Schema(radius, misses, shrink, torus_option, bounded_option),
            .aliases = {"darts", "relaxation-dart-throwing"},
            .plan = plan,
            .set = make};
}

}  // namespace stipple::generators
