// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "media/png_picture.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/units.hpp"

namespace stipple::testing::void_and_cluster_test {
namespace {

const std::string name = "void-and-cluster";

/// Mean power at frequencies below half of sqrt(n): 1 for random points.
double low_power(const PointSet& set) {
    const Report report = analyze("periodogram", set);
    const auto& frequency = report.curve("radial.frequency");
    const auto& power = report.curve("radial.power");
    double sum = 0;
    double bins = 0;
    for (std::size_t i = 0; i < power.size(); ++i)
        if (frequency[i] < 0.5 * std::sqrt(static_cast<double>(set.count()))) {
            sum += power[i];
            ++bins;
        }
    return sum / bins;
}

}  // namespace

TEST(VoidAndCluster, PointsAreCentersOfCells) {
    const PointSet set = make(name, points(300, 2), {{"size", "32x16"}});
    std::set<std::pair<double, double>> cells;
    for (std::size_t i = 0; i < set.count(); ++i) {
        const double x = set[i][0] * 32 - 0.5;
        const double y = set[i][1] * 16 - 0.5;
        EXPECT_EQ(x, std::floor(x));
        EXPECT_EQ(y, std::floor(y));
        cells.emplace(x, y);
    }
    EXPECT_EQ(cells.size(), 300U);
    EXPECT_EQ(make(name, points(7, 2)).provenance.options.front(),
              (std::pair<std::string, std::string>("size", "16x16")));
}

TEST(VoidAndCluster, RandomPlacesStayInTheSameCells) {
    const PointSet centered = make(name, points(300, 2), {{"size", "32x16"}});
    const PointSet moved = make(name, points(300, 2), {{"size", "32x16"}, {"cell", "random"}});
    EXPECT_NE(centered, moved);
    for (std::size_t i = 0; i < 300; ++i) {
        EXPECT_EQ(std::floor(centered[i][0] * 32), std::floor(moved[i][0] * 32));
        EXPECT_EQ(std::floor(centered[i][1] * 16), std::floor(moved[i][1] * 16));
    }
}

TEST(VoidAndCluster, FewerPointsAreTheFirstOfMoreOnTheSameTorus) {
    for (const char* cell : {"center", "random"}) {
        const Settings settings{{"size", "32x32"}, {"cell", cell}};
        const PointSet all = make(name, points(1024, 2), settings);
        for (const std::uint64_t n : {1, 2, 3, 100, 103, 700})
            EXPECT_TRUE(std::ranges::equal(make(name, points(n, 2), settings).flat(),
                                           all.flat().first(2 * n)));
    }
}

// Measured with 10 seeds: at most 0.06 for every prefix; white noise has 1.
TEST(VoidAndCluster, EveryPrefixLacksLowFrequencies) {
    const PointSet all = make(name, points(2048, 2), {{"size", "64x64"}});
    for (const std::size_t n : {64U, 256U, 409U, 1024U, 2048U}) {
        const auto rows = all.flat().first(2 * n);
        EXPECT_LT(low_power(PointSet({rows.begin(), rows.end()}, 2)), 0.15) << n;
    }
    EXPECT_GT(low_power(make("random", points(1024, 2))), 0.5);
}

TEST(VoidAndCluster, MaskHoldsTheRankOfEveryCell) {
    const PointSet set = make(name, points(512, 2), {{"size", "32x16"}, {"mask-image", "m.png"}});
    ASSERT_EQ(set.side_files.size(), 1U);
    EXPECT_EQ(set.side_files[0].path, "m.png");
    const PngPicture mask = read_png(set.side_files[0].bytes, "m.png", {});
    EXPECT_EQ(mask.width, 32U);
    EXPECT_EQ(mask.height, 16U);
    for (std::size_t rank = 0; rank < 512; ++rank) {
        const auto x = static_cast<std::size_t>(set[rank][0] * 32);
        const auto y = static_cast<std::size_t>(set[rank][1] * 16);
        EXPECT_EQ(mask.grey[(15 - y) * 32 + x] * 65535,
                  std::floor((static_cast<double>(rank) + 0.5) * 128));
    }
    EXPECT_EQ(make(name, points(512, 2), {{"size", "32x16"}}), set);
    EXPECT_TRUE(make(name, points(5, 2)).side_files.empty());
}

// Expected: three quarters of the points in the right half of a ramp; all points inside a mask.
TEST(VoidAndCluster, FollowsADensity) {
    std::vector<double> ramp(64);
    for (std::size_t i = 0; i < 64; ++i) ramp[i] = static_cast<double>(i) + 0.5;
    const TemporaryFile file(npy_of<double>("<f8", "(1, 64)", ramp));
    const PointSet set =
        make(name, points(1000, 2), {{"density", file.path()}, {"size", "128x128"}});
    const PointSet inverse = make(
        name, points(1000, 2), {{"density", file.path()}, {"invert", "true"}, {"size", "128x128"}});
    std::size_t right = 0;
    std::size_t left = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
        right += set[i][0] >= 0.5;
        left += inverse[i][0] < 0.5;
    }
    // The standard deviation of random points is 14.
    EXPECT_NEAR(static_cast<double>(right), 750, 8);
    EXPECT_NEAR(static_cast<double>(left), 755, 8);

