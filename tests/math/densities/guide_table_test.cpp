// SPDX-License-Identifier: MIT
#include "math/densities/guide_table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/rng.hpp"

namespace stipple::testing::guide_table_test {
namespace {

/// Expects the table to find the same as a search among all sums: at the sums, next to them and at
/// random numbers.
void expect_searches(const std::vector<double>& sums, std::size_t buckets) {
    std::vector<std::uint32_t> starts(buckets + 1);
    fill_guide(sums, starts);
    EXPECT_EQ(starts.front(), 0U);
    EXPECT_EQ(starts.back(), sums.size());
    std::vector<double> wanted = {0};
    for (const double sum : sums)
        for (const double w : {std::nextafter(sum, 0), sum, std::nextafter(sum, 1e308)})
            wanted.push_back(w);
    for (std::uint64_t i = 0; i < 1000; ++i) wanted.push_back(Rng(3).uniform(i) * sums.back());
    for (const double w : wanted) {
        if (w >= sums.back()) continue;
        const std::size_t b = Buckets(sums.back(), buckets).of(w);
        const auto expected = std::ranges::upper_bound(sums, w) - sums.begin();
        EXPECT_EQ(first_above(sums, starts[b], starts[b + 1], w),
                  static_cast<std::size_t>(expected))
            << w << " of " << sums.back() << " in " << buckets;
    }
}

}  // namespace

TEST(GuideTable, FindsWhatASearchAmongAllFinds) {
    for (const std::size_t count : {1, 2, 3, 10, 257})
        for (const std::size_t buckets : {1, 2, 7, 64, 1000})
            for (const double scale : {1.0, 3e-320, 1e-300, 1e300}) {
                std::vector<double> sums;
                double sum = 0;
                for (std::size_t i = 0; i < count; ++i) {
                    const double u = Rng(5).uniform(i);
                    // Ties, and masses of very different sizes.
                    sums.push_back(sum += u < 0.4 ? 0 : (u < 0.7 ? 1e-9 * u : u));
                }
                if (!(sum > 0)) sums.back() = 1;
                for (double& s : sums) s *= scale;
                if (sums.back() > 0) expect_searches(sums, buckets);
            }
}

// Equal steps, so that sums are on the edges of buckets, where rounding could go either way.
TEST(GuideTable, IsRightOnTheEdgesOfBuckets) {
    for (const std::size_t count : {3, 10, 49, 98, 1000}) {
        std::vector<double> sums;
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) sums.push_back(sum += 0.1);
        expect_searches(sums, count);
    }
}

}  // namespace stipple::testing::guide_table_test
