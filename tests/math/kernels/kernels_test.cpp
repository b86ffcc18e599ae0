// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "math/kernels/kernel.hpp"
#include "support/units.hpp"

namespace stipple::testing::kernels_test {
namespace {

using Wide = long double;

/// |found - exact|, for comparison with a tolerance.
double off(Wide found, Wide exact) { return static_cast<double>(std::abs(found - exact)); }

/// Integral of a function that is smooth except at 1/2 and at `bend`.
Wide integral(const std::function<Wide(Wide)>& f, Wide low, Wide high, Wide bend) {
    constexpr int parts = 10;
    using Gauss = boost::math::quadrature::gauss<Wide, 30>;
    const std::array<Wide, 4> ends = {low, std::min(bend, Wide(0.5)), std::max(bend, Wide(0.5)),
                                      high};
    Wide sum = 0;
    for (std::size_t e = 0; e < 3; ++e) {
        const Wide size = (ends[e + 1] - ends[e]) / parts;
        for (int i = 0; i < parts && size > 0; ++i)
            sum += Gauss::integrate(f, ends[e] + i * size, ends[e] + (i + 1) * size);
    }
    return sum;
}

/// A kernel on an axis by its definition.
using AxisKernel = std::function<Wide(Wide, Wide)>;

struct Case {
    std::string name;
    std::function<kernels::KernelPtr(std::size_t)> make;
    AxisKernel axis;
};

AxisKernel gaussian_axis(Wide h) {
    return [h](Wide x, Wide y) { return std::exp(-(x - y) * (x - y) / (2 * h * h)); };
}

AxisKernel matern_axis(Wide h, unsigned order) {
    return [h, order](Wide x, Wide y) {
        const Wide a = std::sqrt(Wide(2 * order + 1)) * std::abs(x - y) / h;
        return (1 + (order > 0 ? a : 0) + (order > 1 ? a * a / 3 : 0)) * std::exp(-a);
    };
}

std::vector<Case> cases() {
    std::vector<Case> all = {{"periodic", kernels::periodic, [](Wide x, Wide y) {
                                  const Wide t = std::abs(x - y);
                                  const Wide pi = std::numbers::pi_v<Wide>;
                                  return 1 + 2 * pi * pi * (Wide(1) / 6 - t + t * t);
                              }}};
    for (const double h : {0.01, 0.2, 0.7, 5.0, 300.0}) {
        all.push_back({fmt::format("gaussian {}", h),
                       [h](std::size_t d) { return kernels::gaussian(d, h); }, gaussian_axis(h)});
        for (const unsigned order : {0U, 1U, 2U})
            all.push_back({fmt::format("matern {} {}", order, h),
                           [h, order](std::size_t d) { return kernels::matern(d, h, order); },
                           matern_axis(h, order)});
    }
    const auto l2 = [&](l2::Kind kind, const AxisKernel& axis) {
        all.push_back({std::string(l2::record_of(kind).name),
                       [kind](std::size_t d) { return kernels::of_l2(d, kind); }, axis});
    };
    const auto bend = [](Wide x) { return std::abs(x - Wide(0.5)); };
    l2(l2::Kind::star, [](Wide x, Wide y) { return 1 - std::max(x, y); });
    l2(l2::Kind::average, [](Wide x, Wide y) { return (1 - std::abs(x - y)) / 2; });
    l2(l2::Kind::centered,
       [bend](Wide x, Wide y) { return 1 + (bend(x) + bend(y) - std::abs(x - y)) / 2; });
    l2(l2::Kind::wraparound, [](Wide x, Wide y) {
        const Wide t = std::abs(x - y);
        return Wide(1.5) - t + t * t;
    });
    l2(l2::Kind::mixture, [bend](Wide x, Wide y) {
        const Wide t = std::abs(x - y);
        return Wide(1.875) - (bend(x) + bend(y) + 3 * t) / 4 + t * t / 2;
    });
    return all;
}

/// Corners, duplicates and points in general places.
PointSet some_points(std::size_t d) {
    PointSet set = make("random", points(700, d), {}, {.seed = d});
    for (std::size_t k = 0; k < d; ++k) {
        set[0][k] = 0;
        set[1][k] = 1;
        set[2][k] = 0.5;
        set[4][k] = set[3][k];
    }
    return set;
}

Wide product(const Case& kernel, std::span<const double> x, std::span<const double> y) {
    Wide value = 1;
    for (std::size_t k = 0; k < x.size(); ++k) value *= kernel.axis(x[k], y[k]);
    return value;
}

Wide axis_mean(const Case& kernel, Wide x) {
    return integral([&](Wide y) { return kernel.axis(x, y); }, 0, 1, x);
}

}  // namespace

TEST(Kernels, ValuesAreThoseOfTheirDefinitions) {
    for (const Case& kernel : cases())
        for (const std::size_t d : {1, 2, 5}) {
            const PointSet set = some_points(d);
            const kernels::Columns columns(set.flat(), d);
            const auto made = kernel.make(d);
            std::vector<double> values(600);
            made->fill(set[5].data(), columns, 0, 512, values.data());
            made->fill(set[5].data(), columns, 512, 88, values.data() + 512);
            double largest = 0;
            for (const std::size_t i : {0, 1, 2, 5}) {
                const double own = made->diagonal(set[i].data());
                EXPECT_LE(off(own, product(kernel, set[i], set[i])), 1e-13 * std::max(own, 1.0));
                largest = std::max(largest, own);
            }
            for (std::size_t j = 0; j < 600; ++j)
                EXPECT_LE(off(values[j], product(kernel, set[5], set[j])),
                          made->rounding() * largest)
                    << kernel.name << ", d = " << d << ", point " << j;
        }
}

TEST(Kernels, MeansOverTheCubeAreThoseOfQuadrature) {
    for (const Case& kernel : cases()) {
        const auto line = kernel.make(1);
        for (const double x : {0.0, 0.013, 0.3, 0.5, 0.875, 1.0})
            EXPECT_LE(off(line->mean(&x), axis_mean(kernel, x)), 1e-15)
                << kernel.name << " at " << x;
        const Wide half = 0.5;  // where some means have a kink
        const Wide total = integral([&](Wide x) { return axis_mean(kernel, x); }, 0, 1, half);
        const Wide own = integral([&](Wide x) { return kernel.axis(x, x); }, 0, 1, half);
        EXPECT_LE(off(line->total(), total), 1e-15) << kernel.name;
        EXPECT_LE(off(line->mean_diagonal(), own), 1e-15 * static_cast<double>(own)) << kernel.name;
        const auto space = kernel.make(3);
        const std::array<double, 3> x = {0.2, 0.9, 1};
        EXPECT_LE(off(space->mean(x.data()),
                      axis_mean(kernel, x[0]) * axis_mean(kernel, x[1]) * axis_mean(kernel, x[2])),
                  4e-15)
            << kernel.name;
        EXPECT_LE(off(space->total(), total * total * total), 4e-15) << kernel.name;
    }
}

// The definition, with derivatives of the base kernel by differences in long double.
TEST(Kernels, SteinIsTheOperatorOnTheBaseKernel) {
    constexpr double h = 0.8;
    constexpr Wide step = 1e-4L;
    const auto base = [](const std::array<Wide, 2>& x, const std::array<Wide, 2>& y) {
        const Wide square = (x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]);
        return 1 / std::sqrt(1 + square / (Wide(h) * h));
    };
    const PointSet set = make("random", points(40, 4), {}, {.seed = 3});
    const kernels::Columns columns(set.flat(), 4);
    const auto made = kernels::stein(2, h);
    std::vector<double> values(40);
    for (std::size_t i = 0; i < 40; ++i) {
        made->fill(set[i].data(), columns, 0, 40, values.data());
        EXPECT_LE(off(values[i], made->diagonal(set[i].data())), 1e-14);
        for (std::size_t j = 0; j < 40; ++j) {
            const std::array<Wide, 2> x = {set[j][0], set[j][1]};
            const std::array<Wide, 2> y = {set[i][0], set[i][1]};
            const auto moved = [&](std::array<Wide, 2> p, std::size_t k, int way) {
                p[k] += way * step;
                return p;
            };
            Wide sum = 0;
            for (std::size_t k = 0; k < 2; ++k) {
                const Wide sx = set[j][2 + k];
                const Wide sy = set[i][2 + k];
                const Wide by_x = (base(moved(x, k, 1), y) - base(moved(x, k, -1), y)) / (2 * step);
                const Wide by_y = (base(x, moved(y, k, 1)) - base(x, moved(y, k, -1))) / (2 * step);
                const Wide both =
                    (base(moved(x, k, 1), moved(y, k, 1)) - base(moved(x, k, 1), moved(y, k, -1)) -
                     base(moved(x, k, -1), moved(y, k, 1)) +
                     base(moved(x, k, -1), moved(y, k, -1))) /
                    (4 * step * step);
                sum += sx * sy * base(x, y) + sx * by_y + sy * by_x + both;
            }
            EXPECT_LE(off(values[j], sum), 1e-6) << i << ", " << j;
        }
    }
}