    const TemporaryFile corner(npy_of<std::uint8_t>("|u1", "(2, 2)", {0, 1, 0, 0}));
    const PointSet few = make(name, points(100, 2), {{"density", corner.path()}});
    for (std::size_t i = 0; i < few.count(); ++i) EXPECT_TRUE(few[i][0] >= 0.5 && few[i][1] < 0.5);
}

// Cells of the torus are wider than pixels: the mass in a cell counts, not the pixel at its centre.
// Every second column is bright, even ones on the left, odd ones on the right.
TEST(VoidAndCluster, SeesPicturesThatAreFinerThanItsCells) {
    std::vector<double> stripes(128);
    for (std::size_t i = 0; i < 128; ++i) stripes[i] = i % 2 == (i < 64 ? 0 : 1) ? 1 : 0;
    const TemporaryFile file(npy_of<double>("<f8", "(1, 128)", stripes));
    for (const char* size : {"64x64", "48x48"}) {
        const PointSet set = make(name, points(400, 2), {{"density", file.path()}, {"size", size}});
        std::size_t left = 0;
        for (std::size_t i = 0; i < set.count(); ++i) left += set[i][0] < 0.5;
        EXPECT_NEAR(static_cast<double>(left), 200, 6) << size;
    }
}

TEST(VoidAndCluster, AConstantDensityIsNone) {
    const TemporaryFile file(npy_of<double>("<f8", "(2, 1)", {3, 3}));
    EXPECT_EQ(make(name, points(500, 2), {{"density", file.path()}, {"size", "64x64"}}),
              make(name, points(500, 2), {{"size", "64x64"}}));
}

TEST(VoidAndCluster, RefusesWrongOptionsInOneLine) {
    const auto error = [](Settings settings, std::uint64_t n = 100) {
        return error_of([&] { make(name, points(n, 2), settings); });
    };
    EXPECT_EQ(error({{"size", "8x8"}}), "usage: --size: 8x8 has 64 cells, too few for 100 points");
    EXPECT_EQ(error({{"size", "8"}}),
              "usage: --size: 8 is not two numbers; expected, for example, 64x64");
    EXPECT_EQ(error({{"size", "65536x65536"}}),
              "usage: --size: 65536x65536 is outside 1x1 to 2^31 cells");
    EXPECT_EQ(error({{"invert", "true"}}), "usage: --invert: there is no --density to invert");
    EXPECT_EQ(error({}, std::uint64_t{1} << 40),
              "limit: void-and-cluster makes at most 2^30 points; 1099511627776 are too many");
    const TemporaryFile file(npy_of<double>("<f8", "(2, 2)", {1, 0, 0, 0}));
    EXPECT_EQ(error({{"density", file.path()}, {"size", "16x16"}}),
              "input: " + file.path() +
                  ": only 64 of 16 x 16 cells have a density above 0; 100 points need a larger "
                  "--size");
}

TEST(VoidAndCluster, CellsAreSquaresInABox) {
    Request request = points(100, 2);
    request.bounds = Box{{2, -1}, {2.5, 0.5}};
    const PointSet set = make(name, request);
    EXPECT_EQ(set.provenance.options.front(),
              (std::pair<std::string, std::string>("size", "32x96")));
    for (std::size_t i = 0; i < 100; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const double cell = (set[i][k] - request.bounds->low[k]) * 64 - 0.5;
            EXPECT_NEAR(cell, std::round(cell), 1e-12);
        }
    EXPECT_EQ(set.domain->bounding_box(), *request.bounds);
}

// Cells that --size makes long and thin use the distances in the box.
TEST(VoidAndCluster, DistancesHoldInABox) {
    for (const Settings& settings : {Settings{}, Settings{{"size", "64x64"}}})
        for (const Box& box : std::vector<Box>{{{0, 0}, {4, 1}}, {{0, 0}, {1, 9}}}) {
            Request request = points(256, 2);
            request.bounds = box;
            const double spacing = std::sqrt(box.extent(0) * box.extent(1) / 256);
            EXPECT_GT(smallest_distance(make(name, request, settings), {box, true}), 0.5 * spacing);
        }
}

TEST(VoidAndCluster, RefusesCellsThatAreTooLong) {
    Request request = points(9, 2);
    request.bounds = Box{{0, 0}, {1, 200}};
    EXPECT_EQ(error_of([&] {
                  make(name, request, {{"size", "64x64"}});
              }),
              "usage: --size: 64x64 makes cells 0.005 times as wide as they are high; expected a "
              "ratio from 0.01 to 100");
}

}  // namespace stipple::testing::void_and_cluster_test
