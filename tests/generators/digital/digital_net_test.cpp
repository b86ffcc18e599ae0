// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/exact.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"
#include "support/sequences.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::digital_net_test {
namespace {

const std::string sobol_file = STIPPLE_SOURCE_DIR "/data/sobol_4d.txt";

PointSet net(const TemporaryFile& file, Request request, Settings more = {}) {
    more.emplace_back("matrices", file.path());
    return make("digital-net", std::move(request), more);
}

/// Error message, with FILE in place of the file's name.
std::string refusal(const std::string& text, Settings more = {}, Request request = {}) {
    const TemporaryFile file(text);
    std::string error = error_of([&] { net(file, request, more); });
    for (auto at = error.find(file.path()); at != std::string::npos; at = error.find(file.path()))
        error.replace(at, file.path().size(), "FILE");
    return error;
}

/// Pascal's triangle to the powers 0 and 1 modulo 3, with 3 x 3 digits: Faure's matrices.
const char* const pascal_digits =
    "# digits\n3 2 3 3\n"
    "1 0 0\n0 1 0\n0 0 1\n\n"
    "1 1 1\n0 1 2\n0 0 1\n";

}  // namespace

// By hand from the polynomials and numbers of Joe and Kuo: m = 1, 3, 5 for the second coordinate,
// 1, 3, 3 for the third and 1, 3, 1 for the fourth. SciPy makes the same eight points.
TEST(DigitalNet, WithSobolsMatricesGivesSobolsPoints) {
    EXPECT_EQ(make("digital-net", {.count = 8}, {{"matrices", sobol_file}}),
              points_of({{0, 0, 0, 0},
                         {1. / 2, 1. / 2, 1. / 2, 1. / 2},
                         {1. / 4, 3. / 4, 3. / 4, 3. / 4},
                         {3. / 4, 1. / 4, 1. / 4, 1. / 4},
                         {1. / 8, 5. / 8, 3. / 8, 1. / 8},
                         {5. / 8, 1. / 8, 7. / 8, 5. / 8},
                         {3. / 8, 3. / 8, 5. / 8, 7. / 8},
                         {7. / 8, 7. / 8, 1. / 8, 3. / 8}}));
}

// Sobol's first two coordinates are a (0, 2)-sequence; in three and four dimensions t is 1 and 3
// (the sum of the polynomials' degrees, each minus one).
TEST(DigitalNet, WithSobolsMatricesIsANetOfSobolsQuality) {
    const std::vector<std::size_t> sobols_t = {0, 0, 1, 3};
    for (std::size_t m = 4; m <= 9; ++m)
        for (const std::uint64_t block : {0, 1, 5, 1001}) {
            const std::uint64_t n = std::uint64_t{1} << m;
            const PointSet set =
                make("digital-net", points(n, 4, block * n), {{"matrices", sobol_file}});
            const std::vector<std::size_t> all = {0, 1, 2, 3};
            for (std::size_t d = 1; d <= 4; ++d)
                ASSERT_TRUE(
                    is_net(part_of(set, 0, n, {all.begin(), all.begin() + static_cast<int>(d)}), 2,
                           sobols_t[d - 1]))
                    << "m = " << m << ", block " << block << ", d = " << d;
        }
}

TEST(DigitalNet, WithFauresMatricesGivesFauresPoints) {
    const TemporaryFile file(pascal_digits);
    EXPECT_EQ(net(file, {.count = 27}), make("faure", points(27, 2), {{"base", "3"}}));
    EXPECT_EQ(net(file, points(7, 1, 20)), make("faure", points(7, 1, 20), {{"base", "3"}}));
}

