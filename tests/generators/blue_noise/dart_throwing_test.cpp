// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "generators/box_space.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::dart_throwing_test {
namespace {

const Space square{{{0, 0}, {1, 1}}, true};

}  // namespace

TEST(DartThrowing, RelaxedRadiusHoldsForEveryPairInAnyBox) {
    for (const Space& space : some_spaces())
        for (const std::uint64_t n : {1, 2, 3, 7, 200}) {
            const PointSet set = make_in("dart-throwing", space, n);
            EXPECT_EQ(set.count(), n) << space.name();
            EXPECT_GT(noted(set, "radius"), 0);
            EXPECT_GE(smallest_distance(set, space), noted(set, "radius")) << space.name();
            expect_inside(set, space);
        }
}

TEST(DartThrowing, FixedRadiusHoldsForEveryPairInAnyBox) {
    for (const Space& space : some_spaces()) {
        double r = 0;
        for (std::size_t k = 0; k < space.box.dimension(); ++k)
            r = std::max(r, space.box.extent(k) / 12);
        const PointSet set = make_in("dart-throwing", space, {}, {{"radius", format_number(r)}});
        EXPECT_GT(set.count(), 4U) << space.name();
        EXPECT_GE(smallest_distance(set, space), r) << space.name();
        expect_inside(set, space);
    }
}

// The distance of the first two points is at most 1/2 in [0, 1), and half the diagonal in a square.
TEST(DartThrowing, TwoPointsStartAsFarApartAsDartsReach) {
    const Space line{{{0}, {1}}, true};
    EXPECT_GT(smallest_distance(make_in("dart-throwing", line, 2), line), 0.45);
    EXPECT_GT(smallest_distance(make_in("dart-throwing", square, 2), square), 0.6);
}

// Estimates of memory and progress use the densities at which no space is left.
TEST(DartThrowing, ComesNearTheSaturatedDensityInAnyDimension) {
    const std::vector<double> radii{0.002, 0.03, 0.1, 0.2, 0.3, 0.4};
    for (std::size_t d = 1; d <= 6; ++d) {
        const double r = radii[d - 1];
        const PointSet set = make("dart-throwing", {.dimension = d},
                                  {{"radius", format_number(r)}, {"misses", "20000"}});
        const double density = static_cast<double>(set.count()) * std::pow(r, d);
        EXPECT_LT(density, 1.02 * saturated_density[d]) << d;
        EXPECT_GT(density, 0.6 * saturated_density[d]) << d;
    }
}

// A fixed radius gives the plain process: each dart that fits is kept.
TEST(DartThrowing, FixedRadiusIsThePlainProcess) {
    const PointSet set = make("dart-throwing", {}, {{"radius", "0.07"}}, {.seed = 5});
    const Rng rng(5);
    std::vector<std::vector<double>> kept;
    for (std::uint64_t dart = 0, misses = 0; misses < 200; ++dart) {
        const std::vector<double> p{rng.uniform(2 * dart), rng.uniform(2 * dart + 1)};
        const bool fits = std::ranges::all_of(
            kept, [&](const auto& q) { return distance(p, q, square) >= 0.07; });
        if (fits) kept.push_back(p);
        misses = fits ? 0 : misses + 1;
    }
    EXPECT_EQ(set, points_of(kept));
}

// Jamming densities of random sequential addition: Renyi's constant 0.7476 for cars on a line, and
// n r^2 = 0.6966 in the plane (A. M. Feder, J. Theor. Biol. 87 (1980): coverage 0.547), which is
// approached slowly, as darts^(-1/2).
TEST(DartThrowing, ManyMissesComeNearTheJammingDensity) {
    const auto packed = [](std::size_t d, const char* r, const char* misses) {
        return static_cast<double>(
            make("dart-throwing", {.dimension = d}, {{"radius", r}, {"misses", misses}}).count());
    };
    EXPECT_NEAR(packed(1, "0.0002", "20000") * 0.0002, 0.7476, 0.008);
    EXPECT_NEAR(packed(2, "0.02", "20000") * 0.0004, 0.675, 0.015);
    EXPECT_LT(packed(2, "0.02", "1") * 0.0004, 0.4);
}

