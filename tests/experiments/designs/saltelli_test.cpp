// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/designs.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::saltelli_test {
namespace {

/// Rows of base point i, by the definition.
std::vector<std::vector<double>> rows_of(std::span<const double> base, bool second) {
    const std::size_t k = base.size() / 2;
    const std::vector<double> a(base.begin(), base.begin() + static_cast<std::ptrdiff_t>(k));
    const std::vector<double> b(base.begin() + static_cast<std::ptrdiff_t>(k), base.end());
    std::vector<std::vector<double>> rows{a};
    for (std::size_t j = 0; j < k; ++j) {
        rows.push_back(a);
        rows.back()[j] = b[j];
    }
    for (std::size_t j = 0; second && j < k; ++j) {
        rows.push_back(b);
        rows.back()[j] = a[j];
    }
    rows.push_back(b);
    return rows;
}

}  // namespace

TEST(Saltelli, RowsAreAThenMixturesThenB) {
    for (const bool second : {false, true})
        for (const std::size_t k : {1, 2, 3, 10})
            for (const std::string base : {"sobol:scramble=owen", "halton", "random"}) {
                const std::size_t block = second ? 2 * k + 2 : k + 2;
                const PointSet set = make(
                    "saltelli", points(600 * block, k),
                    {{"second-order", second ? "true" : "false"}, {"base", base}}, {.seed = 7});
                const PointSet pairs = make(base, points(600, 2 * k), {}, {.seed = 7});
                for (std::size_t i = 0; i < 600; ++i) {
                    const auto rows = rows_of(pairs[i], second);
                    for (std::size_t j = 0; j < block; ++j)
                        ASSERT_TRUE(std::ranges::equal(set[i * block + j], rows[j]))
                            << base << " " << k << " row " << i << " " << j;
                }
            }
}

TEST(Saltelli, BaseIsScrambledSobolUnlessAskedOtherwise) {
    EXPECT_EQ(make("saltelli", points(500, 3)),
              make("saltelli", points(500, 3), {{"base", "sobol:scramble=owen"}}));
    EXPECT_EQ(make("saltelli", {.dimension = 3}).count(), 1024U * 5);
}

TEST(Saltelli, MoreRowsKeepThoseThatThereAre) {
    const PointSet few = make("saltelli", points(50, 3));
    const PointSet many = make("saltelli", points(5000, 3));
    EXPECT_TRUE(std::ranges::equal(few.flat(), many.flat().first(150)));
    EXPECT_TRUE(stretches_agree("saltelli", points(3000, 4)));
    EXPECT_TRUE(stretches_agree("saltelli", points(3000, 4), {{"second-order", "true"}}));
}

TEST(Saltelli, RefusesParts) {
    const auto error = [](const Request& request, const Settings& settings) {
        return error_of([&] { make("saltelli", request, settings); });
    };
    EXPECT_EQ(
        error(points(1024, 3), {}),
        "usage: --count: 1024 is not a multiple of 5, as saltelli needs; 1020 and 1025 are the "
        "nearest");
    EXPECT_EQ(
        error(points(7, 3), {{"second-order", "true"}}),
        "usage: --count: 7 is not a multiple of 8, as saltelli --second-order needs; 8 is the "
        "least");
    EXPECT_EQ(error(points(50, 3, 3), {}),
              "usage: --start: 3 is not a multiple of 5, as saltelli needs");
    EXPECT_EQ(error(points(50, 3), {{"base", "hammersley"}}),
              "usage: --base: the points of hammersley depend on their number; expected an "
              "infinite sequence such as sobol, halton or random");
}

}  // namespace stipple::testing::saltelli_test