// One net in five layouts: the coordinates have the identity matrix and Pascal's triangle modulo 2.
TEST(DigitalNet, ReadsEveryLayout) {
    const std::string head = "\n2 # base\n2 # matrices\n";
    const std::string rows = "1 0 0\n0 1 0\n0 0 1\n1 1 1\n0 1 0\n0 0 1\n";
    const PointSet wanted = points_of({{0, 0},
                                       {4. / 8, 4. / 8},
                                       {2. / 8, 6. / 8},
                                       {6. / 8, 2. / 8},
                                       {1. / 8, 5. / 8},
                                       {5. / 8, 1. / 8},
                                       {3. / 8, 3. / 8},
                                       {7. / 8, 7. / 8}});
    struct Case {
        std::string text;
        std::string layout;
    };
    for (const auto& [text, layout] :
         {Case{"# dnet" + head + "3\n3\n4 2 1\n4 6 5\n", "auto"},
          {"# Merit: 3\n# Parameters for a digital net in base 2 \n2 # dimensions\n3\n3\n# C_1\n4 "
           "2 1\n4 6 5\n",
           "auto"},
          {"#dnetup of three digits" + head + "3 3\n1 2 4\n1 3 5", "auto"},
          {"# digits\r\n2 2 3 3\r\n" + rows, "auto"},
          {"2 2 3 3 # no keyword\n" + rows, "digits"},
          {"# a comment\n1 2 4\n\n1 3 5\n", "columns"},
          {rows, "rows"}}) {
        const TemporaryFile file(text);
        EXPECT_EQ(net(file, {.count = 8}, {{"layout", layout}}), wanted) << text;
    }
    const TemporaryFile large("# dnet\n2\n1\n4294967296 # points\n32\n" + [] {
        std::string line;
        for (int j = 31; j >= 0; --j) line += std::to_string(std::uint64_t{1} << j) + " ";
        return line;
    }());
    EXPECT_EQ(net(large, {.count = 100}), make("faure", points(100, 1)));
}

TEST(DigitalNet, ReadsColumnsAndRowsOfOtherBases) {
    // Columns (1, 0), (1, 1) and (2, 0), (1, 2) in base 3: with the first row as the highest digit
    // 3, 4, 6, 5.
    const auto wanted = [](double a, double b) {
        return points_of({{0, 0}, {3 / 9., 6 / 9.}, {6 / 9., 3 / 9.}, {a / 9, b / 9}});
    };
    const PointSet set = wanted(4, 5);
    EXPECT_EQ(net(TemporaryFile("# dnet\n3 2 2 2\n3 4\n6 5\n"), {.count = 4}), set);
    EXPECT_EQ(net(TemporaryFile("# dnetup\n3 2 2 2\n1 4\n2 7\n"), {.count = 4}), set);
    EXPECT_EQ(net(TemporaryFile("1 1\n0 1\n2 1\n0 2\n"), {.count = 4},
                  {{"layout", "rows"}, {"base", "3"}}),
              set);
}

// Dick's interlacing of two coordinates, digit by digit: 0.x1 y1 x2 y2 ...
TEST(DigitalNet, InterlacesTheDigitsOfItsMatrices) {
    const PointSet plain = make("digital-net", {.count = 256}, {{"matrices", sobol_file}});
    const PointSet woven =
        make("digital-net", {.count = 256}, {{"matrices", sobol_file}, {"interlace", "2"}});
    ASSERT_EQ(woven.dimension(), 2U);
    for (std::size_t i = 0; i < 256; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            double sum = 0;
            double x = plain[i][2 * k];
            double y = plain[i][2 * k + 1];
            for (int digit = 1; digit <= 16; ++digit) {
                x = 2 * (x - std::floor(x));
                y = 2 * (y - std::floor(y));
                sum += std::ldexp(std::floor(x), 1 - 2 * digit);
                sum += std::ldexp(std::floor(y), -2 * digit);
            }
            ASSERT_EQ(woven[i][k], sum) << i << ", " << k;
        }
    EXPECT_EQ(make("digital-net", {.count = 9}, {{"matrices", sobol_file}, {"interlace", "3"}})
                  .dimension(),
              1U);
}

