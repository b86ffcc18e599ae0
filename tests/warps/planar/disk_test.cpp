// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/planar.hpp"

namespace stipple::testing::disk_test {
namespace {

const std::vector<std::string> methods = {"polar", "concentric", "rejection", "naive"};

}  // namespace

TEST(Disk, PolarPointsByHand) {
    const double h = std::sqrt(0.5);
    EXPECT_EQ(image_of("disk", {0, 0.3}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(image_of("disk", {0.25, 0}), (std::vector{0.5, 0.0}));
    EXPECT_EQ(image_of("disk", {0.25, 0.25}), (std::vector{0.0, 0.5}));
    EXPECT_EQ(image_of("disk", {0.25, 0.5}), (std::vector{-0.5, 0.0}));
    EXPECT_EQ(image_of("disk", {0.25, 0.875}), (std::vector{0.5 * h, -0.5 * h}));
    EXPECT_EQ(image_of("disk:radius=2,center=[10,20]", {0.25, 0.75}), (std::vector{10.0, 19.0}));
}

// Each side of the square is mapped to a quarter of the rim, each corner to the point on its
// diagonal.
TEST(Disk, ConcentricPointsByHand) {
    const double h = std::sqrt(0.5);
    const auto at = [](double u, double v) { return image_of("disk:method=concentric", {u, v}); };
    EXPECT_EQ(at(0.5, 0.5), (std::vector{0.0, 0.0}));
    EXPECT_EQ(at(0, 0), (std::vector{-h, -h}));
    EXPECT_EQ(at(0, 0.5), (std::vector{-1.0, 0.0}));
    EXPECT_EQ(at(0.5, 0), (std::vector{0.0, -1.0}));
    EXPECT_EQ(at(0.5, 0.75), (std::vector{0.0, 0.5}));
    EXPECT_EQ(at(0.75, 0.75), (std::vector{0.5 * h, 0.5 * h}));
    const auto p = at(0.875, 0.6875);  // r = 3/4, theta = (pi / 4) (3/8) / (3/4) = pi / 8
    EXPECT_NEAR(p[0], 0.75 * std::cos(std::numbers::pi / 8), 2e-16);
    EXPECT_NEAR(p[1], 0.75 * std::sin(std::numbers::pi / 8), 2e-16);
}

TEST(Disk, NaiveRadiusIsProportional) {
    EXPECT_EQ(image_of("disk:method=naive,radius=3", {0.5, 0}), (std::vector{1.5, 0.0}));
}

TEST(Disk, RejectionKeepsTheOpenDiskAndMarksTheRest) {
    const auto map = mapping("disk:method=rejection");
    const std::vector<double> cube = {0.5, 0.5, 0, 0, 0, 0.5, 0.875, 0.75, 0.1, 0.2};
    std::vector<double> image(10);
    std::vector<std::uint8_t> keep(5, 7);
    map->forward(cube, image, keep);
    EXPECT_EQ(keep, (std::vector<std::uint8_t>{1, 0, 0, 1, 0}));  // (-1, 0) is on the rim: dropped
    EXPECT_EQ(image[6], 0.75);
    EXPECT_EQ(image[7], 0.5);
}

// 500 000 points, kept with probability pi / 4: standard deviation 290. False alarm 1e-6 (5 sigma).
TEST(Disk, RejectionKeepsAQuarterOfPi) {
    const PointSet kept =
        warped(*mapping("disk:method=rejection"), make("random", points(500'000, 2)));
    EXPECT_NEAR(static_cast<double>(kept.count()), 500'000 * std::numbers::pi / 4, 1450);
}

TEST(Disk, OtherMethodsKeepAll) {
    for (const char* method : {"polar", "concentric", "naive"})
        EXPECT_FALSE(mapping(std::string("disk:method=") + method)->drops()) << method;
    EXPECT_TRUE(mapping("disk:method=rejection")->drops());
}

TEST(Disk, RoundTripOverTheWholeSquare) {
    for (const auto& method : methods) {
        SCOPED_TRACE(method);
        expect_round_trip(*mapping("disk:method=" + method), 1e-14);
        expect_round_trip(*mapping("disk:radius=1e-3,center=[5,-7],method=" + method), 12e-14);
        expect_round_trip(*mapping("disk:radius=1e150,method=" + method), 1e136);
        expect_round_trip(*mapping("disk:radius=1e-150,method=" + method), 1e-164);
    }
}

TEST(Disk, StandsHostilePoints) {
    for (const char* method : {"polar", "concentric", "naive"})
        expect_stands_hostile_points(*mapping(std::string("disk:method=") + method), 1e-14);
}

TEST(Disk, DensityIsOneOverTheJacobian) {
    for (const char* method : {"polar", "concentric", "naive"})
        expect_density_is_one_over_jacobian(
            *mapping(std::string("disk:radius=2,center=[1,0],method=") + method));
}

TEST(Disk, UnitCoordinatesComeBackAroundTheOrigin) {
    const PointSet cube = telling_points();
    for (const auto& method : methods)
        for (const std::string size : {"1", "0.3", "1e9"}) {
            const auto map = mapping("disk:method=" + method + ",radius=" + size);
            PointSet image(cube.count(), 2), back(cube.count(), 2);
            std::vector<std::uint8_t> keep(cube.count());
            map->forward(cube.flat(), image.flat(), keep);
            const bool polar = method == "polar" || method == "naive";
            for (std::size_t i = 0; i < cube.count(); ++i) {
                if (!keep[i]) continue;
                map->inverse(image[i], back[i]);
                EXPECT_NEAR(back[i][0], cube[i][0], 1e-14) << method << " " << cube[i][1];
                if (polar && image[i][0] == 0 && image[i][1] == 0) {
                    EXPECT_EQ(back[i][1], 0) << "all angles meet in the centre";
                } else if (!polar || cube[i][0] > 1e-290) {  // below, r^2 is denormal
                    EXPECT_NEAR(back[i][1], cube[i][1], 1e-14) << method << " " << cube[i][0];
                }
            }
        }
}

TEST(Disk, InverseRefusesPointsOutsideAndNamesThem) {
    const auto map = mapping("disk:radius=2,center=[1,0]");
    EXPECT_EQ(inverse_of(*map, {3, 0}), (std::vector{1.0, 0.0}));
    EXPECT_EQ(inverse_of(*map, {1, 0}), (std::vector{0.0, 0.0}));
    EXPECT_EQ(error_of([&] {
                  inverse_of(*map, {3.5, 0.25});
              }),
              "input: the point (3.5, 0.25) is outside the domain disk:radius=2,center=[1,0]");
    EXPECT_EQ(error_of([&] {
                  inverse_of(*map, {std::nan(""), 0});
              }),
              "input: the point (nan, 0) is outside the domain disk:radius=2,center=[1,0]");
    for (const auto& method : methods)
        EXPECT_NE(error_of([&] {
                      inverse_of(*mapping("disk:method=" + method), {0.8, 0.61});
                  }),
                  "");
}

TEST(Disk, DensityIsOneOverTheAreaButForNaive) {
    for (const auto& method : {"polar", "concentric", "rejection"}) {
        const auto map = mapping(std::string("disk:radius=2,center=[1,0],method=") + method);
        for (const auto& p : {std::vector{1.0, 0.0}, {2.9, 0.1}, {1.0, -2.0}})
            EXPECT_DOUBLE_EQ(map->density(p), 1 / (4 * std::numbers::pi)) << method;
        EXPECT_EQ(map->density(std::vector{4.0, 0.0}), 0) << method;
    }
    const auto naive = mapping("disk:radius=2,center=[1,0],method=naive");
    EXPECT_DOUBLE_EQ(naive->density(std::vector{1.0, 0.5}), 1 / (2 * std::numbers::pi * 2 * 0.5));
    EXPECT_EQ(naive->density(std::vector{1.0, 0.0}), std::numeric_limits<double>::infinity());
    EXPECT_EQ(naive->density(std::vector{4.0, 0.0}), 0);
}

// The mean of 1 / density over the points is the area, for all methods, including the biased one.
// Naive: 1 / density = 2 pi R^2 xi0, mean pi R^2, standard error 2 pi R^2 / sqrt(12 n) = 0.023.
TEST(Disk, DensityMatchesThePoints) {
    for (const auto& method : methods) {
        const auto map = mapping("disk:radius=2,method=" + method);
        const PointSet image = warped(*map, make("random", points(100'000, 2)));
        double sum = 0;
        for (std::size_t i = 0; i < image.count(); ++i) sum += 1 / map->density(image[i]);
        EXPECT_NEAR(sum / static_cast<double>(image.count()), 4 * std::numbers::pi, 0.12) << method;
    }
}

// P(r < R / 2) is 1/4 for points uniform by area, 1/2 for the naive method. 5 standard deviations
// of 1e5 points are 0.007 and 0.008: false alarm 1e-6 each.
TEST(Disk, NaiveIsBiasedTheOthersAreNot) {
    for (const auto& method : methods) {
        const PointSet image =
            warped(*mapping("disk:method=" + method), make("random", points(100'000, 2)));
        double inner = 0;
        for (std::size_t i = 0; i < image.count(); ++i)
            inner += std::hypot(image[i][0], image[i][1]) < 0.5;
        EXPECT_NEAR(inner / static_cast<double>(image.count()), method == "naive" ? 0.5 : 0.25,
                    0.008)
            << method;
    }
}

TEST(Disk, NaiveIsLabelledAsBiased) {
    const Warp& disk = find_warp("disk");
    EXPECT_TRUE(disk.traits.biased);
    EXPECT_NE(disk.summary.find("naive is biased"), std::string::npos);
    EXPECT_NE(disk.options.options()[0].help.find("BIASED"), std::string::npos);
}

TEST(Disk, DomainSaysWhatItIsAndParsesBack) {
    EXPECT_EQ(mapping("disk")->domain()->spec(), "disk");
    EXPECT_EQ(mapping("disk:method=naive")->domain()->spec(), "disk");
    const DomainPtr disk = mapping("disk:center=[1,0],method=concentric,radius=2")->domain();
    EXPECT_EQ(disk->spec(), "disk:radius=2,center=[1,0]");
    EXPECT_EQ(mapping(disk->spec())->domain()->spec(), disk->spec());
    EXPECT_DOUBLE_EQ(disk->measure(), 4 * std::numbers::pi);
    EXPECT_EQ(disk->dimension(), 2U);
    EXPECT_EQ(disk->cube_axes().size(), disk->cube_dimension());
    EXPECT_TRUE(disk->contains(std::vector{3.0, 0.0}));
    EXPECT_FALSE(disk->contains(std::vector{3.0 + 1e-13, 0.0}));
    EXPECT_FALSE(disk->contains(std::vector{std::nan(""), 0.0}));
}

TEST(Disk, CubeOfTheDomainIsAreaAndAngle) {
    const DomainPtr disk = mapping("disk:radius=2,center=[1,0]")->domain();
    std::vector<double> cube(2);
    disk->to_cube(std::vector{1.0, 1.0}, cube);
    EXPECT_EQ(cube, (std::vector{0.25, 0.25}));
    disk->to_cube(std::vector{3.0, 0.0}, cube);
    EXPECT_EQ(cube, (std::vector{1.0, 0.0}));
    disk->to_cube(std::vector{std::nextafter(3.0, 4), 0.0}, cube);
    EXPECT_EQ(cube, (std::vector{1.0, 0.0})) << "rounding beyond the rim stays in the cube";
    disk->to_cube(std::vector{1.0, 0.0}, cube);
    EXPECT_EQ(cube, (std::vector{0.0, 0.0}));
}

TEST(Disk, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] { mapping("disk:radius=0"); }),
              "usage: --radius: 0 is outside [1e-150, 1e+150]");
    EXPECT_NE(error_of([] { mapping("disk:radius=-1"); }), "");
    EXPECT_EQ(error_of([] { mapping("disk:center=[1,2,3]"); }),
              "usage: --center: expected 2 numbers, x,y; 3 given");
    EXPECT_EQ(error_of([] { mapping("disk:center=[0,1e30]"); }),
              "usage: --center: 1e+30 is so far from 0 that a radius of 1 is lost in rounding");
    EXPECT_NE(error_of([] { mapping("disk:method=square"); }), "");
}

}  // namespace stipple::testing::disk_test
