// SPDX-License-Identifier: MIT
#include "generators/blue_noise/planar_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/error.hpp"
#include "core/machine/first_touch.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

Planar planar_of(const Plan& plan, bool torus) {
    if (!plan.bounds) return {.low = {0, 0}, .sides = {1, 1}, .torus = torus};
    const Box& box = *plan.bounds;
    return {
        .low = {box.low[0], box.low[1]}, .sides = {box.extent(0), box.extent(1)}, .torus = torus};
}

/// One point for each of n strata of equal area, in floor(sqrt(n)) columns. The point is uniform in
/// a box twice as wide and as high as its stratum, with the same lower corner, wrapped around at
/// the sides. Points confined to their own strata would still show the columns after hundreds of
/// iterations, as peaks of the spectrum at (sqrt(n), 0) and (0, sqrt(n)).
std::vector<double> jittered_rows(std::uint64_t n, const Rng& rng, const RunContext& run) {
    const std::uint64_t columns = std::max<std::uint64_t>(floor_root(n, 2), 1);
    const auto all = static_cast<double>(n);
    const auto wrap = [](double x, double side) { return x < side ? x : x - side; };
    std::vector<double> rows;
    rows.reserve(2 * n);
    for (std::uint64_t c = 0; c < columns; ++c) {
        run.check_stop();
        const std::uint64_t first = c * n / columns;
        const auto held = static_cast<double>((c + 1) * n / columns - first);
        for (std::uint64_t i = first; i < (c + 1) * n / columns; ++i) {
            const double x = static_cast<double>(first) + 2 * held * rng.uniform(2 * i);
            const double y = static_cast<double>(i - first) + 2 * rng.uniform(2 * i + 1);
            rows.push_back(wrap(x, all) / all);
            rows.push_back(wrap(y, held) / held);
        }
    }
    return rows;
}

/// Makes points of the unit square follow the density, and scales them to the rectangle.
void place_all(const Planar& planar, const std::optional<DensityMap>& density,
               std::vector<double>& rows, const RunContext& run) {
    for (std::size_t i = 0; i < rows.size(); i += 2) {
        if (i % 65536 == 0) run.check_stop();
        std::array<double, 2> at{rows[i], rows[i + 1]};
        if (density) at = density->place(at[0], at[1]);
        rows[i] = at[0] * planar.sides.x;
        rows[i + 1] = at[1] * planar.sides.y;
    }
}

/// Points of a file, relative to the lower corner of the box.
std::vector<double> rows_of_file(const std::string& path, const Planar& planar,
                                 const RunContext& run) {
    const PointSet points = io::read_given(planar::from.name, path, {}, run);
    if (points.dimension() != 2)
        fail(ErrorKind::input, "{}: points of {} coordinates; expected 2", path,
             points.dimension());
    std::vector<double> rows(points.flat().begin(), points.flat().end());
    for (std::size_t i = 0; i < points.count(); ++i) {
        double& x = rows[2 * i];
        double& y = rows[2 * i + 1];
        const Vec2 high{planar.low.x + planar.sides.x, planar.low.y + planar.sides.y};
        if (!(x >= planar.low.x && x <= high.x && y >= planar.low.y && y <= high.y))
            fail(ErrorKind::input, "{}: point {}, ({}, {}), is outside {}", path, i,
                 format_number(x), format_number(y),
                 format_box({{planar.low.x, planar.low.y}, {high.x, high.y}}));
        x = std::clamp(x - planar.low.x, 0.0, planar.sides.x);
        y = std::clamp(y - planar.low.y, 0.0, planar.sides.y);
    }
    return rows;
}

std::vector<double> starting_rows(const Plan& plan, const Values& options, const Planar& planar,
                                  const std::optional<DensityMap>& density, const RunContext& run) {
    if (options.given(planar::from)) return rows_of_file(options[planar::from], planar, run);
    if (plan.count >= 0xffff'ffff)
        fail(ErrorKind::limit, "--count: {} points are too many; at most 2^32 - 2", plan.count);
    const Rng rng(plan.seed);
    if (options[planar::initial] == "random")
        return random_places(plan.count, planar, density, rng, run);
    auto rows = jittered_rows(plan.count, rng, run);
    place_all(planar, density, rows, run);
    return rows;
}

}  // namespace

