// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>

#include "experiments/designs/regular_fraction.hpp"
#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::fractional_factorial_test {
namespace {

constexpr const char* unit = "fractional-factorial";

/// Oracle: words of each length, found as constant products of columns.
std::string words_by_products(const PointSet& coded) {
    std::map<int, int> lengths;
    for (std::uint32_t set = 1; set < 1U << coded.dimension(); ++set) {
        double sum = 0;
        for (std::size_t i = 0; i < coded.count(); ++i) {
            double product = 1;
            for (std::size_t k = 0; k < coded.dimension(); ++k)
                if ((set >> k & 1) != 0) product *= coded[i][k];
            sum += product;
        }
        if (std::abs(sum) == static_cast<double>(coded.count())) ++lengths[std::popcount(set)];
    }
    std::string text;
    for (const auto& [length, count] : lengths)
        text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", count, length);
    return text;
}

PointSet by_resolution(std::size_t factors, int resolution) {
    return coded_design(unit, {.dimension = factors}, {{"resolution", std::to_string(resolution)}});
}

}  // namespace

// The half fraction of 2^3 with C = AB, by hand.
TEST(FractionalFactorial, HalfOfTwoCubedByHand) {
    const PointSet set = coded_design(unit, {}, {{"generators", "C=AB"}});
    EXPECT_EQ(signs_of(set), (std::vector<std::string>{"--+", "+--", "-+-", "+++"}));
    EXPECT_EQ(found_in(set, "defining_relation"), "I=ABC");
    EXPECT_EQ(found_in(set, "aliases"), "A=BC; B=AC; C=AB");
    const PointSet other = coded_design(unit, {}, {{"generators", "C=-AB"}});
    EXPECT_EQ(signs_of(other), (std::vector<std::string>{"---", "+-+", "-++", "++-"}));
    EXPECT_EQ(found_in(other, "defining_relation"), "I=-ABC");
    EXPECT_EQ(found_in(other, "aliases"), "A=-BC; B=-AC; C=-AB");
}

// Box, Hunter and Hunter, "Statistics for Experimenters", table of 2^(7-4)_III: D = AB, E = AC,
// F = BC, G = ABC, with 7 words of three factors, 7 of four and one of seven.
TEST(FractionalFactorial, TwoToTheSevenMinusFour) {
    const PointSet set = coded_design(unit, {}, {{"generators", "D=AB,E=AC,F=BC,G=ABC"}});
    EXPECT_EQ(found_in(set, "resolution"), "III");
    EXPECT_EQ(found_in(set, "defining_relation"),
              "I=ABD=ACE=AFG=BCF=BEG=CDG=DEF=ABCG=ABEF=ACDF=ADEG=BCDE=BDFG=CEFG=ABCDEFG");
    EXPECT_EQ(found_in(set, "word_lengths"), "7 of 3, 7 of 4, 1 of 7");
    EXPECT_EQ(found_in(set, "aliases").substr(0, 21), "A=BD=CE=FG; B=AD=CF=E");
    EXPECT_EQ(signs_of(set), signs_of(coded_design(unit, points(8, 7))));
    EXPECT_EQ(found_in(make(unit, points(8, 7)), "search"), "complete");
}

// The same source: 2^(5-1) with E = ABCD is of resolution V.
TEST(FractionalFactorial, HalfOfTwoToTheFive) {
    const PointSet set = by_resolution(5, 5);
    EXPECT_EQ(set.count(), 16U);
    EXPECT_EQ(found_in(set, "generators"), "E=ABCD");
    EXPECT_EQ(found_in(set, "resolution"), "V");
    EXPECT_EQ(found_in(set, "aliases").substr(0, 16), "A=BCDE; B=ACDE; ");
}

// Required runs: Box, Hunter and Hunter's table of fractions (III and IV), and the largest codes of
// distance 5 (V): 5, 6, 8, 11 and 17 factors in 16, 32, 64, 128 and 256 runs.
TEST(FractionalFactorial, FewestRunsForAResolution) {
    const std::map<std::pair<std::size_t, int>, std::size_t> runs = {
        {{3, 3}, 4},  {{4, 3}, 8},  {{7, 3}, 8},   {{8, 3}, 16},   {{15, 3}, 16}, {{4, 4}, 8},
        {{5, 4}, 16}, {{8, 4}, 16}, {{9, 4}, 32},  {{16, 4}, 32},  {{5, 5}, 16},  {{6, 5}, 32},
        {{7, 5}, 64}, {{8, 5}, 64}, {{9, 5}, 128}, {{11, 5}, 128}, {{6, 6}, 32},  {{2, 3}, 4}};
    for (const auto& [asked, count] : runs) {
        const PointSet set = by_resolution(asked.first, asked.second);
        EXPECT_EQ(set.count(), count) << asked.first << " " << asked.second;
        if (asked.first > 11) continue;
        EXPECT_EQ(found_in(set, "word_lengths"), words_by_products(set)) << asked.first;
    }
}

