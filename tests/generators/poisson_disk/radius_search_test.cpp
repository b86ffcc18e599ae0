// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/radius_search.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "support/units.hpp"

namespace stipple::testing::radius_search_test {
using namespace stipple::poisson_disk;

namespace {

/// About r^-2 points in the plane, divided by `step`; with numbers, so that they differ.
Pack pack_of(std::uint64_t step) {
    return [=](double r, double, std::uint64_t, const RunContext&) {
        const auto count = static_cast<std::uint64_t>(1 / (r * r)) / step * step;
        std::vector<double> rows;
        for (std::uint64_t i = 0; i < count; ++i)
            rows.insert(rows.end(), {static_cast<double>(i), 0.5});
        return Rows(std::move(rows));
    };
}

/// Result of a search, and its warnings.
struct Found {
    Packing packing;
    std::vector<std::string> told;

    Found(std::uint64_t count, const Pack& pack) {
        RunContext run;
        run.warn = [&](const std::string& sentence) { told.push_back(sentence); };
        packing = search_radius({count, 2, 0.1, 2}, 1, pack, run);
    }
};

}  // namespace

TEST(RadiusSearch, EndsAtARadiusThatLeavesTheCount) {
    for (const std::uint64_t count : {2, 77, 100, 1000}) {
        const Found found(count, pack_of(1));
        EXPECT_EQ(found.packing.rows.numbers().size(), 2 * count);
        EXPECT_EQ(static_cast<std::uint64_t>(1 / found.packing.radius / found.packing.radius),
                  count);
        EXPECT_TRUE(found.told.empty());
    }
}

// A set from which points were removed is not maximal, so a warning says so.
TEST(RadiusSearch, TellsWhenTheSurplusHadToGo) {
    const Found found(99, pack_of(4));
    const auto rows = found.packing.rows.numbers();
    ASSERT_EQ(rows.size(), 2U * 99);
    std::set<double> points;
    for (std::size_t i = 0; i < rows.size(); i += 2) points.insert(rows[i]);
    EXPECT_EQ(points.size(), 99U);
    EXPECT_LT(*points.rbegin(), 100);  // from the set with the smallest surplus
    EXPECT_NEAR(found.packing.radius, 0.1, 1e-6);
    ASSERT_EQ(found.told.size(), 1U);
    EXPECT_EQ(found.told[0],
              "no radius was found that gives exactly 99 points; points were removed from a larger "
              "set, so more would fit");
}

TEST(RadiusSearch, RefusesACountThatNoRadiusReaches) {
    const Pack none = [](double, double, std::uint64_t, const RunContext&) { return Rows(); };
    EXPECT_EQ(error_of([&] { Found(9, none); }),
              "limit: --count: no radius was found that gives 9 points");
}

}  // namespace stipple::testing::radius_search_test
