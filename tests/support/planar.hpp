// SPDX-License-Identifier: MIT
//
// Checks that all warps of the unit square pass: hostile points, the Jacobian, areas, and
// uniformity, with a check that deviations are detected.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "support/warping.hpp"

namespace stipple::testing {

/// A number in [0, 1] that is difficult for warps: an end, a number near an end at any scale, near
/// a simple fraction, or any.
inline double hostile_number(std::uint64_t bits) {
    const double any = to_unit(bits);
    const auto pick = static_cast<int>(bits % 8);
    const auto scale = static_cast<int>(bits / 8 % 64);
    const double fraction = static_cast<double>(bits / 8 % 13) / 12;
    if (pick == 0) return scale < 32 ? 0 : 1;
    if (pick == 1) return std::ldexp(any, -scale);
    if (pick == 2) return std::ldexp(any, -17 * scale);  // including denormals
    if (pick == 3) return 1 - std::ldexp(any, -scale);
    if (pick == 4) return std::nextafter(fraction, 0);
    if (pick == 5) return std::min(fraction, one_minus_ulp);
    if (pick == 6) return std::min(std::nextafter(fraction, 2), one_minus_ulp);
    return any;
}

inline PointSet hostile_points(std::size_t count, std::size_t dimension) {
    std::vector<double> flat(count * dimension);
    const Rng rng(17);
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = hostile_number(rng.bits(i));
    return {std::move(flat), dimension};
}

/// Expects all images of hostile points to be in the domain, to have a density, and to be mapped
/// back into the cube to a point with the same image within `tolerance`.
inline void expect_stands_hostile_points(const Mapping& map, double tolerance,
                                         std::size_t count = 100'000) {
    const PointSet cube = hostile_points(count, map.cube_dimension());
    const DomainPtr domain = map.domain();
    PointSet image(count, domain->dimension()), again(count, domain->dimension());
    PointSet back(count, cube.dimension());
    map.forward(cube.flat(), image.flat(), {});
    for (std::size_t i = 0; i < count; ++i) {
        ASSERT_TRUE(domain->contains(image[i]))
            << domain->spec() << ": " << cube[i][0] << ", " << cube[i][1];
        ASSERT_TRUE(map.density(image[i]) >= 0) << cube[i][0] << ", " << cube[i][1];
    }
    map.inverse(image.flat(), back.flat());
    for (const double x : back.flat()) ASSERT_TRUE(x >= 0 && x <= 1) << x;
    map.forward(back.flat(), again.flat(), {});
    for (std::size_t k = 0; k < image.flat().size(); ++k)
        ASSERT_NEAR(again.flat()[k], image.flat()[k], tolerance)
            << domain->spec() << ", point " << k / image.dimension() << ": "
            << cube[k / image.dimension()][0] << ", " << cube[k / image.dimension()][1];
}

/// Expects xi itself to come back within `tolerance`. With `least_first`, the second coordinate is
/// only checked if the first is at least that, because smaller ones may be mapped to one point.
inline void expect_unit_coordinates_back(const Mapping& map, double tolerance,
                                         double least_first = 0) {
    const PointSet cube = telling_points();
    PointSet image(cube.count(), map.domain()->dimension()), back(cube.count(), 2);
    map.forward(cube.flat(), image.flat(), {});
    map.inverse(image.flat(), back.flat());
    for (std::size_t i = 0; i < cube.count(); ++i) {
        EXPECT_NEAR(back[i][0], cube[i][0], tolerance) << cube[i][1];
        if (cube[i][0] < least_first) continue;
        // A full turn is the same as no turn.
        const bool turn = cube[i][1] == 1 && back[i][1] < tolerance;
        EXPECT_NEAR(back[i][1] + (turn ? 1 : 0), cube[i][1], tolerance) << cube[i][0];
    }
}

/// Expects the density to be 1 over the Jacobian, except near the rim of the square.
inline void expect_density_is_one_over_jacobian(const Mapping& map) {
    const Rng rng(5);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const double u = 0.01 + 0.98 * rng.uniform(2 * i);
        const double v = 0.01 + 0.98 * rng.uniform(2 * i + 1);
        EXPECT_NEAR(map.density(image_of(map, {u, v})) * stretch_at(map, {u, v}, 1e-6), 1, 2e-7)
            << map.domain()->spec() << ": " << u << ", " << v;
    }
}

/// Expects the domain to fill the fraction of its bounding box that follows from its measure.
/// Random points in the box; 5 standard deviations, false alarm 6e-7.
inline void expect_measure_is_share_of_box(const Domain& domain) {
    const Box box = domain.bounding_box();
    PointSet points = make("random", testing::points(100'000, 2), {}, {.seed = 3});
    double inside = 0;
    for (std::size_t i = 0; i < points.count(); ++i) {
        const std::vector<double> p = {box.low[0] + points[i][0] * box.extent(0),
                                       box.low[1] + points[i][1] * box.extent(1)};
        inside += domain.contains(p);
    }
    const double share = domain.measure() / (box.extent(0) * box.extent(1));
    EXPECT_NEAR(inside / 1e5, share, 5 * std::sqrt(share * (1 - share) / 1e5) + 1e-9)
        << domain.spec();
}

/// Expects images of random points to pass the chi-square test, and those of points with a tilt of
/// 10 % in either coordinate to fail. False alarm 1e-6; the tilt's noncentrality is 333 with about
/// 200 degrees of freedom.
inline void expect_chi_square_can_tell(const Mapping& map) {
    const PointSet even = make("random", points(100'000, map.cube_dimension()), {}, {.seed = 2});
    EXPECT_GT(measure("chi-square", "p_value", warped(map, even)), 1e-6) << map.domain()->spec();
    for (std::size_t k = 0; k < map.cube_dimension(); ++k) {
        PointSet tilted = even;
        for (std::size_t i = 0; i < tilted.count(); ++i) tilted[i][k] *= 0.9 + 0.1 * tilted[i][k];
        EXPECT_LT(measure("chi-square", "p_value", warped(map, tilted)), 1e-6)
            << map.domain()->spec() << ", coordinate " << k;
    }
}

/// Means, variances and covariance of images of 10^5 random points.
struct PlaneMoments {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};
inline PlaneMoments plane_moments(const Mapping& map) {
    const PointSet image = warped(map, make("random", points(100'000, 2), {}, {.seed = 4}));
    const auto n = static_cast<double>(image.count());
    PlaneMoments m;
    for (std::size_t i = 0; i < image.count(); ++i) {
        m.x += image[i][0] / n;
        m.y += image[i][1] / n;
    }
    for (std::size_t i = 0; i < image.count(); ++i) {
        const double a = image[i][0] - m.x, b = image[i][1] - m.y;
        m.xx += a * a / n;
        m.yy += b * b / n;
        m.xy += a * b / n;
    }
    return m;
}

}  // namespace stipple::testing
