// SPDX-License-Identifier: MIT
#include "generators/digital/sobol_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/nets.hpp"
#include "support/sequences.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::sobol_test {
namespace {

constexpr const char* scramblings[] = {"none", "digital-shift", "matrix", "owen"};

/// Published degrees of the first coordinates' polynomials; the bound on t is a sum of them.
constexpr std::size_t degrees[] = {1, 1, 2, 3, 3, 4, 4, 5, 5, 5, 5};

std::size_t bound(std::size_t dimension) {
    std::size_t t = 0;
    for (std::size_t k = 0; k < dimension; ++k) t += degrees[k] - 1;
    return t;
}

/// First lines of the file new-joe-kuo-6.21201.
const std::string published =
    "d       s       a       m_i         \n"
    "2       1       0       1 \n"
    "3       2       1       1 3 \n"
    "4       3       1       1 3 1 \n"
    "5       3       2       1 1 1 \n"
    "6       4       1       1 1 3 3 \n"
    "7       4       4       1 3 5 13 \n"
    "8       5       2       1 1 5 5 17 \n"
    "9       5       4       1 1 5 5 5 \n"
    "10      5       7       1 1 7 11 19 \n";

/// Error about such a file, without its folder.
std::string complaint(const std::string& text, std::size_t dimension = 2) {
    const TemporaryFile file(text);
    std::string error = error_of([&] {
        make("sobol", points(4, dimension), {{"directions", file.path()}});
    });
    if (const auto at = error.find(file.path()); at != std::string::npos)
        error.replace(at, file.path().size(), "FILE");
    return error;
}

}  // namespace

// Columns by hand from the published polynomials and numbers. Coordinate 2 (s = 1, a = 0, m = 1)
// has m = 1, 3, 5; coordinate 3 (s = 2, a = 1, m = 1, 3) has 1, 3, 3; coordinate 4 (s = 3, a = 1)
// 1, 3, 1; coordinate 5 (s = 3, a = 2) 1, 1, 1.
TEST(Sobol, FirstPointsByHand) {
    const PointSet natural = points_of({{0, 0, 0, 0, 0},
                                        {1. / 2, 1. / 2, 1. / 2, 1. / 2, 1. / 2},
                                        {1. / 4, 3. / 4, 3. / 4, 3. / 4, 1. / 4},
                                        {3. / 4, 1. / 4, 1. / 4, 1. / 4, 3. / 4},
                                        {1. / 8, 5. / 8, 3. / 8, 1. / 8, 1. / 8},
                                        {5. / 8, 1. / 8, 7. / 8, 5. / 8, 5. / 8},
                                        {3. / 8, 3. / 8, 5. / 8, 7. / 8, 3. / 8},
                                        {7. / 8, 7. / 8, 1. / 8, 3. / 8, 7. / 8}});
    EXPECT_EQ(make("sobol", points(8, 5)), natural);
    const PointSet gray = make("sobol", points(8, 5), {{"order", "gray"}});
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_TRUE(std::ranges::equal(gray[i], natural[i ^ (i >> 1)])) << i;
}

// The theorem, for blocks at any position, up to the last one.
TEST(Sobol, EveryAlignedBlockIsANet) {
    for (const char* order : {"natural", "gray"})
        for (const char* scramble : scramblings)
            for (const std::size_t d : {1U, 2U, 3U, 5U})
                for (const std::size_t m : {1U, 4U, 8U}) {
                    const std::uint64_t n = std::uint64_t{1} << m;
                    for (const std::uint64_t block :
                         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{12'345'678},
                          (std::uint64_t{1} << (52 - m)) - 1}) {
                        const PointSet set = make("sobol", points(n, d, block * n),
                                                  {{"order", order}, {"scramble", scramble}});
                        EXPECT_TRUE(is_net(set, 2, std::min(bound(d), m)))
                            << order << ", " << scramble << ", d = " << d << ", m = " << m
                            << ", block " << block;
                    }
                }
}

