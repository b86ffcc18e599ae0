// SPDX-License-Identifier: MIT
#include "generators/spread_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "support/spacing.hpp"

namespace stipple::testing::spread_order_test {

// By the definition of the order: the distance from point m to earlier ones never exceeds the
// minimum so far by more than the step of the radii, 2^(1/4).
TEST(SpreadOrder, DistancesFallLittleByLittle) {
    for (const std::size_t d : {1, 2, 3})
        for (const bool torus : {true, false}) {
            const Rng rng(d);
            std::vector<double> rows;
            for (std::uint64_t i = 0; i < 600 * d; ++i) rows.push_back(rng.uniform(i));
            const BoxSpace space{{std::vector<double>(d, 0), std::vector<double>(d, 1)}, torus};
            const PointSet set(spread_out(rows, space, 0, {}), d);
            ASSERT_EQ(set.count(), 600);
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 1; i < set.count(); ++i) {
                const double near = distance_to_earlier(set, i, {space.box, torus});
                EXPECT_LE(near, least * std::sqrt(std::sqrt(2)) * (1 + 1e-9)) << d << ", " << i;
                least = std::min(least, near);
            }
        }
}

TEST(SpreadOrder, KeepsThePoints) {
    const std::vector<double> rows{0.5, 0.5, 0.5, 0.5, 0.1, 0.9, 0.25, 0};
    const BoxSpace space{{{0, 0}, {1, 1}}, true};
    const Rows out = spread_out(rows, space, 0, {});
    EXPECT_EQ(out.numbers().size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); i += 2) {
        int found = 0;
        for (std::size_t j = 0; j < rows.size(); j += 2)
            found += out.numbers()[j] == rows[i] && out.numbers()[j + 1] == rows[i + 1];
        EXPECT_EQ(found, i < 4 ? 2 : 1);
    }
    EXPECT_EQ(spread_out(std::vector<double>{0.3, 0.4}, space, 0.7, {}).numbers()[1], 0.4);
}

}  // namespace stipple::testing::spread_order_test
