// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/criteria.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "generators/stratified/latin_hypercube_search/support.hpp"

namespace stipple::testing::latin_criteria_test {
namespace {

/// The first number in the description of a design.
double described_value(const Objective& objective, const Design& design, const Rules& rules = {}) {
    return std::stod(described(objective, design, rules, {}).at(0).second);
}

double energy_of(const Objective& objective, const Design& design, const Rules& rules,
                 double target) {
    const auto criterion = make_criterion(objective, design, rules);
    criterion->aim(target);
    return criterion->energy();
}

}  // namespace

TEST(LatinCriteria, ValuesAreThoseOfTheDefinitions) {
    for (const std::size_t n : {2, 3, 8, 9, 31})
        for (const std::size_t d : {2, 3, 7})
            for (const Kind kind : all_kinds) {
                const Design design = random_design(n, d, 10 * n + d);
                const double value = value_of(kind, design);
                const double said = described_value({.kind = kind}, design);
                EXPECT_NEAR(kind == Kind::maximin ? -said : said, value, 1e-11 * std::abs(value))
                    << n << " " << d << " " << static_cast<int>(kind);
                const auto score = make_criterion({.kind = kind}, design, {})->score();
                EXPECT_NEAR(reported({.kind = kind}, score, n, d), said, 1e-11 * std::abs(said))
                    << n << " " << d << " " << static_cast<int>(kind);
            }
}

// By hand: points (0,1), (1,3), (2,0), (3,2) have squared distances 5, 5, 10, 10, 5, 5.
TEST(LatinCriteria, OfFourPointsByHand) {
    const Design design = design_of({{1, 3, 0, 2}});
    const auto all = described({.kind = Kind::maximin}, design, {}, {});
    EXPECT_EQ(all, (std::vector<std::pair<std::string, std::string>>{{"squared_distance", "5"},
                                                                     {"pairs", "4"}}));
    EXPECT_NEAR(described_value({.kind = Kind::audze_eglais}, design), 4 / 5.0 + 2 / 10.0, 1e-15);
    EXPECT_NEAR(described_value({.kind = Kind::phi_p, .power = 1}, design),
                4 / std::sqrt(5) + 2 / std::sqrt(10), 1e-14);
    // Differences are 1 2, 2 1, 3 1, 1 3, 2 1, 1 2 quarters.
    EXPECT_NEAR(described_value({.kind = Kind::maxpro}, design),
                std::sqrt((4 * 256 / 4.0 + 2 * 256 / 9.0) / 6), 1e-13);
    EXPECT_EQ(described_value({.kind = Kind::correlation}, design), 0);
}

TEST(LatinCriteria, OfOnePointThereAreNoPairs) {
    for (const Kind kind : {Kind::maximin, Kind::phi_p, Kind::audze_eglais, Kind::maxpro})
        EXPECT_TRUE(described({.kind = kind}, Design(1, 1, 3), {}, {}).empty());
}

TEST(LatinCriteria, InfiniteOnesOfPointsThatShareLevelsAreLeftOut) {
    const Design design = design_of({{1, 1, 0, 2}});
    EXPECT_TRUE(described({.kind = Kind::maxpro}, design, {}, {}).empty());
}

/// A design with three fixed rows, and spare levels along some coordinates.
Design with_spare_rows() {
    Design design(14, 16, 4);
    for (std::size_t k = 0; k < 4; ++k) {
        const Design levels = random_design(16, 1, k);
        for (std::size_t i = 0; i < 16; ++i) design.along(k)[i] = levels.along(0)[i] % 14;
        if (k == 2) design.along(k)[15] = -1;
    }
    return design;
}

// The change by an exchange is the difference of two energies computed from scratch.
TEST(LatinCriteria, ExchangesChangeEnergiesByTheDifference) {
    const std::vector<double> outcomes = {0, 0, 0, 5, 5, 1, 1, 1, 1, 1, 1, 2, 3, 3};
    const Rules cases[] = {
        {},
        {.fixed = 3},
        {.axes = {{}, even_parts(14, 3), even_parts(14, 14), even_parts(14, 5)}},
        {.axes = {parts_by(outcomes, true), {}, parts_by(outcomes, false), even_parts(14, 2)}}};
    for (const Kind kind : all_kinds)
        for (const Rules& rules : cases)
            for (const int power : {1, 2, 15, 30}) {
                const Objective objective{kind, power};
                Design design = rules.fixed > 0 ? with_spare_rows() : random_design(14, 4, 5);
                const double target = 90;
                const auto criterion = make_criterion(objective, design, rules);
                criterion->aim(target);
                SplitMix64 draws(7);
                double largest = 1;
                for (int i = 0; i < 100; ++i) {
                    const std::size_t k = draws.below(4);
                    const std::size_t a = rules.fixed + draws.below(14 - rules.fixed);
                    const std::size_t b = rules.fixed + draws.below(design.rows - rules.fixed);
                    const auto levels = design.along(k);
                    if (a == b || levels[b] < 0) continue;
                    const double before = energy_of(objective, design, rules, target);
                    largest = std::max(largest, std::abs(before));
                    EXPECT_NEAR(criterion->energy(), before, 1e-12 * largest);
                    const double change = criterion->change(k, a, b);
                    std::swap(levels[a], levels[b]);
                    const double after = energy_of(objective, design, rules, target);
                    EXPECT_NEAR(change, after - before,
                                1e-10 * (1 + std::abs(before) + std::abs(after)))
                        << static_cast<int>(kind) << " " << power << " exchange " << i;
                    criterion->exchange(k, a, b, change);
                }
            }
}

TEST(LatinCriteria, EnergiesOfDistancesAreWholeNumbers) {
    const Design design = design_of({{1, 3, 0, 2}});  // squared distances 5 and 10
    const auto criterion = make_criterion({}, design, {});
    criterion->aim(5);
    EXPECT_TRUE(criterion->reached());
    criterion->aim(7);
    EXPECT_EQ(criterion->energy(), 4 * 2);
    criterion->aim(12);
    EXPECT_EQ(criterion->energy(), 4 * 7 + 2 * 2);
    EXPECT_EQ(criterion->score().value, -5);
    EXPECT_EQ(criterion->score().second, 4);
}

// Twelve levels in three parts count as the midpoints 1.5, 5.5, 9.5, rounded down.
TEST(LatinCriteria, LevelsOfAPartCountAsItsMiddle) {
    for (Level level = 0; level < 12; ++level) {
        EXPECT_EQ(even_parts(12, 0).place(level), level);
        EXPECT_EQ(even_parts(12, 12).place(level), level);
        EXPECT_EQ(even_parts(12, 3).place(level), 1 + 4 * (level / 4));
        EXPECT_EQ(even_parts(12, 1).place(level), 5);
    }
    EXPECT_EQ(even_parts(12, 3).place(-1), -1);
    for (const Level parts : {2, 3, 7, 10})
        for (Level level = 0; level < 10; ++level) {
            const double middle = 10 * (std::floor((level + 0.5) * parts / 10) + 0.5) / parts - 0.5;
            EXPECT_EQ(even_parts(10, parts).place(level),
                      static_cast<Level>(std::floor(middle + 1e-9)))
                << parts << " " << level;
        }
}

// Of ten levels, 12 of 45 pairs have the same outcome, and the mean squared distance of two levels
// is 110 / 6.
TEST(LatinCriteria, CategoriesAreAsFarApartAsOtherAxesAreOnAverage) {
    const std::vector<double> outcomes = {2, 2, 2, 2, 7, 7, 7, 4, 4, 4};
    const Axis ordered = parts_by(outcomes, false);
    EXPECT_THAT(ordered.places, ::testing::ElementsAre(1, 1, 1, 1, 5, 5, 5, 8, 8, 8));
    EXPECT_EQ(ordered.parts, 3);
    EXPECT_EQ(ordered.square(1, 8), 49);
    const Axis categories = parts_by(outcomes, true);
    EXPECT_EQ(categories.places, ordered.places);
    EXPECT_EQ(categories.square(5, 5), 0);
    EXPECT_EQ(categories.square(1, 8), std::round(110 / 6.0 * 45 / (45 - 12)));
    EXPECT_EQ(categories.square(1, 5), categories.square(5, 8));
    EXPECT_EQ(parts_by(std::vector<double>{3, 3}, true).square(0, 0), 0);
}

}  // namespace stipple::testing::latin_criteria_test