// LatNet Builder's files contain the factor; the option overrides it.
TEST(DigitalNet, InterlacesWhatAFileSaysIsToBe) {
    const std::string rest = "3\n3\n4 2 1\n4 6 5\n4 2 3\n4 6 7\n";
    const TemporaryFile plain("# dnet\n2\n4\n" + rest);
    const std::string title = "# Parameters for a digital net in base 2\n2  # 2 dimensions\n";
    const TemporaryFile woven(title + "2  # Interlacing factor\n4  # Number of components\n" +
                              rest);
    EXPECT_EQ(net(woven, {.count = 8}), net(plain, {.count = 8}, {{"interlace", "2"}}));
    EXPECT_EQ(net(woven, {.count = 8}, {{"interlace", "1"}}), net(plain, {.count = 8}));
    EXPECT_EQ(refusal(title + "2 # Interlacing factor\n3\n" + rest),
              "input: FILE:4:1: '3' is out of range; expected the number of components, 4");
}

// Dick 2008: interlacing alpha = 2 coordinates of a (t, m, 2)-net gives a rule of order 2. The mean
// of x^2 over such nets in one dimension differs from 1/3 by little more than n^-2, over others by
// n^-1.
TEST(DigitalNet, InterlacedNetsIntegrateSmoothFunctionsToHigherOrder) {
    const auto error = [](std::uint64_t n, const char* alpha) {
        const PointSet set =
            make("digital-net", points(n, 1), {{"matrices", sobol_file}, {"interlace", alpha}});
        double sum = 0;
        for (const double x : set.flat()) sum += x * x * x * (4 - 5 * x);
        return std::abs(sum / static_cast<double>(n));
    };
    EXPECT_GT(error(1024, "1"), 1e-4);
    EXPECT_LT(error(1024, "2"), 2e-6);
}

TEST(DigitalNet, WithSobolsMatricesIsSobolScrambledOrNot) {
    for (const char* scramble : {"none", "digital-shift", "matrix", "owen"})
        EXPECT_EQ(make("digital-net", points(3000, 4, 77),
                       {{"matrices", sobol_file}, {"scramble", scramble}}, {.seed = 5}),
                  make("sobol", points(3000, 4, 77), {{"scramble", scramble}}, {.seed = 5}))
            << scramble;
}

// Scrambling fills up digits that are missing in a file with few rows.
TEST(DigitalNet, ScrambledPointsAreItsPointsScrambled) {
    const TemporaryFile file("# digits\n3 2 3 4\n1 2 0\n0 1 1\n2 2 2\n1 0 0\n" +
                             std::string("1 1 1\n2 1 0\n2 0 1\n0 0 2\n"));
    const TemporaryFile long_file("# dnetup\n5 1 2 27\n7450580596923828124 3\n");
    for (const char* scramble : {"digital-shift", "matrix", "owen"}) {
        const Settings settings = {{"scramble", scramble}};
        EXPECT_EQ(net(file, {.count = 27, .seed = 1}, settings),
                  scrambled(net(file, {.count = 27}), scramble + std::string(":base=3"), 1))
            << scramble;
        EXPECT_EQ(net(long_file, {.count = 25}, settings),
                  scrambled(net(long_file, {.count = 25}), scramble + std::string(":base=5"), 1))
            << scramble;
    }
}

TEST(DigitalNet, AnyStretchIsThatOfTheWhole) {
    EXPECT_TRUE(stretches_agree("digital-net", points(50, 3), {{"matrices", sobol_file}}));
    EXPECT_TRUE(stretches_agree("digital-net", points(5000, 4), {{"matrices", sobol_file}}));
}

TEST(DigitalNet, MakesAllItsPointsAndNoMore) {
    const std::string text = "# digits\n3 1 2 4\n1 2\n0 1\n2 2\n1 0\n";
    const TemporaryFile file(text);
    const PointSet all = net(file, {.count = 9});
    EXPECT_TRUE(is_net(all, 3, 0));
    EXPECT_EQ(net(file, points(1, 1, 8))[0][0], all[8][0]);
    EXPECT_EQ(refusal(text, {}, {.count = 10}),
              "usage: --count: 10 points from index 0 on go beyond the 9 = 3^2 points of FILE");
    EXPECT_EQ(refusal(text, {}, points(9, 1, 1)),
              "usage: --count: 9 points from index 1 on go beyond the 9 = 3^2 points of FILE");
    EXPECT_EQ(refusal(text, {}, points(9, 2)),
              "usage: --dimension: 2 is outside [1, 1], the dimensions in FILE");
    EXPECT_EQ(refusal(text, {{"interlace", "2"}}),
              "usage: --interlace: 2 is above the 1 matrices of FILE");
}