// Largest minimum distances of binary linear codes with r check digits (Brouwer and Verhoeff's
// table as of 2006): resolution in 2^r runs from each number of factors up to the next, or 50.
TEST(FractionalFactorial, HasTheResolutionOfTheBestCodes) {
    using From = std::pair<std::size_t, std::size_t>;
    const std::map<std::size_t, std::vector<From>> resolutions = {
        {2, {{3, 3}}},
        {3, {{4, 4}, {5, 3}}},
        {4, {{5, 5}, {6, 4}, {9, 3}}},
        {5, {{6, 6}, {7, 4}, {17, 3}}},
        {6, {{7, 7}, {8, 5}, {9, 4}, {33, 3}}},
        {7, {{8, 8}, {9, 6}, {10, 5}, {12, 4}}},
        {8, {{9, 9}, {10, 6}, {13, 5}, {18, 4}}},
        {9, {{10, 10}, {11, 7}, {12, 6}, {19, 5}, {24, 4}}},
        {10, {{11, 11}, {12, 8}, {13, 7}, {16, 6}, {25, 5}, {34, 4}}},
        {11, {{12, 12}, {13, 8}, {17, 7}, {24, 6}, {35, 5}, {48, 4}}},
        {12, {{13, 13}, {14, 9}, {15, 8}, {25, 6}, {49, 5}}},
        {13, {{14, 14}, {15, 10}, {16, 8}, {26, 7}, {28, 6}}},
        {14, {{15, 15}, {16, 10}, {17, 9}, {18, 8}, {29, 7}, {32, 6}}},
        {15, {{16, 16}, {17, 11}, {18, 10}, {19, 9}, {21, 8}, {33, 7}, {38, 6}}},
        {16, {{17, 17}, {18, 12}, {19, 10}, {22, 9}, {24, 8}, {39, 7}, {48, 6}}}};
    for (const auto& [basic, froms] : resolutions)
        for (std::size_t k = basic + 1, i = 0; k <= std::min<std::size_t>(50, (1U << basic) - 1);
             ++k) {
            if (i + 1 < froms.size() && k == froms[i + 1].first) ++i;
            const auto known = generators::known_fraction(k, basic);
            ASSERT_TRUE(known) << k << " " << basic;
            EXPECT_EQ(known->resolution, froms[i].second) << k << " factors, 2^" << basic;
            EXPECT_EQ(known->design.factors(), k);
            EXPECT_GE(known->bound, known->resolution);
        }
}

// Values in catalogues: Xu (Technometrics 51 (2009) 266-277) and Chen, Sun, Wu.
TEST(FractionalFactorial, HasFewShortWords) {
    const auto words = [](std::size_t k, std::size_t basic, std::size_t length) {
        return generators::word_lengths(generators::known_fraction(k, basic)->design)[length];
    };
    EXPECT_EQ(words(13, 7, 4), 2U);
    EXPECT_EQ(words(14, 7, 4), 3U);
    EXPECT_EQ(words(16, 7, 4), 10U);
    EXPECT_EQ(words(24, 7, 4), 102U);
    EXPECT_EQ(words(17, 8, 5), 34U);
    EXPECT_EQ(words(20, 8, 4), 5U);
    EXPECT_EQ(words(23, 9, 5), 84U);
    EXPECT_EQ(words(15, 10, 7), 15U);
    EXPECT_EQ(words(24, 12, 8), 759U);  // Golay's code
}

TEST(FractionalFactorial, SaysWhatIsOpen) {
    const Generator& generator = find_generator(unit);
    const auto notes = [&](const Request& request, const Settings& settings) {
        Values values = generator.options.defaults();
        for (const auto& [name, value] : settings) generator.options.set(values, name, value);
        std::string text;
        for (const std::string& note :
             generator.notes(request, plan_for(generator, request, values), values))
            text += note + "\n";
        return text;
    };
    EXPECT_EQ(notes(points(32, 20), {}), "");
    EXPECT_EQ(notes(points(128, 13), {}),
              "fractional-factorial: not all fractions of 13 factors in 128 runs have been "
              "searched; one of resolution IV with fewer words of 4 letters than this one may "
              "exist\n");
    EXPECT_TRUE(notes(points(2048, 48), {})
                    .starts_with("fractional-factorial: resolution IV is the highest that is known "
                                 "for 48 factors in 2048 runs; it is open whether V can be "
                                 "reached"));
    EXPECT_TRUE(
        notes({.dimension = 48}, {{"resolution", "5"}})
            .starts_with("fractional-factorial: 4096 runs are the fewest that are known for 48 "
                         "factors at resolution V; it is open whether 2048 suffice"));
}