// Point i does not depend on n, and keeps the radius of its step: prefixes are spread, too.
TEST(DartThrowing, EveryPrefixIsTheSetOfItsCount) {
    const PointSet whole = make("dart-throwing", points(500, 2));
    double last = 1;
    for (const std::uint64_t n : {1, 2, 10, 100, 499}) {
        const PointSet part = make("dart-throwing", points(n, 2));
        EXPECT_TRUE(std::ranges::equal(part.flat(), whole.flat().first(2 * n)));
        const double r = noted(part, "radius");
        EXPECT_LE(r, last);
        EXPECT_GE(smallest_distance(part, square), r);
        EXPECT_GT(r * r * static_cast<double>(n), n > 2 ? 0.5 : 0.1) << n;
        last = r;
    }
}

TEST(DartThrowing, PatiencePacksCloser) {
    const auto radius = [](const char* misses) {
        double sum = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed)
            sum +=
                noted(make("dart-throwing", points(300, 2), {{"misses", misses}}, {.seed = seed}),
                      "radius");
        return sum;
    };
    EXPECT_GT(radius("2000"), 1.01 * radius("20"));
}

TEST(DartThrowing, RadiusShrinksByTheFactorAsked) {
    double r = noted(make("dart-throwing", points(300, 2), {{"shrink", "0.5"}}), "radius");
    EXPECT_LT(r, 0.05);
    while (r < 0.7) r *= 2;
    EXPECT_EQ(r, std::sqrt(0.5));
}

// Densities 1 and 4 side by side, and 0 on the right.
struct ThreeColumns {
    TemporaryFile file{npy_of<double>("<f8", "(1, 3)", {1, 4, 0})};
    Space space;

    [[nodiscard]] double middle(double part) const {  ///< centre of a part of the first axis
        return space.box.low[0] + part * (space.box.high[0] - space.box.low[0]);
    }
    /// Radius at a point, relative to that at the largest density.
    [[nodiscard]] double times(std::span<const double> p) const {
        return p[0] < middle(1.0 / 3) ? 2 : 1;
    }
    /// Whether the distance of two points is at least the smaller of their radii.
    [[nodiscard]] bool fits(std::span<const double> p, std::span<const double> q, double r) const {
        return distance(p, q, space) >= r * std::min(times(p), times(q));
    }
};

// With a fixed radius, darts are distributed like the density, and each that fits is kept.
TEST(DartThrowing, WithADensityIsThePlainProcessOfDartsThatFollowIt) {
    for (const bool torus : {true, false}) {
        const ThreeColumns columns{.space = {{{-3, 10}, {6, 13}}, torus}};
        const PointSet set = make_in("dart-throwing", columns.space, {},
                                     {{"radius", "0.15"}, {"density", columns.file.path()}}, 5);
        const Rng rng(5);
        std::vector<std::vector<double>> kept;
        for (std::uint64_t dart = 0, misses = 0; misses < 200; ++dart) {
            const double u = rng.uniform(2 * dart);
            const double x = u < 0.2 ? u / 0.2 / 3 : (1 + (u - 0.2) / 0.8) / 3;
            const std::vector<double> p{columns.middle(x), 10 + 3 * rng.uniform(2 * dart + 1)};
            const bool fits =
                std::ranges::all_of(kept, [&](const auto& q) { return columns.fits(p, q, 0.15); });
            if (fits) kept.push_back(p);
            misses = fits ? 0 : misses + 1;
        }
        ASSERT_EQ(set.count(), kept.size());
        EXPECT_GT(set.count(), 250U);
        for (std::size_t i = 0; i < kept.size(); ++i)
            for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(set[i][k], kept[i][k], 1e-12) << i;
    }
}

