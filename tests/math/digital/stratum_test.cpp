// SPDX-License-Identifier: MIT
#include "math/digital/stratum.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "support/exact.hpp"

using namespace stipple;
using namespace stipple::testing;

namespace {

constexpr std::uint64_t most = std::uint64_t{1} << 53;

/// The one stratum's point, by all ways to place it.
double placed(const Strata& strata, double u) {
    double pair[] = {u, u};
    place_pairs_in_strata(strata, strata, 1, pair);
    double alone = u;
    place_in_strata(strata, 1, &alone, 1);
    EXPECT_EQ(pair[0], alone);
    EXPECT_EQ(pair[1], alone);
    if (strata.width == 1) {
        const auto low = static_cast<double>(strata.low);
        place_in_strata({&low, 1}, strata.parts, &u, 1);
        EXPECT_EQ(u, alone);
    }
    return alone;
}

double middle(const Strata& strata) {
    double x = -1;
    place_in_middles(strata, 1, &x, 1);
    if (strata.width == 1) {
        const auto low = static_cast<double>(strata.low);
        double other = -1;
        place_in_middles({&low, 1}, strata.parts, &other, 1);
        EXPECT_EQ(other, x);
    }
    return x;
}

void expect_inside(const Strata& s, double x) {
    EXPECT_LT(x, 1);
    const Fraction scaled = exactly(x) * s.parts;
    EXPECT_TRUE(scaled >= s.low && scaled < s.low + s.width)
        << x << " for " << s.low << " + " << s.width << " of " << s.parts;
}

}  // namespace

TEST(Stratum, PlacesByTheFormula) {
    EXPECT_EQ(placed({.low = 3, .width = 1, .step = 0, .parts = 8}, 0.5), 3.5 / 8);
    EXPECT_EQ(placed({.low = 2, .width = 3, .step = 0, .parts = 8}, 0.25), 2.75 / 8);
    std::vector<double> x = {0.5, 0.5, 0.25, 0.25, 0.75, 0.75};
    const Strata strata{.low = 1, .width = 2, .step = 2, .parts = 8};
    place_pairs_in_strata(strata, {.low = 1, .width = 1, .step = 0, .parts = 2}, 3, x.data());
    EXPECT_EQ(x, (std::vector<double>{2. / 8, 1.5 / 2, 3.5 / 8, 1.25 / 2, 6.5 / 8, 1.75 / 2}));
    x = {0.5, -1, 0.25, -1, 0.75, -1};
    place_in_strata(strata, 3, x.data(), 2);
    EXPECT_EQ(x, (std::vector<double>{2. / 8, -1, 3.5 / 8, -1, 6.5 / 8, -1}));
    place_in_middles(strata, 3, x.data(), 2);
    EXPECT_EQ(x, (std::vector<double>{2. / 8, -1, 4. / 8, -1, 6. / 8, -1}));
    const std::vector<double> low = {3, 0, 7};
    x = {0.5, -1, 0.25, -1, 0.75, -1};
    place_in_strata(low, 8, x.data(), 2);
    EXPECT_EQ(x, (std::vector<double>{3.5 / 8, -1, 0.25 / 8, -1, 7.75 / 8, -1}));
    place_in_middles(low, 8, x.data(), 2);
    EXPECT_EQ(x, (std::vector<double>{3.5 / 8, -1, 0.5 / 8, -1, 7.5 / 8, -1}));
}

// Many at once are placed as one by one, those among them too that rounding brings to an edge.
TEST(Stratum, ManyAreAsEachAlone) {
    constexpr std::size_t count = 3000;
    for (const std::uint64_t parts : {std::uint64_t{3001}, (std::uint64_t{1} << 52) + 1}) {
        const Strata strata{.low = parts - count, .width = 1, .step = 1, .parts = parts};
        const Strata across{.low = 5, .width = 7, .step = 0, .parts = parts};
        std::vector<double> rows(2 * count);
        Rng(2).fill(0, rows);
        std::vector<double> low;
        std::vector<double> expected;
        for (std::size_t j = 0; j < count; ++j) {
            if (j % 3 == 0) rows[2 * j] = one_minus_ulp;
            low.push_back(static_cast<double>(strata.low + j));
            const Strata alone{.low = strata.low + j, .width = 1, .step = 0, .parts = parts};
            expected.push_back(placed(alone, rows[2 * j]));
            expected.push_back(placed(across, rows[2 * j + 1]));
        }
        std::vector<double> apart = rows;
        place_in_strata(strata, count, apart.data(), 2);
        place_in_strata(across, count, apart.data() + 1, 2);
        EXPECT_EQ(apart, expected);
        apart = rows;
        place_in_strata(low, parts, apart.data(), 2);
        place_in_strata(across, count, apart.data() + 1, 2);
        EXPECT_EQ(apart, expected);
        place_pairs_in_strata(strata, across, count, rows.data());
        EXPECT_EQ(rows, expected);
    }
}

// Also with the extreme random numbers, in the widest and in the narrowest strata there can be.
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
            const Strata strata{.low = low, .width = width, .step = 0, .parts = parts};
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
                const double x = placed({.low = low, .width = 1, .step = 0, .parts = parts}, u);
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
            centered ? place_in_middles(low, parts, x.data(), 2)
                     : place_in_strata(low, parts, x.data(), 2);
            for (std::size_t j = 0; j < low.size(); ++j) {
                const auto first = static_cast<std::uint64_t>(low[j]);
                expect_inside({.low = first, .width = 1, .step = 0, .parts = parts}, x[2 * j]);
                EXPECT_EQ(x[2 * j + 1], -1);
            }
        }
    }
    std::vector<double> x = {0.5, 0.25};
    place_in_strata(std::vector<double>{3, 5}, 8, x.data(), 1);
    EXPECT_EQ(x, (std::vector<double>{3.5 / 8, 5.25 / 8}));
    place_in_middles(std::vector<double>{1, 7}, 8, x.data(), 1);
    EXPECT_EQ(x, (std::vector<double>{1.5 / 8, 7.5 / 8}));
}
