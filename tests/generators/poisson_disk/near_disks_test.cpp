// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/near_disks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace stipple::testing::near_disks_test {
using namespace stipple::poisson_disk;

namespace {

template <std::size_t D>
using Place = std::array<double, D>;

/// A gap and disks, some of which overlap it; all numbers are floats.
template <std::size_t D>
struct Scene {
    std::vector<Place<D>> centers;
    Place<D> corner;
    double side;

    Scene(std::uint64_t seed, std::size_t count) {
        const Rng rng(seed);
        std::uint64_t i = 0;
        const auto draw = [&] { return static_cast<double>(static_cast<float>(rng.uniform(i++))); };
        side = static_cast<double>(
            static_cast<float>(std::ldexp(draw(), -static_cast<int>(seed % 5))));
        for (double& x : corner) x = draw();
        for (std::size_t n = 0; n < count; ++n) {
            Place<D> center;
            for (double& x : center) x = 4 * draw() - 1.5;
            centers.push_back(center);
        }
    }

    template <class Real>
    [[nodiscard]] NearDisks<D, Real> near() const {
        NearDisks<D, Real> list;
        list.clear();
        for (const Place<D>& c : centers) {
            std::array<Real, D> center;
            for (std::size_t k = 0; k < D; ++k) center[k] = static_cast<Real>(c[k]);
            list.add(center);
        }
        list.close();
        return list;
    }
};

/// 1 - the squared distance that decides on a sub-cell: from the centre to its farthest corner.
template <std::size_t D>
double depth(const Place<D>& center, const Place<D>& low, double side) {
    double squared = 0;
    for (std::size_t k = 0; k < D; ++k) {
        const double far =
            std::max(std::abs(center[k] - low[k]), std::abs(center[k] - low[k] - side));
        squared += far * far;
    }
    return 1 - squared;
}

/// Checks each sub-cell: one clearly covered by a single disk is not open; one that no disk covers
/// is open.
template <std::size_t D, class Real>
void compare_subcells(std::uint64_t seed, Real slack) {
    const Scene<D> scene(seed, 1 + seed % 23);
    SubcellGrid<D, Real> grid({}, {});
    for (std::size_t k = 0; k < D; ++k) {
        grid.corner[k] = static_cast<Real>(scene.corner[k]);
        grid.sides[k] = static_cast<Real>(scene.side);
    }
    NearDisks<D, Real> reaching;
    const SubcellBits open = uncovered<D, Real>(scene.template near<Real>(), grid, slack, reaching);
    for (std::size_t i = 0; i < all_subcells<D>; ++i) {
        Place<D> low;
        for (std::size_t k = 0, rest = i; k < D; ++k, rest /= subcells<D>)
            low[k] = scene.corner[k] + static_cast<double>(rest % subcells<D>) * scene.side;
        double deepest = -1e9;
        for (const auto& c : scene.centers)
            deepest = std::max(deepest, depth<D>(c, low, scene.side));
        const bool is_open = (open >> i & 1) != 0;
        const double room = 4 * static_cast<double>(slack);
        if (deepest < 0) {
            EXPECT_TRUE(is_open) << D << "-D, seed " << seed << ", sub-cell " << i;
        }
        if (deepest > room) {
            EXPECT_FALSE(is_open) << D << "-D, seed " << seed << ", sub-cell " << i;
        }
    }
    if constexpr (all_subcells<D> < 64) {
        EXPECT_EQ(open >> all_subcells<D>, 0U);
    }
    for (std::size_t i = 0; i < reaching.size(); ++i) EXPECT_LT(std::abs(reaching.along(0)[i]), 5);
}

template <std::size_t D, class Real>
void compare_hits(std::uint64_t seed, Real slack) {
    const Scene<D> scene(seed, 1 + seed % 23);
    const auto near = scene.template near<Real>();
    std::array<Real, D> place;
    for (std::size_t k = 0; k < D; ++k) place[k] = static_cast<Real>(scene.corner[k]);
    double least = 1e9;
    for (const auto& c : scene.centers) {
        double squared = 0;
        for (std::size_t k = 0; k < D; ++k)
            squared += (c[k] - scene.corner[k]) * (c[k] - scene.corner[k]);
        least = std::min(least, squared);
    }
    const Hit hit = hits<D, Real>(near, place, slack);
    const double room = 2 * static_cast<double>(slack);
    if (least < 1 - room) {
        EXPECT_EQ(hit, Hit::yes) << D << "-D, seed " << seed;
    }
    if (least > 1 + room) {
        EXPECT_EQ(hit, Hit::no) << D << "-D, seed " << seed;
    }
    if (least < 1) {
        EXPECT_NE(hit, Hit::no);
    }
    if (least > 1) {
        EXPECT_NE(hit, Hit::yes);
    }
}

template <std::size_t D>
void compare_all() {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        compare_subcells<D, float>(seed, float_slack);
        compare_subcells<D, double>(seed, 1e-13);
        compare_hits<D, float>(seed, float_slack);
        compare_hits<D, double>(seed, 1e-13);
    }
}

}  // namespace

TEST(NearDisks, AgreeWithTheDefinitionSubcellBySubcell) {
    compare_all<2>();
    compare_all<3>();
    compare_all<4>();
    compare_all<5>();
    compare_all<6>();
}

TEST(NearDisks, AHitAtTheRimIsUnsure) {
    NearDisks<2, float> near;
    near.clear();
    near.add({0, 0});
    near.close();
    EXPECT_EQ((hits<2, float>(near, {1, 0}, float_slack)), Hit::unsure);
    EXPECT_EQ((hits<2, float>(near, {0.9999F, 0}, float_slack)), Hit::yes);
    EXPECT_EQ((hits<2, float>(near, {1.0001F, 0}, float_slack)), Hit::no);
    near.clear();
    near.close();
    EXPECT_EQ((hits<2, float>(near, {0, 0}, float_slack)), Hit::no);
}

TEST(NearDisks, GrowWithoutLosingAny) {
    NearDisks<4, double> near;
    near.clear();
    for (int i = 0; i < 500; ++i) near.add({1.0 * i, 2.0 * i, 3.0 * i, 4.0 * i});
    near.close();
    ASSERT_EQ(near.size(), 500);
    for (std::size_t i = 0; i < 500; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_EQ(near.along(k)[i], static_cast<double>((k + 1) * i));
}

}  // namespace stipple::testing::near_disks_test