TEST(DigitalNet, SaysWhereAFileIsWrong) {
    EXPECT_EQ(error_of([] { make("digital-net", {.count = 8}); }),
              "usage: --matrices: digital-net needs a file of generating matrices");
    EXPECT_EQ(error_of([] {
                  make("digital-net", {}, {{"matrices", "/no/such/file"}});
              }),
              "io: /no/such/file: no such file");
    EXPECT_EQ(refusal(""), "input: FILE: no matrix; expected generating matrices");
    EXPECT_EQ(
        refusal("2 1 1 1\n1\n"),
        "input: FILE:1:1: the first line is not # dnet, # dnetup or # digits; expected one of "
        "them, or else --layout columns or rows");
    EXPECT_EQ(refusal("# dnet\n4 1 1 1\n1\n"),
              "input: FILE:2:1: the base 4 is not a prime, 2 divides it");
    EXPECT_EQ(refusal("# dnet\n1 1 1 1\n1\n"),
              "input: FILE:2:1: '1' is out of range; expected the base in [2, 65521]");
    EXPECT_EQ(refusal("# dnet\n3\n1\n100\n2\n"),
              "input: FILE:4:1: 100 is neither a number of columns up to 64 nor a number of "
              "points, a power of 3");
    EXPECT_EQ(refusal("# dnet\n2 1 2 2\n1 4\n"),
              "input: FILE:3:3: '4' is out of range; expected a column in [0, 3]");
    EXPECT_EQ(refusal("# dnet\n2 2 2 2\n1 3\n1\n2\n"),
              "input: FILE:4:2: the line ends here; expected a column in [0, 3]");
    EXPECT_EQ(refusal("# dnet\n2 1 2 2\n1 3 2\n"),
              "input: FILE:3:5: unexpected '2'; expected the end of the line");
    EXPECT_EQ(refusal("# dnet\n2 2 2 2\n1 3\n"),
              "input: FILE:4:1: the file ends here; expected a column in [0, 3]");
    EXPECT_EQ(refusal("# dnet\n2 1 2 2\n1 3\n1 2\n"),
              "input: FILE:4:1: unexpected '1'; expected the end of the file after 1 matrices");
    EXPECT_EQ(
        refusal("# dnet\n3 1 1 41\n1\n"),
        "input: FILE: columns of 41 digits in base 3 exceed 64 bits; expected the layout digits");
    EXPECT_EQ(refusal("# digits\n3 1 2 2\n1 x\n"),
              "input: FILE:3:3: 'x' is not a whole number; expected a digit in [0, 2]");
    EXPECT_EQ(refusal("1 0\n0 1\n1 2\n0 1\n", {{"layout", "rows"}}),
              "input: FILE:3:3: '2' is out of range; expected a digit in [0, 1]");
    EXPECT_EQ(refusal("1 0\n0 1\n1 0\n", {{"layout", "rows"}}),
              "input: FILE:4:1: the file ends here; expected a digit in [0, 1]");
    EXPECT_EQ(refusal("1 0\n", {{"layout", "rows"}, {"base", "6"}}),
              "usage: --base: 6 is not a prime, 2 divides it");
    EXPECT_EQ(refusal("# dnet\n2 1 1 1\n1\n", {{"base", "3"}}),
              "usage: --base applies to the layout rows only; the others give or fix their base");
}

TEST(DigitalNet, TakesColumnsOfAll64Bits) {
    const TemporaryFile file("# dnet\n2 1 1 64\n18446744073709551615\n");
    EXPECT_EQ(net(file, {.count = 2})[1][0], 1 - 0x1p-53);
    const TemporaryFile bare("18446744073709551615 1\n");
    EXPECT_EQ(net(bare, {.count = 2}, {{"layout", "columns"}})[1][0], 1 - 0x1p-53);
}

}  // namespace stipple::testing::digital_net_test
