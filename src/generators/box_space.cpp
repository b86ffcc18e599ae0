// SPDX-License-Identifier: MIT
#include "generators/box_space.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"

namespace stipple {

void check_torus(const Values& options) {
    if (options[torus_option] && options[bounded_option])
        fail(ErrorKind::usage, "--torus contradicts --bounded; give one of them");
}

double BoxSpace::largest_distance() const {
    double squared = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        const double across = torus ? box.extent(k) / 2 : box.extent(k);
        squared += across * across;
    }
    return std::sqrt(squared);
}

double BoxSpace::largest_coordinate() const {
    double largest = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k)
        largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
    return largest;
}

double BoxSpace::expected_points(double density, double radius) const {
    double places = density;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        const double along = box.extent(k) / radius;
        places *= torus ? std::max(along, 1.0) : along + 1;
    }
    return places + 1;
}

void BoxSpace::check_resolution(double radius, std::string_view name) const {
    const double largest = largest_coordinate();
    const double finest = largest * 0x1p-52 * 1024;
    if (!(radius >= finest))
        fail(ErrorKind::limit,
             "{} of {} is too small: coordinates near {} are rounded; expected at least {:.5g}",
             name, format_number(radius), format_number(largest), finest);
}

BoxSpace space_of(const Plan& plan, bool torus) {
    if (plan.bounds) return {*plan.bounds, torus};
    return {{std::vector<double>(plan.dimension, 0.0), std::vector<double>(plan.dimension, 1.0)},
            torus};
}

void require_squares(const Box& box, ErrorKind kind, std::string_view name) {
    const double most = BoxSpace{box, false}.largest_distance();
    if (!(most > 1e-140 && most < 1e150))
        fail(kind, "{}: {} has distances whose squares are out of the range of float64", name,
             format_box(box));
}

Plan plan_in_bounds(const Request& request) {
    return default_plan(request, 1024, request.bounds ? request.bounds->dimension() : 2);
}

Plan plan_in_box(const Request& request, const Values& options) {
    check_torus(options);
    const Plan plan = plan_in_bounds(request);
    require_squares(space_of(plan, false).box, ErrorKind::usage, "--bounds");
    return plan;
}

std::vector<double> proportions_of(const Plan& plan) {
    // Ratio up to which sides count as equal: far from the origin, rounding makes them differ.
    constexpr double alike = 1 + 1e-9;
    if (!plan.bounds) return {};
    std::vector<double> sides;
    for (std::size_t k = 0; k < plan.bounds->dimension(); ++k)
        sides.push_back(plan.bounds->extent(k));
    const double shortest = std::ranges::min(sides);
    for (double& side : sides) side /= shortest;
    if (std::ranges::max(sides) <= alike) sides.clear();
    return sides;
}

Plan plan_in_proportion(const Request& request) {
    const Plan plan = plan_in_bounds(request);
    for (const double side : proportions_of(plan))
        if (!(side <= largest_proportion))
            fail(ErrorKind::usage,
                 "--bounds: {} has a side {:.5g} times as long as another; expected {:.0f} times "
                 "at most",
                 format_box(*plan.bounds), side, largest_proportion);
    return plan;
}

void put_in_box(const Plan& plan, PointSet& points) {
    if (!plan.bounds) return;
    scale_into(*plan.bounds, points.flat());
    points.domain = box_domain(*plan.bounds);
}

PointSet set_in_box(std::vector<double> rows, const Plan& plan) {
    const std::size_t dropped = plan.start * plan.dimension;
    rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(dropped));
    PointSet points(std::move(rows), plan.dimension);
    if (plan.bounds) points.domain = box_domain(*plan.bounds);
    return points;
}

}  // namespace stipple
