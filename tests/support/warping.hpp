// SPDX-License-Identifier: MIT
//
// Short ways for tests to warp points of the unit square.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "core/rng.hpp"
#include "core/spec.hpp"
#include "support/units.hpp"

namespace stipple::testing {

/// The map that a spec means, "disk:method=naive", for two coordinates.
inline std::unique_ptr<Mapping> mapping(std::string_view text) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), 2, {});
}

/// The image of points that have one, with its domain.
inline PointSet warped(const Mapping& map, const PointSet& points) {
    const std::size_t d = map.domain()->dimension();
    std::vector<double> image(points.count() * d);
    std::vector<std::uint8_t> keep(points.count(), 1);
    map.forward(points.flat(), image, keep);
    std::vector<double> kept;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (keep[i]) kept.insert(kept.end(), &image[i * d], &image[i * d] + d);
    PointSet out(std::move(kept), d);
    out.domain = map.domain();
    return out;
}

/// The point of the square that `map` takes to this point.
inline std::vector<double> inverse_of(const Mapping& map, const std::vector<double>& point) {
    std::vector<double> cube(map.cube_dimension());
    map.inverse(point, cube);
    return cube;
}

/// Corners, edges, centre and other lines of the unit square where warps turn, both sides of them,
/// and random points.
inline PointSet telling_points() {
    std::vector<double> lines = {0, 5e-324, 1e-300, 1e-20, 0x1p-53, one_minus_ulp};
    for (int k = 1; k < 8; ++k)
        for (const double x : {std::nextafter(k / 8.0, 0), k / 8.0, std::nextafter(k / 8.0, 1)})
            lines.push_back(x);
    std::vector<double> flat;
    for (const double x : lines)
        for (const double y : lines) flat.insert(flat.end(), {x, y});
    const Rng rng(11);
    for (std::uint64_t i = 0; i < 10'000; ++i) flat.push_back(rng.uniform(i));
    return {std::move(flat), 2};
}

/// Holds that every image lies in the domain, and goes back into the closed cube, to a point whose
/// image is the same within `tolerance`.
inline void expect_round_trip(const Mapping& map, double tolerance) {
    const PointSet image = warped(map, telling_points());
    const DomainPtr domain = map.domain();
    PointSet back(image.count(), map.cube_dimension());
    map.inverse(image.flat(), back.flat());
    PointSet again(image.count(), image.dimension());
    std::vector<std::uint8_t> keep(image.count(), 1);
    map.forward(back.flat(), again.flat(), keep);
    std::vector<double> cell(domain->cube_dimension());
    for (std::size_t i = 0; i < image.count(); ++i) {
        ASSERT_TRUE(domain->contains(image[i])) << image[i][0] << ", " << image[i][1];
        domain->to_cube(image[i], cell);
        for (const double x : cell) ASSERT_TRUE(x >= 0 && x <= 1) << image[i][0];
        for (const double x : back[i]) ASSERT_TRUE(x >= 0 && x <= 1) << image[i][0];
        for (std::size_t k = 0; k < image.dimension(); ++k)
            ASSERT_NEAR(again[i][k], image[i][k], tolerance) << "coordinate " << k;
    }
}

}  // namespace stipple::testing
