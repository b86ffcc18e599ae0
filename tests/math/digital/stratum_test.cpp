// SPDX-License-Identifier: MIT
#include "math/digital/stratum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "support/exact.hpp"

namespace stipple::testing::stratum_test {
namespace {

constexpr std::uint64_t most = std::uint64_t{1} << 53;

/// A stratum.
struct Stratum {
    std::uint64_t low;
    std::uint64_t width;
    std::uint64_t parts;
};

/// The stratum's point, placed alone and together with others.
double placed(const Stratum& s, double u) {
    const std::vector<double> low(2, static_cast<double>(s.low));
    double alone = u;
    place_in_strata({{low.data(), 1}, s.width, s.parts}, &alone, 1);
    double pair[] = {u, -1, u, -1};
    place_in_strata({low, s.width, s.parts}, pair, 2);
    EXPECT_EQ(pair[0], alone);
    EXPECT_EQ(pair[2], alone);
    EXPECT_EQ(pair[1], -1);
    return alone;
}

double middle(const Stratum& s) {
    const auto low = static_cast<double>(s.low);
    double x = -1;
    place_in_middles({{&low, 1}, s.width, s.parts}, &x, 1);
    return x;
}

void expect_inside(const Stratum& s, double x) {
    EXPECT_LT(x, 1);
    const Fraction scaled = exactly(x) * s.parts;
    EXPECT_TRUE(scaled >= s.low && scaled < s.low + s.width)
        << x << " for " << s.low << " + " << s.width << " of " << s.parts;
}

}  // namespace

TEST(Stratum, OfACoordinateIsExactExceptThatRoundedEdgesBelongAbove) {
    for (const std::uint64_t parts : {1U, 3U, 6U, 13U, 49U, 98U, 1000U})
        for (std::uint64_t k = 0; k < parts; ++k) {
            const double edge = static_cast<double>(k) / static_cast<double>(parts);
            EXPECT_EQ(stratum_of(edge, static_cast<double>(parts)), static_cast<double>(k));
            if (k == 0) continue;
            const double below = std::nextafter(edge, 0);
            EXPECT_EQ(stratum_of(below, static_cast<double>(parts)), static_cast<double>(k - 1))
                << k << "/" << parts;
        }
    EXPECT_EQ(stratum_of(1, 7), 6);
    EXPECT_EQ(stratum_of(one_minus_ulp, 0x1p53), 0x1p53 - 1);
}

TEST(Stratum, PlacesByTheFormula) {
    EXPECT_EQ(placed({.low = 3, .width = 1, .parts = 8}, 0.5), 3.5 / 8);
    EXPECT_EQ(placed({.low = 2, .width = 3, .parts = 8}, 0.25), 2.75 / 8);
    const std::vector<double> low = {3, 0, 5};
    std::vector<double> x = {0.5, -1, 0.25, -1, 0.75, -1};
    place_in_strata({.low = low, .width = 2, .parts = 8}, x.data(), 2);
    EXPECT_EQ(x, (std::vector<double>{4. / 8, -1, 0.5 / 8, -1, 6.5 / 8, -1}));
    place_in_middles({.low = low, .width = 2, .parts = 8}, x.data(), 2);
    EXPECT_EQ(x, (std::vector<double>{4. / 8, -1, 1. / 8, -1, 6. / 8, -1}));
    x = {0.5, 0.25, 0.75};
    place_in_strata({.low = low, .parts = 8}, x.data(), 1);
    EXPECT_EQ(x, (std::vector<double>{3.5 / 8, 0.25 / 8, 5.75 / 8}));
    place_in_middles({.low = low, .parts = 8}, x.data(), 1);
    EXPECT_EQ(x, (std::vector<double>{3.5 / 8, 0.5 / 8, 5.5 / 8}));
}

// Placing many points gives the same as placing each, also if rounding moves one to an edge.
TEST(Stratum, ManyAreAsEachAlone) {
    constexpr std::size_t count = 3000;
    for (const std::uint64_t parts : {std::uint64_t{3001}, (std::uint64_t{1} << 52) + 1})
        for (const std::uint64_t width : {1, 7}) {
            std::vector<double> low(count);
            std::vector<double> rows(count);
            std::vector<double> expected;
            Rng(2).fill(0, rows);
            for (std::size_t j = 0; j < count; ++j) {
                if (j % 3 == 0) rows[j] = one_minus_ulp;
                const std::uint64_t begin = parts - width - j * (j % 2);
                low[j] = static_cast<double>(begin);
                expected.push_back(placed({.low = begin, .width = width, .parts = parts}, rows[j]));
            }
            place_in_strata({low, width, parts}, rows.data(), 1);
            EXPECT_EQ(rows, expected);
        }
}

// Also with the extreme random numbers, in the widest and the narrowest possible strata.
TEST(Stratum, HoldsItsPointInExactArithmetic) {
    const Rng rng(3);
    std::uint64_t draw = 0;
    for (const std::uint64_t parts :
         {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{49}, std::uint64_t{1'000'003},
          (std::uint64_t{1} << 50) + 1, (std::uint64_t{1} << 52) + 1, most - 1, most})
        for (int i = 0; i < 300; ++i) {
            const std::uint64_t low = i == 0   ? 0
                                      : i == 1 ? parts - 1
                                      : i == 2 ? parts / 2
                                               : rng.below(draw++, parts);
            const std::uint64_t width = 1 + (i % 2) * rng.below(draw++, parts - low);
            const Stratum strata{.low = low, .width = width, .parts = parts};
            for (const double u : {0.0, 0x1p-53, rng.uniform(draw++), 1 - 0x1p-52, 1 - 0x1p-53})
                expect_inside(strata, placed(strata, u));
            expect_inside(strata, middle(strata));
        }
}

// 1/49 is the first for which (1 / k) * k < 1.
TEST(Stratum, HoldsItsPointAsAProgramFindsIt) {
    for (std::uint64_t parts = 1; parts < 200; ++parts)
        for (std::uint64_t low = 0; low < parts; ++low)
            for (const double u : {0.0, 0x1p-53, 0.5, 1 - 0x1p-53}) {
                const double x = placed({.low = low, .width = 1, .parts = parts}, u);
                EXPECT_EQ(std::floor(x * static_cast<double>(parts)), static_cast<double>(low))
                    << x << " in " << low << " of " << parts;
            }
}

TEST(Stratum, ListedStrataHoldTheirPointsToo) {
    const Rng rng(4);
    for (const std::uint64_t parts :
         {std::uint64_t{1}, std::uint64_t{49}, (std::uint64_t{1} << 52) + 1, most - 1, most}) {
        std::vector<double> low(600);
        std::vector<double> x(1200, -1);
        for (std::size_t j = 0; j < low.size(); ++j) {
            low[j] = static_cast<double>(j < 2 ? j * (parts - 1) : rng.below(j, parts));
            x[2 * j] = j % 3 == 0 ? 0 : j % 3 == 1 ? 1 - 0x1p-53 : rng.uniform(1000 + j);
        }
        for (const bool centered : {false, true}) {
            centered ? place_in_middles({.low = low, .parts = parts}, x.data(), 2)
                     : place_in_strata({.low = low, .parts = parts}, x.data(), 2);
            for (std::size_t j = 0; j < low.size(); ++j) {
                const auto first = static_cast<std::uint64_t>(low[j]);
                expect_inside({.low = first, .width = 1, .parts = parts}, x[2 * j]);
                EXPECT_EQ(x[2 * j + 1], -1);
            }
        }
    }
}

}  // namespace stipple::testing::stratum_test