// Stein's identity on a line, for the standard normal distribution and for Laplace-like tails.
TEST(Kernels, SteinHasTheMeanZeroUnderItsTarget) {
    const auto kernel = kernels::stein(1, 0.7);
    for (const double x : {-2.5, 0.0, 0.3, 4.0}) {
        const double at[] = {x, -x};
        const auto value = [&](Wide y) {
            const std::vector<double> row = {static_cast<double>(y), static_cast<double>(-y)};
            double k = 0;
            kernel->fill(at, kernels::Columns(row, 1 + 1), 0, 1, &k);
            return k * std::exp(-y * y / 2);
        };
        EXPECT_LE(off(integral(value, -12, 12, x), 0), 1e-13) << x;
    }
}

// K_XX - 2 K_XY + K_YY by the definition, in long double.
TEST(PairSums, AreThoseOfTheDefinition) {
    const PointSet set = some_points(2);
    const PointSet others = make("random", points(130, 2), {}, {.seed = 8});
    const kernels::Columns x(set.flat(), 2);
    const kernels::Columns y(others.flat(), 2);
    for (const Case& kernel : cases()) {
        const auto mean = [&](const PointSet& a, const PointSet& b) {
            Wide sum = 0;
            for (std::size_t i = 0; i < a.count(); ++i)
                for (std::size_t j = 0; j < b.count(); ++j) sum += product(kernel, a[i], b[j]);
            return sum / static_cast<Wide>(a.count() * b.count());
        };
        const Wide exact = mean(set, set) - 2 * mean(set, others) + mean(others, others);
        const auto found = kernels::squared_from_points(*kernel.make(2), x, y, {});
        EXPECT_LE(off(found.squared, exact), found.error) << kernel.name;
        EXPECT_LE(off(found.squared, exact), 1e-14) << kernel.name;
        EXPECT_LT(found.error, 1e-12) << kernel.name;
    }
}

