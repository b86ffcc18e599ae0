// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/units.hpp"

namespace stipple::testing::optimized_test {
namespace {

double star_of(const PointSet& points) { return measure("star-discrepancy", "value", points); }

double said(const PointSet& points) {
    EXPECT_EQ(points.provenance.found.at(0).first, "star_discrepancy");
    return std::stod(points.provenance.found.at(0).second);
}

}  // namespace

// Optima that are proven: F. Clement, C. Doerr, K. Klamroth, L. Paquete, arXiv:2311.17463, table 1.
TEST(Optimized, FindsTheOptimaThatAreKnown) {
    const double known[] = {.6180, .3660, .2847, .2500, .2000, .1667, .1500, .1328,
                            .1235, .1111, .1030, .0952, .0889, .0837, .0782, .0739};
    for (std::size_t n = 1; n <= 16; ++n) {
        const PointSet points = make("optimized", testing::points(n, 2), {{"effort", "0.4"}});
        EXPECT_NEAR(star_of(points), known[n - 1], 5.1e-5) << n;
        EXPECT_NEAR(star_of(points), said(points), 1e-12) << n;
    }
    EXPECT_NEAR(star_of(make("optimized", testing::points(20, 2))), .0604, 5.1e-5);
}

TEST(Optimized, IsBelowWhatIsPublished) {
    const PointSet points = make("optimized", testing::points(50, 2), {{"effort", "0.1"}});
    EXPECT_LT(star_of(points), 0.0274);  // by message passing (arXiv:2405.15059)
    EXPECT_NEAR(star_of(points), said(points), 1e-12);
}

TEST(Optimized, IsAFunctionOfCountSeedAndEffort) {
    const Settings little{{"effort", "0.01"}};
    const Request request = points(40, 2);
    const PointSet one = make("optimized", request, little, {.threads = 1});
    EXPECT_EQ(one, make("optimized", request, little, {.threads = 3}));
    EXPECT_NE(one, make("optimized", request, little, {.seed = 2}));
    EXPECT_NE(one, make("optimized", request, {{"effort", "0.02"}}));
}

TEST(Optimized, OnTheLineIsTheGridOfMiddles) {
    for (const std::size_t n : {1, 2, 7, 1000}) {
        const PointSet points = make("optimized", testing::points(n, 1));
        EXPECT_NEAR(star_of(points), 0.5 / static_cast<double>(n), 1e-15);
        EXPECT_EQ(said(points), 0.5 / static_cast<double>(n));
    }
}

TEST(Optimized, RefusesWhatItCannotMake) {
    EXPECT_THAT(error_of([] { make("optimized", points(64, 3)); }),
                ::testing::HasSubstr("outside [1, 2]"));
    EXPECT_THAT(
        error_of([] { make("optimized", points(20'000, 2), {}, {.max_memory = 1U << 30}); }),
        ::testing::HasSubstr("the search for an order needs"));
}

}  // namespace stipple::testing::optimized_test