// Scrambling moves points within the elementary intervals of a net, so t stays exactly the same.
TEST(Sobol, ScramblingKeepsTheExactT) {
    for (const std::size_t d : {2U, 4U, 6U}) {
        const std::size_t t = exact_t(make("sobol", points(256, d)), 2);
        for (const char* scramble : scramblings)
            for (const std::uint64_t seed : {1U, 2U, 3U}) {
                const PointSet set =
                    make("sobol", points(256, d), {{"scramble", scramble}}, {.seed = seed});
                EXPECT_EQ(exact_t(set, 2), t) << scramble << ", d = " << d << ", seed " << seed;
            }
    }
}

// The note to the user: without the first point, or with another count, it is not such a net.
TEST(Sobol, UnalignedBlocksAreNoNets) {
    for (const std::size_t m : {4U, 6U, 8U}) {
        const std::uint64_t n = std::uint64_t{1} << m;
        EXPECT_TRUE(is_net(make("sobol", points(n, 2, n)), 2, 0));
        EXPECT_FALSE(is_net(make("sobol", points(n, 2, 1)), 2, 0));
        EXPECT_FALSE(is_net(make("sobol", points(n, 2, n / 2 + n)), 2, 0)) << m;
    }
}

// t of a projection is bounded by its two polynomials alone; the first two coordinates have t = 0.
TEST(Sobol, ProjectionsOnTwoCoordinatesKeepTheirBound) {
    const std::size_t d = std::size(degrees);
    for (const std::size_t m : {6U, 10U}) {
        const std::size_t n = std::size_t{1} << m;
        const PointSet set = make("sobol", points(n, d));
        for (std::size_t a = 0; a < d; ++a)
            for (std::size_t b = a + 1; b < d; ++b)
                EXPECT_LE(exact_t(part_of(set, 0, n, {a, b}), 2), degrees[a] + degrees[b] - 2)
                    << a << ", " << b << ", m = " << m;
        EXPECT_EQ(exact_t(part_of(set, 0, n, {0, 1}), 2), 0U);
    }
}

// Sobol's Property A: each of the 2^d cubes of side 1/2 contains one of the first 2^d points. It
// holds for the first 1111 dimensions of Joe and Kuo's numbers: the first digits of d columns in d
// dimensions form a nonsingular matrix for each d. Elimination continues from d to d + 1.
TEST(Sobol, HasPropertyAInThePublishedDimensions) {
    constexpr std::size_t d = 1111;
    const BinaryMatrices matrices = sobol_matrices(d, d);
    std::vector<std::vector<std::uint8_t>> reduced;
    for (std::size_t k = 0; k < d; ++k) {
        std::vector<std::uint8_t> row(d);
        for (std::size_t j = 0; j < d; ++j)
            row[j] = static_cast<std::uint8_t>(matrices.columns[j * d + k] >> 63);
        for (std::size_t p = 0; p < k; ++p)
            if (row[p])
                for (std::size_t j = p; j < d; ++j)
                    row[j] = static_cast<std::uint8_t>(row[j] ^ reduced[p][j]);
        ASSERT_TRUE(row[k]) << "dimension " << k + 1;
        reduced.push_back(std::move(row));
    }
}

TEST(Sobol, PointsUpToTheLastAreMultiplesOfTheLastDigit) {
    const std::uint64_t end = std::uint64_t{1} << 52;
    const PointSet last = make("sobol", points(4, 2000, end - 4));
    for (const double x : last.flat()) {
        EXPECT_TRUE(x >= 0 && x < 1);
        EXPECT_EQ(x * 0x1p52, std::floor(x * 0x1p52));
    }
    EXPECT_EQ(last[3][0], 1 - 0x1p-52);
    EXPECT_EQ(error_of([&] { make("sobol", points(5, 1, end - 4)); }),
              "usage: --start 4503599627370492 and 5 points go beyond index 4503599627370495, the "
              "last of sobol");
}

