// SPDX-License-Identifier: MIT
//
// Shorthands for warping points of the unit square.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "core/rng.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "support/units.hpp"

namespace stipple::testing {

/// The map of a spec such as "disk:method=naive", for two coordinates.
inline std::unique_ptr<Mapping> mapping(std::string_view text) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), 2, {});
}

/// Images of the points that have one, with their domain.
/// @param origin receives the index of each image's point
inline PointSet warped(const Mapping& map, const PointSet& points,
                       std::vector<std::size_t>* origin = nullptr) {
    const std::size_t d = map.domain()->dimension();
    std::vector<double> image(points.count() * d);
    std::vector<std::uint8_t> keep(points.count(), 1);
    map.forward(points.flat(), image, keep);
    std::vector<double> kept;
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!keep[i]) continue;
        kept.insert(kept.end(), &image[i * d], &image[i * d] + d);
        if (origin) origin->push_back(i);
    }
    PointSet out(std::move(kept), d);
    out.domain = map.domain();
    return out;
}

/// Image of one point of the cube.
inline std::vector<double> image_of(const Mapping& map, const std::vector<double>& xi) {
    std::vector<double> image(map.domain()->dimension());
    std::vector<std::uint8_t> keep(1);
    map.forward(xi, image, keep);
    return image;
}
inline std::vector<double> image_of(std::string_view spec, const std::vector<double>& xi) {
    return image_of(*mapping(spec), xi);
}

/// Point of the square that `map` maps to this point.
inline std::vector<double> inverse_of(const Mapping& map, const std::vector<double>& point) {
    std::vector<double> cube(map.cube_dimension());
    map.inverse(point, cube);
    return cube;
}

/// Corners, edges, centre and other planes of the unit cube at which warps may change branches,
/// points on both sides of them, and random points.
inline PointSet telling_points(std::size_t dimension = 2) {
    std::vector<double> lines = {0, 5e-324, 1e-300, 1e-20, 0x1p-53, one_minus_ulp, 1};
    for (int k = 1; k < 8; ++k)
        for (const double x : {std::nextafter(k / 8.0, 0), k / 8.0, std::nextafter(k / 8.0, 1)})
            lines.push_back(x);
    std::vector<double> flat;
    std::vector<std::size_t> at(dimension, 0);
    for (std::size_t k = 0; k < dimension;) {
        for (const std::size_t place : at) flat.push_back(lines[place]);
        for (k = 0; k < dimension && ++at[k] == lines.size(); ++k) at[k] = 0;
    }
    const Rng rng(11);
    for (std::uint64_t i = 0; i < 5000 * dimension; ++i) flat.push_back(rng.uniform(i));
    return {std::move(flat), dimension};
}

/// Expects every image to be in the domain, and to be mapped back into the closed cube to a point
/// with the same image within `tolerance`.
inline void expect_round_trip(const Mapping& map, double tolerance) {
    const PointSet cube = telling_points(map.cube_dimension());
    std::vector<std::size_t> origin;
    const PointSet image = warped(map, cube, &origin);
    const DomainPtr domain = map.domain();
    PointSet back(image.count(), map.cube_dimension());
    map.inverse(image.flat(), back.flat());
    PointSet again(image.count(), image.dimension());
    std::vector<std::uint8_t> keep(image.count(), 1);
    map.forward(back.flat(), again.flat(), keep);
    std::vector<double> cell(domain->cube_dimension());
    const auto trip = [&](std::size_t i) {
        return fmt::format("cube ({}) -> image ({}) -> preimage ({}) -> image ({})",
                           join(cube[origin[i]], ", "), join(image[i], ", "), join(back[i], ", "),
                           join(again[i], ", "));
    };
    for (std::size_t i = 0; i < image.count(); ++i) {
        ASSERT_TRUE(domain->contains(image[i])) << trip(i);
        domain->to_cube(image[i], cell);
        for (const double x : cell) ASSERT_TRUE(x >= 0 && x <= 1) << trip(i);
        for (const double x : back[i]) ASSERT_TRUE(x >= 0 && x <= 1) << trip(i);
        for (std::size_t k = 0; k < image.dimension(); ++k)
            ASSERT_NEAR(again[i][k], image[i][k], tolerance)
                << "coordinate " << k << ", " << trip(i);
    }
}

/// Factor by which `map` changes length, area or volume at a point of the cube, by central
/// differences: the root of the Gram determinant.
inline double stretch_at(const Mapping& map, std::vector<double> xi, double h = 1e-5) {
    const std::size_t d = map.cube_dimension();
    const std::size_t m = map.domain()->dimension();
    std::vector<std::uint8_t> keep(1);
    std::vector<std::vector<double>> tangents(d, std::vector<double>(m));
    for (std::size_t k = 0; k < d; ++k) {
        std::vector<double> ahead(m), behind(m);
        xi[k] += h;
        map.forward(xi, ahead, keep);
        xi[k] -= 2 * h;
        map.forward(xi, behind, keep);
        xi[k] += h;
        for (std::size_t j = 0; j < m; ++j) tangents[k][j] = (ahead[j] - behind[j]) / (2 * h);
    }
    double product = 1;  // of the tangents' lengths after orthogonalization
    for (std::size_t k = 0; k < d; ++k) {
        double square = 0;
        for (const double x : tangents[k]) square += x * x;
        product *= std::sqrt(square);
        for (std::size_t later = k + 1; later < d && square > 0; ++later) {
            double along = 0;
            for (std::size_t j = 0; j < m; ++j) along += tangents[k][j] * tangents[later][j];
            for (std::size_t j = 0; j < m; ++j)
                tangents[later][j] -= along / square * tangents[k][j];
        }
    }
    return product;
}

/// Expects the density to be 1 over that factor, at 200 random points of the cube.
inline void expect_density_is_one_over_stretch(const Mapping& map, double tolerance = 1e-6) {
    const std::size_t d = map.cube_dimension();
    const Rng rng(23);
    for (std::uint64_t i = 0; i < 200; ++i) {
        std::vector<double> xi(d);
        for (std::size_t k = 0; k < d; ++k) xi[k] = 0.01 + 0.98 * rng.uniform(i * d + k);
        std::vector<double> image(map.domain()->dimension());
        std::vector<std::uint8_t> keep(1);
        map.forward(xi, image, keep);
        EXPECT_NEAR(map.density(image) * stretch_at(map, xi), 1, tolerance) << xi[0];
    }
}

/// Two-sided p-value of chi-square for images of random points, on the map's domain.
inline double p_of_random(const Mapping& map, std::uint64_t count, std::uint64_t seed = 1) {
    return measure(
        "chi-square", "p_value",
        warped(map, make("random", points(count, map.cube_dimension()), {}, {.seed = seed})));
}

}  // namespace stipple::testing