// Word lengths of designs of minimum aberration, from tables of Chen, Sun and Wu (Int. Stat. Rev.
// 61 (1993) 131-145) for 16 and 32 runs.
TEST(FractionalFactorial, HasTheLeastAberration) {
    const auto words = [](std::uint64_t n, std::size_t k) {
        return found_in(make(unit, points(n, k)), "word_lengths");
    };
    EXPECT_EQ(words(16, 6), "3 of 4");
    EXPECT_EQ(words(16, 7), "7 of 4");
    EXPECT_EQ(words(16, 8), "14 of 4, 1 of 8");
    EXPECT_TRUE(words(16, 9).starts_with("4 of 3, 14 of 4, 8 of 5")) << words(16, 9);
    EXPECT_TRUE(words(32, 7).starts_with("1 of 4, 2 of 5")) << words(32, 7);
    EXPECT_TRUE(words(32, 8).starts_with("3 of 4, 4 of 5")) << words(32, 8);
    EXPECT_TRUE(words(32, 9).starts_with("6 of 4, 8 of 5")) << words(32, 9);
}

TEST(FractionalFactorial, LargeOnesAreOrthogonalAndQuick) {
    for (const auto& [k, resolution] : {std::pair{50, 3}, {50, 4}, {30, 5}, {20, 8}}) {
        const PointSet set = by_resolution(static_cast<std::size_t>(k), resolution);
        for (std::size_t a = 0; a < set.dimension(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                ASSERT_EQ(column_product(set, a, b), 0) << k << " " << resolution;
    }
}

TEST(FractionalFactorial, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree(unit, points(64, 9)));
}

TEST(FractionalFactorial, EndsAreFacesOfTheCube) {
    const PointSet set = make(unit, points(4, 3), {{"ends", "true"}});
    for (const double x : set.flat()) EXPECT_TRUE(x == 0 || x == 1 - 0x1p-53);
}

TEST(FractionalFactorial, RefusesWhatIsNoFraction) {
    const auto error = [](const Request& request, const Settings& settings) {
        return error_of([&] { make(unit, request, settings); });
    };
    EXPECT_EQ(
        error(points(12, 5), {}),
        "usage: --count: 12 is not a power of two, as fractional-factorial of 5 factors needs; "
        "8 and 16 are the nearest");
    EXPECT_EQ(error(points(64, 5), {}),
              "usage: --count: 64 is not a fraction of the 2^k runs, as fractional-factorial of 5 "
              "factors needs; 32 is the nearest");
    EXPECT_EQ(error(points(8, 5), {{"resolution", "4"}}),
              "usage: --count: 8 runs are too few for 5 factors at resolution IV; 16 suffice");
    EXPECT_EQ(error(points(2048, 48), {{"resolution", "5"}}),
              "usage: --count: 2048 runs are not known to suffice for 48 factors at resolution V; "
              "4096 suffice");
    EXPECT_EQ(error({.dimension = 50}, {{"resolution", "8"}}),
              "usage: --resolution: no fraction of up to 2^16 runs is known for 50 factors at "
              "resolution VIII; --generators gives larger ones");
    EXPECT_EQ(
        error(points(16, 4), {{"generators", "D=ABC"}}),
        "usage: --count: 16 contradicts the fraction 2^(4-1), which has 8 runs; leave --count "
        "out");
    EXPECT_EQ(error({}, {{"generators", "D=A"}}),
              "usage: --generators: D would be A or -A in all runs");
    EXPECT_EQ(
        error({}, {{"generators", "D=AI"}}),
        "usage: --generators: 'I' in 'D=AI' is not a factor; expected A to Z, except I, or a to z");
    EXPECT_EQ(error({}, {{"generators", "DABC"}}),
              "usage: --generators: 'DABC' is not of the form D=ABC or D=-ABC");
    EXPECT_EQ(error({}, {{"generators", "D=ABC,E=AD"}}),
              "usage: --generators: E=AD contains D, which is a product itself or not a factor");
    EXPECT_EQ(error({}, {{"generators", "D=ABC,D=AB"}}), "usage: --generators: D is given twice");
    EXPECT_EQ(error({.dimension = 3}, {{"generators", "D=ABC"}}),
              "usage: --dimension: 3 factors are too few; --generators names factor D");
    EXPECT_EQ(error({}, {{"generators", "D=ABC"}, {"resolution", "4"}}),
              "usage: --generators contradicts --resolution; give one of them");
}

}  // namespace stipple::testing::fractional_factorial_test