TEST(Sobol, AnyStretchIsThatOfTheWhole) {
    for (const char* order : {"natural", "gray"})
        for (const char* scramble : scramblings) {
            const Settings settings{{"order", order}, {"scramble", scramble}};
            EXPECT_TRUE(stretches_agree("sobol", points(50, 3), settings));
            EXPECT_TRUE(stretches_agree("sobol", points(5000, 2), settings));
            EXPECT_TRUE(stretches_agree("sobol", points(40, 600), settings));
        }
}

TEST(Sobol, TheSeedCountsWithScramblingsOnly) {
    const Generator& unit = find_generator("sobol");
    for (const std::string scramble : scramblings) {
        const auto of_seed = [&](std::uint64_t seed) {
            return make("sobol", points(64, 3), {{"scramble", scramble}}, {.seed = seed});
        };
        EXPECT_EQ(of_seed(1) != of_seed(2), scramble != "none") << scramble;
        Values values = unit.options.defaults();
        unit.options.set(values, "scramble", scramble);
        EXPECT_EQ(uses_seed(unit, values), scramble != "none") << scramble;
    }
}

TEST(Sobol, SaysWhereARequestMissesTheNets) {
    const auto said = [](std::uint64_t count, std::uint64_t start) {
        std::string sentence;
        RunContext run;
        run.warn = [&](const std::string& text) { sentence += text; };
        make("sobol", points(count, 2, start), {}, run);
        return sentence;
    };
    EXPECT_EQ(said(1000, 0), "1000 points do not form a net; take a power of two: 512 or 1024");
    EXPECT_EQ(said(1024, 1),
              "1024 points from index 1 on do not form a net; start at a multiple of 1024: 0 or "
              "1024");
    // Nets, and parts of sets made in several runs.
    for (const auto& [count, start] : {std::pair{1024, 0}, {1, 0}, {1, 5}, {512, 1536}, {1000, 24}})
        EXPECT_EQ(said(static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(start)), "");
}

TEST(Sobol, ReadsDirectionNumbersAsPublished) {
    const TemporaryFile file(published);
    EXPECT_EQ(make("sobol", points(512, 10), {{"directions", file.path()}}),
              make("sobol", points(512, 10)));
    const TemporaryFile other("# mine\n2 1 0 1\n3 2 1 1 1\n");
    const PointSet mine = make("sobol", points(8, 3), {{"directions", other.path()}});
    EXPECT_EQ(mine[2][2], 0.25);
    EXPECT_TRUE(is_net(mine, 2, 1));
}

// One of LDData's two formats refers to a table for the polynomials.
TEST(Sobol, ReadsDirectionNumbersOfOtherPackages) {
    const PointSet table = make("sobol", points(64, 5));
    for (const char* text :
         {"# sobol\n# five dimensions\n1 # m of the second\n1 3\n1 3 1\n1 1 1\n",
          "# Parameters m_{j,c} for Sobol points\n1\n1 3\n1 3 1\n1 1 1\n",
          "# soboljk\n# d s a m\n2 1 0 1\n3 2 1 1 3\n4 3 1 1 3 1\n5 3 2 1 1 1\n"}) {
        const TemporaryFile numbers(text);
        EXPECT_EQ(make("sobol", points(64, 5), {{"directions", numbers.path()}}), table) << text;
    }
    // LatNet Builder's files contain the dimension, later versions also the digits of the number of
    // points.
    for (const char* text :
         {"# Merit: 5\n# Parameters m_{j,c} for Sobol points\n5    # 5 dimensions\n# m_{j,c}\n1\n1 "
          "3\n"
          "1 3 1\n1 1 1\n",
          "# Parameters m_{j,c} for Sobol points\n5  # s = 5 dimensions\n6  # k = 6\n1\n1 3\n1 3 "
          "1\n"
          "1 1 1\n",
          "# Parameters for Sobol points, in JK format\n5 # 5 dimensions\n2 1 0 1\n3 2 1 1 3\n"
          "4 3 1 1 3 1\n5 3 2 1 1 1\n"}) {
        const TemporaryFile numbers(text);
        EXPECT_EQ(make("sobol", points(64, 5), {{"directions", numbers.path()}}), table) << text;
    }
    EXPECT_EQ(complaint("# sobol\n1\n1 2\n"), "input: FILE:3:3: '2' is even; expected an odd m_2");
}

