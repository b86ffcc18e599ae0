// SPDX-License-Identifier: MIT
#include "generators/blue_noise/near_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/rng.hpp"

using namespace stipple;

namespace {

/// Whether the list of every place probed has all points within reach of it, in their order.
bool complete(const NearLists<2>& lists, const std::vector<double>& rows, const Box& box,
              bool torus) {
    const Rng rng(77);
    for (std::uint64_t i = 0; i < 300; ++i) {
        const double p[2] = {box.low[0] + rng.uniform(2 * i) * box.extent(0),
                             box.low[1] + rng.uniform(2 * i + 1) * box.extent(1)};
        std::vector<std::uint32_t> listed;
        for (const auto& near : lists.at(p)) listed.push_back(near.index);
        if (!std::ranges::is_sorted(listed)) return false;
        for (std::uint32_t j = 0; j < rows.size() / 2; ++j) {
            const double squared =
                squared_distance<2>(p, &rows[2 * j], {box.extent(0), box.extent(1)}, torus);
            if (squared <= lists.reach() * lists.reach() && !std::ranges::binary_search(listed, j))
                return false;
        }
    }
    return true;
}

}  // namespace

TEST(NearLists, HaveAllPointsWithinReach) {
    const Box box{{-1, 3}, {1, 3.5}};
    for (const bool torus : {true, false})
        for (const double reach : {0.02, 0.1, 0.7, 5.0}) {
            const Rng rng(5);
            std::vector<double> rows;
            NearLists<2> lists(box, torus);
            for (std::uint64_t i = 0; i < 200; ++i) {
                rows.push_back(-1 + 2 * rng.uniform(2 * i));
                rows.push_back(3 + 0.5 * rng.uniform(2 * i + 1));
                if (i == 50) lists.renew(reach, rows);
                if (i > 50) lists.add(rows.data() + 2 * i);
            }
            EXPECT_EQ(lists.renewed_at(), 51U);
            EXPECT_TRUE(complete(lists, rows, box, torus)) << torus << " " << reach;
        }
}