TEST(PairSums, AreTheSameInAnyOrder) {
    const PointSet set = some_points(3);
    PointSet turned = set;
    for (std::size_t i = 0; i < set.count(); ++i)
        std::ranges::copy(set[i], turned[set.count() - 1 - i].begin());
    const kernels::Columns x(set.flat(), 3);
    const kernels::Columns y(turned.flat(), 3);
    for (const Case& kernel : cases()) {
        const auto made = kernel.make(3);
        const bool symmetric = kernel.name == "periodic" || kernel.name.starts_with("gaussian") ||
                               kernel.name.starts_with("matern");
        if (symmetric) {  // equal to the last bit
            EXPECT_EQ(kernels::squared_from_points(*made, x, y, {}).squared, 0) << kernel.name;
        }
        EXPECT_LE(off(kernels::squared_from_mean(*made, x, {}).squared,
                      kernels::squared_from_mean(*made, y, {}).squared),
                  1e-14)
            << kernel.name;
    }
}

TEST(Bandwidth, IsTheMedianDistanceOfAllPoints) {
    const PointSet line = points_of({{0}, {1}, {3}});  // distances 1, 2, 3
    const PointSet one = points_of({{3}});             // together 0, 1, 2, 2, 3, 3
    const kernels::Columns none(std::span<const double>(), 1);
    EXPECT_EQ(kernels::median_distance({line.flat(), 1}, none, 1).value, 2);
    EXPECT_EQ(kernels::median_distance({line.flat(), 1}, {one.flat(), 1}, 1).value, 2);
    EXPECT_DOUBLE_EQ(kernels::uniform_distance(6), 1);
    // The median distance in the unit square is 0.5120.
    const PointSet many = make("random", points(30'000, 2));
    EXPECT_LE(off(kernels::median_distance({many.flat(), 2}, none, 2).value, 0.512), 0.01);
}

}  // namespace stipple::testing::kernels_test