Plan planar_plan(const Request& request, const Values& options) {
    check_torus(options);
    Plan plan = plan_in_bounds(request);
    if (options.given(planar::from)) {
        if (request.count)
            fail(ErrorKind::usage, "--from contradicts --count; the count is that of the file");
        if (options.given(planar::initial))
            fail(ErrorKind::usage, "--from contradicts --initial; give one of them");
        plan.count = 0;
    }
    if (!plan.bounds || plan.dimension != 2) return plan;
    const double longest = std::max(plan.bounds->extent(0), plan.bounds->extent(1));
    const double shortest = std::min(plan.bounds->extent(0), plan.bounds->extent(1));
    if (!(shortest > 1e-100 && longest < 1e100 && longest <= 1e6 * shortest))
        fail(ErrorKind::usage,
             "--bounds: {} cannot be divided into cells; expected sides in [1e-100, 1e100] with a "
             "ratio of at most 1e6",
             format_box(*plan.bounds));
    return plan;
}

std::optional<DensityMoments> planar_moments(const std::optional<DensityMap>& density,
                                             const std::function<double(double)>& function,
                                             const Planar& planar, const RunContext& run) {
    if (!density) return {};
    run.need_memory(56.0 * static_cast<double>(density->values().size()), "the density");
    std::vector<double> values(density->values().size());
    std::ranges::transform(density->values(), values.begin(), function);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    for (double& value : values) value *= static_cast<double>(values.size()) / sum;
    return DensityMoments(density->width(), density->height(), values, planar.sides);
}

PlanarStart planar_start(const Plan& plan, const Values& options, double bytes,
                         std::string_view who, const RunContext& run) {
    run.need_memory(bytes * static_cast<double>(plan.count), std::string(who));
    PlanarStart start{.planar = planar_of(plan, !options[bounded_option]),
                      .density = given_density(options, run),
                      .rows = {}};
    start.rows = starting_rows(plan, options, start.planar, start.density, run);
    run.need_memory(bytes * static_cast<double>(start.count()), std::string(who));
    return start;
}

std::vector<std::uint32_t> along_strips(const std::vector<double>& rows, const Planar& planar,
                                        const RunContext& run) {
    const std::size_t n = rows.size() / 2;
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    const double strips = std::floor(std::sqrt(static_cast<double>(n) / 2)) + 1;
    const auto strip = [&](std::uint32_t i) {
        return std::floor(rows[2 * i + 1] / planar.sides.y * strips);
    };
    run.check_stop();
    std::ranges::sort(order, {},
                      [&](std::uint32_t i) { return std::tuple(strip(i), rows[2 * i], i); });
    run.check_stop();
    return order;
}

std::vector<double> random_places(std::uint64_t n, const Planar& planar,
                                  const std::optional<DensityMap>& density, const Rng& rng,
                                  const RunContext& run) {
    std::vector<double> rows;
    grow(rows, 2 * n, run);
    rng.fill(0, rows);
    place_all(planar, density, rows, run);
    return rows;
}

PointSet planar_points(const Plan& plan, const Planar& planar, const PeriodicVoronoi& sites,
                       std::span<const std::uint32_t> order) {
    const auto put = [](double x, double low, double high) {
        return std::min(low + x, std::nextafter(high, low));
    };
    PointSet points(sites.count(), 2);
    for (std::size_t i = 0; i < sites.count(); ++i) {
        const auto point = points[order.empty() ? i : order[i]];
        point[0] = put(sites[i].x, planar.low.x, plan.bounds ? plan.bounds->high[0] : 1);
        point[1] = put(sites[i].y, planar.low.y, plan.bounds ? plan.bounds->high[1] : 1);
    }
    if (plan.bounds) points.domain = box_domain(*plan.bounds);
    return points;
}

}  // namespace stipple
