// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/rng.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/units.hpp"

namespace stipple::testing::gaussian_blue_noise_test {
namespace {

const std::string name = "gaussian-blue-noise";

/// Largest radial power at frequencies from 1 up to `most`.
double largest_power(const PointSet& set, double most) {
    const Report report = analyze("periodogram", set);
    const auto& frequency = report.curve("radial.frequency");
    const auto& power = report.curve("radial.power");
    double largest = 0;
    for (std::size_t i = 0; i < power.size(); ++i)
        if (frequency[i] < most) largest = std::max(largest, power[i]);
    return largest;
}

/// |mean over points of the mean over six nearest neighbours of exp(6 i angle)|: 1 for a hexagonal
/// lattice.
double hexagonal_order(const PointSet& set) {
    std::complex<double> sum;
    for (std::size_t i = 0; i < set.count(); ++i) {
        std::vector<std::pair<double, double>> near;
        for (std::size_t j = 0; j < set.count(); ++j) {
            if (j == i) continue;
            double x = set[j][0] - set[i][0];
            double y = set[j][1] - set[i][1];
            x -= std::round(x);
            y -= std::round(y);
            near.emplace_back(x * x + y * y, std::atan2(y, x));
        }
        std::ranges::partial_sort(near, near.begin() + 6);
        for (std::size_t k = 0; k < 6; ++k) sum += std::polar(1.0, 6 * near[k].second);
    }
    return std::abs(sum) / (6 * static_cast<double>(set.count()));
}

double smallest_distance(const PointSet& set) {
    double least = 1;
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < set.dimension(); ++k) {
                const double t = set[i][k] - set[j][k];
                sum += (t - std::round(t)) * (t - std::round(t));
            }
            least = std::min(least, std::sqrt(sum));
        }
    return least;
}

PointSet make_in_box(const Box& box, const Settings& settings) {
    Request request = points(300, 2);
    request.bounds = box;
    return make(name, request, settings);
}

}  // namespace

// Half of sqrt(n) is 16 for 1024 points. White noise has power 1 everywhere.
TEST(GaussianBlueNoise, SpectrumIsEmptyAtLowFrequencies) {
    const PointSet set = make(name, points(1024, 2), {{"iterations", "200"}});
    EXPECT_LT(largest_power(set, 16), 1e-3);
    EXPECT_LT(largest_power(set, 10), 1e-6);
    EXPECT_GT(largest_power(make("random", points(1024, 2)), 10), 0.5);
}

TEST(GaussianBlueNoise, MoreIterationsEmptyMoreOfTheSpectrum) {
    double last = 2;
    for (const char* iterations : {"10", "50", "200"}) {
        const double power =
            largest_power(make(name, points(512, 2), {{"iterations", iterations}}), 14);
        EXPECT_LT(power, 0.5 * last) << iterations;
        last = power;
    }
}

// Random points have an order of about 0.02; 0.3 would be visible as grains of a lattice.
TEST(GaussianBlueNoise, IsNoHexagonalLattice) {
    EXPECT_LT(hexagonal_order(make(name, points(1024, 2), {{"iterations", "200"}})), 0.2);
    EXPECT_GT(hexagonal_order(make("hexagonal", points(1024, 2))), 0.9);
}

TEST(GaussianBlueNoise, KeepsPointsApartInEveryDimension) {
    for (const auto& [d, n] : std::vector<std::pair<std::size_t, std::uint64_t>>{
             {1, 100}, {2, 500}, {3, 300}, {4, 40}}) {
        const PointSet set = make(name, points(n, d), {{"iterations", "60"}});
        const double spacing = std::pow(static_cast<double>(n), -1 / static_cast<double>(d));
        // Averages of random points: 0.01, 0.03, 0.13 and 0.4.
        const double least = d > 2 ? (d > 3 ? 0.45 : 0.25) : 0.5;
        EXPECT_GT(smallest_distance(set), least * spacing) << d << "-D";
        for (const double x : set.flat()) EXPECT_TRUE(x >= 0 && x < 1);
    }
}

