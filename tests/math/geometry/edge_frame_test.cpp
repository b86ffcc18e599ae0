// SPDX-License-Identifier: MIT
#include "math/geometry/edge_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace stipple::testing::edge_frame_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

TEST(EdgeFrame, CoordinatesByHand) {
    const EdgeFrame frame({10, 20, 0}, {3, 1, 0}, {-1, 2, 0}, 20);
    ASSERT_FALSE(frame.flat());
    EXPECT_DOUBLE_EQ(frame.area(), 7);
    EXPECT_DOUBLE_EQ(frame.lengths()[0], std::sqrt(10));
    EXPECT_DOUBLE_EQ(frame.lengths()[1], std::sqrt(5));
    EXPECT_DOUBLE_EQ(frame.lengths()[2], std::sqrt(17));
    const auto [s, t] = frame.coordinates({11.25, 21, 0});  // c + a/2 + b/4
    EXPECT_NEAR(s, 0.5, 1e-15);
    EXPECT_NEAR(t, 0.25, 1e-15);
}

// The plane of (-1, 2, 0) and (-1, 0, 3) through (1, 0, 0) has the normal (6, 3, 2) / 7.
TEST(EdgeFrame, SeesWhatIsOffItsPlane) {
    const EdgeFrame frame({1, 0, 0}, {-1, 2, 0}, {-1, 0, 3}, 3);
    const Vector3 off = {1 - 0.5 - 0.25 + 6. / 7, 1 + 3. / 7, 0.75 + 2. / 7};
    EXPECT_NEAR(frame.off_plane(off), 1, 1e-15);
    EXPECT_NEAR(frame.coordinates(off).s, 0.5, 1e-15);
    EXPECT_NEAR(frame.coordinates(off).t, 0.25, 1e-15);
}

TEST(EdgeFrame, TellsFlatFromThin) {
    EXPECT_TRUE(EdgeFrame().flat());
    EXPECT_TRUE(EdgeFrame({0, 0, 0}, {1, 1, 0}, {2, 2, 0}, 2).flat());
    EXPECT_TRUE(EdgeFrame({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, 1).flat());
    EXPECT_TRUE(EdgeFrame({0, 0, 0}, {1, 0, 0}, {0, 63 * epsilon, 0}, 1).flat());
    EXPECT_FALSE(EdgeFrame({0, 0, 0}, {1, 0, 0}, {0, 65 * epsilon, 0}, 1).flat());
    EXPECT_TRUE(EdgeFrame({1e6, 0, 0}, {1, 0, 0}, {0, 1e-9, 0}, 1e6).flat()) << "far away";
}

TEST(EdgeFrame, NeitherOverflowsNorUnderflows) {
    for (const double size : {1e149, 1e-130}) {
        const EdgeFrame frame({0, 0, 0}, {size, 0, 0}, {0, size, 0}, size);
        ASSERT_FALSE(frame.flat());
        EXPECT_NEAR(frame.area() / size / size, 1, 1e-15);
        EXPECT_NEAR(frame.coordinates({0.25 * size, 0.5 * size, 0}).s, 0.25, 1e-15);
        EXPECT_NEAR(frame.coordinates({0.25 * size, 0.5 * size, 0}).t, 0.5, 1e-15);
    }
}

}  // namespace stipple::testing::edge_frame_test
