// SPDX-License-Identifier: MIT
//
// What every registered warp promises, with its default options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "support/contract.hpp"

namespace stipple::testing::warps_test {
namespace {

/// Default options and, where there is no default, an example.
Values options_of(const Warp& unit) {
    return Spec{.name = unit.name, .coordinates = {}, .settings = needed_options(unit.name)}.values(
        unit.options);
}

class EveryWarp : public ::testing::TestWithParam<std::string> {
  protected:
    const Warp& unit = find_warp(GetParam());
    const std::unique_ptr<Mapping> mapping = unit.make(options_of(unit), 2, {});
    const std::size_t in = mapping->cube_dimension();
    const std::size_t out = mapping->domain()->dimension();

    /// Random points, and all combinations of the cube's edges.
    std::vector<double> cube() const {
        std::vector<double> rows(3000 * in);
        Rng(5).fill(0, rows);
        const std::vector<double> edges = {0, 0x1p-60, 0.25, 0.5, 0.75, one_minus_ulp};
        std::vector<std::size_t> at(in, 0);
        while (true) {
            for (const std::size_t k : at) rows.push_back(edges[k]);
            std::size_t k = 0;
            while (k < in && ++at[k] == edges.size()) at[k++] = 0;
            if (k == in) return rows;
        }
    }
};

TEST_P(EveryWarp, MapsTheWholeCubeIntoItsDomain) {
    const auto rows = cube();
    std::vector<double> image(rows.size() / in * out);
    std::vector<std::uint8_t> keep(rows.size() / in, 1);
    mapping->forward(rows, image, keep);
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        const auto point = std::span<const double>(image).subspan(i * out, out);
        EXPECT_TRUE(mapping->domain()->contains(point)) << "point " << i;
        // A density may fall to 0 on the rim, which edges of the cube are taken to.
        const auto unit_point = std::span<const double>(rows).subspan(i * in, in);
        const bool edge = std::ranges::count(unit_point, 0.0) > 0;
        const double density = mapping->density(point);
        EXPECT_TRUE(density > 0 || (edge && density == 0)) << "point " << i << ": " << density;
    }
}

/// A number in [0, 1] that warps may stumble over: an end, a place next to one at any scale, or
/// next to a simple fraction.
double hostile(std::uint64_t bits) {
    const double any = to_unit(bits);
    const auto scale = static_cast<int>(bits / 8 % 64);
    const double fraction = static_cast<double>(scale % 25) / 24;
    switch (bits % 8) {
        case 0:
            return scale < 32 ? 0 : 1;
        case 1:
            return std::ldexp(any, -scale);
        case 2:
            return std::ldexp(any, -17 * scale);  // down to denormals
        case 3:
            return 1 - std::ldexp(any, -scale);
        case 4:
            return std::nextafter(fraction, 0);
        case 5:
            return fraction;
        case 6:
            return std::min(std::nextafter(fraction, 2), 1.0);
        default:
            return any;
    }
}

TEST_P(EveryWarp, StandsAHundredThousandHostilePoints) {
    const std::size_t count = 100'000;
    std::vector<double> rows(count * in), image(count * out);
    const Rng rng(17);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = hostile(rng.bits(i));
    std::vector<std::uint8_t> keep(count, 1);
    mapping->forward(rows, image, keep);
    std::vector<double> cell(mapping->domain()->cube_dimension());
    for (std::size_t i = 0; i < count; ++i) {
        if (!keep[i]) continue;
        const auto point = std::span<const double>(image).subspan(i * out, out);
        ASSERT_TRUE(mapping->domain()->contains(point)) << "point " << i;
        ASSERT_TRUE(mapping->density(point) >= 0) << "point " << i;
        mapping->domain()->to_cube(point, cell);
        for (const double u : cell) ASSERT_TRUE(u >= 0 && u <= 1) << "point " << i << ": " << u;
    }
}

TEST_P(EveryWarp, ComesBackWithinRounding) {
    if (!unit.traits.invertible) GTEST_SKIP();
    const auto rows = cube();
    std::vector<double> image(rows.size() / in * out);
    std::vector<std::uint8_t> keep(rows.size() / in, 1);
    mapping->forward(rows, image, keep);
    std::vector<double> back(rows.size());
    mapping->inverse(image, back);
    std::vector<double> again(image.size());
    for (const double x : back) EXPECT_TRUE(x >= 0 && x <= 1) << x;
    mapping->forward(back, again, keep);
    // Where an edge of the cube is one point of the domain the way back may differ; its image may
    // not.
    for (std::size_t k = 0; k < image.size(); ++k) EXPECT_NEAR(again[k], image[k], 1e-14) << k;
}

// The contract of parse_domain: a domain's spec is the domain.
TEST_P(EveryWarp, DomainSpecParsesBack) {
    const std::string spec = mapping->domain()->spec();
    EXPECT_EQ(parse_domain(spec, out)->spec(), spec);
}

TEST_P(EveryWarp, CellsAreInTheCube) {
    const auto rows = cube();
    std::vector<double> image(rows.size() / in * out);
    std::vector<std::uint8_t> keep(rows.size() / in, 1);
    mapping->forward(rows, image, keep);
    std::vector<double> coordinates(mapping->domain()->cube_dimension());
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        mapping->domain()->to_cube(std::span<const double>(image).subspan(i * out, out),
                                   coordinates);
        for (const double u : coordinates) EXPECT_TRUE(u >= 0 && u <= 1) << u;
    }
    EXPECT_EQ(mapping->domain()->cube_axes().size(), coordinates.size());
}

TEST_P(EveryWarp, HasACompleteRecord) {
    expect_complete_record(unit);
    EXPECT_FALSE(unit.strata.empty());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryWarp, ::testing::ValuesIn(names_of(warps::all())),
                         case_name);

}  // namespace

}  // namespace stipple::testing::warps_test