// Every pair keeps the reported radius, although it was relaxed by a factor of a hundred. A fifth
// of the points is on the left, and prefixes are the sets of smaller counts.
TEST(DartThrowing, RelaxedRadiusFollowsADensity) {
    for (const bool torus : {true, false}) {
        const ThreeColumns columns{.space = {{{-3, 10}, {6, 13}}, torus}};
        const Settings settings{{"density", columns.file.path()}};
        const PointSet set = make_in("dart-throwing", columns.space, 1200, settings);
        ASSERT_EQ(set.count(), 1200U);
        const double r = noted(set, "radius");
        EXPECT_GT(r * r * 1200, 0.5 * (3 * 3 + 3 * 3 / 4.0));
        double left = 0;
        for (std::size_t i = 0; i < set.count(); ++i) {
            EXPECT_LT(set[i][0], columns.middle(2.0 / 3));
            left += columns.times(set[i]) - 1;
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_TRUE(columns.fits(set[i], set[j], r * (1 - 1e-12))) << i << " " << j;
        }
        EXPECT_NEAR(left / 1200, 0.2, 0.04);  // 3.5 standard deviations of random points
        const PointSet part = make_in("dart-throwing", columns.space, 400, settings);
        EXPECT_TRUE(std::ranges::equal(part.flat(), set.flat().first(800)));
    }
}

// In six dimensions more darts fit than 0.8 / r^6: 475 points with 420 bytes each.
TEST(DartThrowing, MemoryIsThereForAllPointsOfARadius) {
    const auto within = [](std::uint64_t bytes) {
        return [bytes] {
            const Settings settings = {{"radius", "0.35"}, {"misses", "20000"}};
            const PointSet set =
                make("dart-throwing", {.dimension = 6}, settings, {.max_memory = bytes});
            EXPECT_LE(set.count() * 420, bytes);
        };
    };
    EXPECT_EQ(error_of(within(190'000)).substr(0, 6), "limit:");
    EXPECT_EQ(error_of(within(330'000)), "");
}

TEST(DartThrowing, RefusesWhatContradictsItselfOrFindsNoPlace) {
    const auto refusal = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("dart-throwing", request, settings, {.max_memory = 1 << 26}); });
    };
    EXPECT_EQ(refusal({}, {{"torus", "true"}, {"bounded", "true"}}),
              "usage: --torus contradicts --bounded; give one of them");
    EXPECT_EQ(refusal({}, {{"radius", "0.1"}, {"shrink", "0.9"}}),
              "usage: --shrink contradicts --radius, which fixes the radius; give one of them");
    EXPECT_EQ(refusal({}, {{"invert", "true"}}),
              "usage: --invert: there is no --density to invert");
    EXPECT_EQ(refusal(points(9, 3), {{"density", "x.png"}}),
              "usage: --dimension: 3 is not 2, the dimension of a --density");
    EXPECT_EQ(refusal({}, {{"radius", "0.8"}}),
              "usage: --radius: 0.8 is outside (0, 0.7071067811865476]; no two points of the box "
              "are farther apart");
    // Coordinates are rounded to 1/8: the radius shrank until its square was 0, and points coincided.
    const double far = 1e15;
    const Box coarse{{far, far}, {far + 1000, far + 1000}};
    EXPECT_EQ(refusal({.count = 100, .bounds = coarse}, {}).substr(0, 18), "limit: a radius of");
    const std::string few = refusal(points(1000, 2), {{"radius", "0.1"}});
    EXPECT_TRUE(few.starts_with("limit: only ")) << few;
    EXPECT_NE(few.find(" points were placed with a radius of 0.1 before 200 darts in a row were "
                       "rejected; 1000 were requested"),
              std::string::npos)
        << few;
    EXPECT_EQ(refusal({}, {{"radius", "1e-6"}}).substr(0, 6), "limit:");
    EXPECT_EQ(refusal(points(100'000'000, 2), {}).substr(0, 6), "limit:");
    EXPECT_EQ(refusal({.dimension = 3, .bounds = Box{{0, 0}, {1, 1}}}, {}),
              "usage: --bounds: 2 ranges for 3 coordinates");
    EXPECT_NE(refusal({.bounds = Box{{0, 0}, {1e-200, 1e-200}}}, {}), "");
    EXPECT_EQ(make("dart-throwing", points(50, 2), {{"radius", "0.1"}}).count(), 50U);
}

}  // namespace stipple::testing::dart_throwing_test