TEST(GaussianBlueNoise, WithoutIterationsItIsRandom) {
    const PointSet set = make(name, points(50, 2), {{"iterations", "0"}});
    for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(set.flat()[i], Rng(1).uniform(i), 1e-15);
}

TEST(GaussianBlueNoise, MakesVeryFewPoints) {
    for (const std::uint64_t n : {1, 2, 3}) EXPECT_EQ(make(name, points(n, 2)).count(), n);
    // Two points are optimal at opposite ends of a diagonal: both coordinates differ by one half.
    const PointSet two = make(name, points(2, 2));
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(std::abs(two[0][k] - two[1][k]), 0.5, 1e-3);
}

// Random points have a tenth of this distance; a square set squashed into the box has sqrt(a / b)
// of it.
TEST(GaussianBlueNoise, DistancesHoldInTheBox) {
    for (const Box& box : std::vector<Box>{{{-4, 2}, {8, 3}}, {{1e3, 0}, {1e3 + 1, 7.3}}}) {
        const PointSet plain = make_in_box(box, {{"iterations", "100"}});
        const Space space{box, true};
        expect_inside(plain, space);
        const double spacing = std::sqrt(box.extent(0) * box.extent(1) / 300);
        EXPECT_GT(stipple::testing::smallest_distance(plain, space), 0.5 * spacing);
        const TemporaryFile file(png_of(2, 2, {200, 100, 100, 200}));
        const PointSet dense = make_in_box(box, {{"iterations", "100"}, {"density", file.path()}});
        expect_inside(dense, space);
        EXPECT_GT(stipple::testing::smallest_distance(dense, space), 0.4 * spacing);
    }
}

TEST(GaussianBlueNoise, ABoxOfEqualSidesIsAScaledSquare) {
    const PointSet unit = make(name, points(100, 2), {{"iterations", "30"}});
    Request request = points(100, 2);
    request.bounds = Box{{0, 4}, {2, 6}};
    const PointSet scaled = make(name, request, {{"iterations", "30"}});
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(scaled[i][0], 2 * unit[i][0]);
        EXPECT_EQ(scaled[i][1], 4 + 2 * unit[i][1]);
    }
}

// The density is ink: the left half is black, the right white.
TEST(GaussianBlueNoise, FollowsADensity) {
    const TemporaryFile file(png_of(2, 1, {0, 255}));
    const Settings settings{{"density", file.path()}, {"iterations", "5"}};
    for (const double x : {0.0, 0.5}) {
        Settings all = settings;
        if (x == 0) all.emplace_back("invert", "true");
        const PointSet set = make(name, points(200, 2), all);
        for (std::size_t i = 0; i < 200; ++i) EXPECT_TRUE(set[i][0] >= x && set[i][0] < x + 0.5);
    }
}

TEST(GaussianBlueNoise, RefusesWrongOptionsInOneLine) {
    EXPECT_EQ(error_of([] {
                  make(name, points(9, 2), {{"invert", "true"}});
              }),
              "usage: --invert: there is no --density to invert");
    EXPECT_EQ(error_of([] {
                  make(name, points(9, 3), {{"density", "d.png"}});
              }),
              "usage: --dimension: 3 is not 2, the dimension of a --density");
    EXPECT_EQ(error_of([] {
                  make(name, points(9, 2), {{"density", "/nowhere.png"}});
              }),
              "io: /nowhere.png: no such file");
    EXPECT_EQ(error_of([] {
                  Request request = points(9, 2);
                  request.bounds = Box{{0, 0}, {1, 1e4}};
                  make(name, request);
              }),
              "usage: --bounds: 0..1,0..10000 has a side 10000 times as long as another; expected "
              "1000 times at most");
}

}  // namespace stipple::testing::gaussian_blue_noise_test