// Points made of these numbers by LatNet Builder's own scripts.
TEST(Sobol, InterlacesWhatAFileSaysIsToBe) {
    const std::string text =
        "# Parameters m_{j,c} for Sobol points\n2  # 2 dimensions\n2  # Interlacing factor\n"
        "4  # Number of components = interlacing factor x dimension\n# m_{j,c}\n1\n1 1\n1 3 1\n";
    const TemporaryFile numbers(text);
    EXPECT_EQ(make("sobol", points(8, 2), {{"directions", numbers.path()}}),
              points_of({{0, 0},
                         {0.75, 0.75},
                         {0.4375, 0.4375},
                         {0.6875, 0.6875},
                         {0.296875, 0.671875},
                         {0.546875, 0.421875},
                         {0.234375, 0.859375},
                         {0.984375, 0.109375}}));
    EXPECT_EQ(complaint(text, 3),
              "usage: --dimension: 3 is outside [1, 2], the dimensions in FILE");
    EXPECT_EQ(complaint("# Parameters m_{j,c} for Sobol points\n0 # dimensions\n1\n"),
              "input: FILE:2:1: '0' is out of range; expected a number of the header in [1, "
              "1000000]");
}

TEST(Sobol, SaysWhatIsWrongWithDirectionNumbers) {
    EXPECT_EQ(complaint(""),
              "input: FILE: no direction numbers; expected lines \"d s a m_1 ... "
              "m_s\"");
    EXPECT_EQ(complaint("d s a m_i\n3 1 0 1\n"),
              "input: FILE:2:1: '3' is out of range; expected the dimension that comes next, 2");
    EXPECT_EQ(complaint("2 0 0 1\n"),
              "input: FILE:1:3: '0' is out of range; expected the degree s in [1, 63]");
    EXPECT_EQ(complaint("2 1 0 1\n3 2 2 1 3\n"),
              "input: FILE:2:5: '2' is out of range; expected the coefficients a in [0, 1]");
    EXPECT_EQ(complaint("2 1 0 1\n3 2 1 1\n4 3 1 1 3 1\n"),
              "input: FILE:2:8: the line ends here; expected an odd m_2 in [1, 3]");
    EXPECT_EQ(complaint("2 1 0 1\n3 2 1 1 2\n"),
              "input: FILE:2:9: '2' is even; expected an odd m_2");
    EXPECT_EQ(complaint("2 1 0 1\n3 2 1 1 5\n"),
              "input: FILE:2:9: '5' is out of range; expected an odd m_2 in [1, 3]");
    EXPECT_EQ(complaint("2 1 0 1 1\n"),
              "input: FILE:1:9: unexpected '1'; expected the end of the line");
    EXPECT_EQ(complaint("2 1 0 one\n"),
              "input: FILE:1:7: 'one' is not a whole number; expected an odd m_1, 1");
    EXPECT_EQ(complaint("2 1 0 1\n", 3),
              "usage: --dimension: 3 is outside [1, 2], the dimensions in FILE");
    EXPECT_EQ(error_of([] {
                  make("sobol", points(4, 2), {{"directions", "/no/such"}});
              }),
              "io: /no/such: no such file");
}

TEST(Sobol, RefusesDimensionsBeyondItsTable) {
    EXPECT_EQ(error_of([] { make("sobol", points(1, 3668)); }),
              "usage: --dimension: 3668 is outside [1, 3667], the range of sobol | --directions "
              "allows more");
}

}  // namespace stipple::testing::sobol_test
