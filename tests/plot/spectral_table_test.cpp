// SPDX-License-Identifier: MIT
//
// Spectral tables stored as points: recognition, and dimension.
#include "plot/spectral_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/units.hpp"

namespace stipple::testing::spectral_table_test {

using namespace plot;
namespace {

/// A symmetric table: its numbers are 1, 2, 3, ... up to the middle and back again.
PointSet table(std::size_t rows, std::size_t columns) {
    PointSet set(rows, columns);
    const auto flat = set.flat();
    for (std::size_t i = 0; i < flat.size(); ++i)
        flat[i] = static_cast<double>(std::min(i, flat.size() - 1 - i) + 1);
    return set;
}

std::optional<SpectralTable> found(const PointSet& set) {
    const std::vector<const PointSet*> sets = {&set};
    return spectral_table(sets);
}

}  // namespace

TEST(SpectralTable, KnowsATableOfPowerFromPoints) {
    PointSet power(9, 9);
    std::ranges::fill(power.flat(), 1.0);
    EXPECT_TRUE(found(power));  // of one point
    power.flat()[40] = 4;
    EXPECT_TRUE(found(power));
    power.flat()[3] = 2;
    EXPECT_FALSE(found(power));
    power.flat()[77] = 2;
    EXPECT_TRUE(found(power));
    power.flat()[5] = power.flat()[75] = -1;
    EXPECT_FALSE(found(power));
    EXPECT_FALSE(found(table(7, 7)));
    EXPECT_FALSE(found(table(9, 8)));
}

// The power at frequency zero is the number of points: at least 1, and the maximum.
TEST(SpectralTable, IsNotMadeOfEqualOrMirroredPoints) {
    PointSet equal(11, 1);
    for (double& x : equal.flat()) x = 0.25;
    EXPECT_FALSE(found(equal));
    PointSet mirrored(11, 1);
    for (std::size_t i = 0; i < 11; ++i) mirrored[i][0] = std::abs(static_cast<double>(i) - 5);
    EXPECT_FALSE(found(mirrored));
    PointSet identity(9, 9);
    for (std::size_t i = 0; i < 9; ++i) identity[i][i] = 1;
    EXPECT_FALSE(found(identity));
    EXPECT_FALSE(found(PointSet(9, 9)));
}

TEST(SpectralTable, IsOfTheDimensionOfItsShape) {
    const auto line = found(table(11, 1));
    ASSERT_TRUE(line);
    EXPECT_EQ(line->dimension, 1U);
    EXPECT_EQ(line->values.columns, 11U);
    const auto plane = found(table(11, 11));
    ASSERT_TRUE(plane);
    EXPECT_EQ(plane->dimension, 2U);
    EXPECT_FALSE(plane->differences);
    EXPECT_FALSE(found(table(10, 1)));
    EXPECT_FALSE(found(table(11, 2)));
    EXPECT_FALSE(found(make("random", {11, 1})));
}

TEST(SpectralTable, OfDifferencesHasNothingInTheMiddle) {
    PointSet set = table(11, 11);
    set.flat()[60] = 0;
    EXPECT_TRUE(found(set)->differences);
}

TEST(SpectralTable, OfSpaceIsDrawnByItsMiddlePlane) {
    std::vector<PointSet> planes;
    for (std::size_t k = 0; k < 9; ++k) {
        planes.push_back(table(9, 9));
        for (double& v : planes.back().flat()) v += static_cast<double>(std::min(k, 8 - k));
    }
    std::vector<const PointSet*> sets;
    for (const PointSet& plane : planes) sets.push_back(&plane);
    const auto space = spectral_table(sets);
    ASSERT_TRUE(space);
    EXPECT_EQ(space->dimension, 3U);
    EXPECT_EQ(space->values.rows, 9U);
    EXPECT_EQ(space->values.values[0], 5);  // 1 + 4, of plane 4
    planes[2].flat()[7] += 1;               // breaks the symmetry
    EXPECT_FALSE(spectral_table(sets));
}

TEST(SpectralTable, OfALineIsDrawnFromFrequencyOne) {
    const auto line = found(table(11, 1));
    const Chart chart = power_chart(line->values, "t");
    EXPECT_EQ(chart.panels.at(0).series.at(0).x, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(chart.panels.at(0).series.at(0).y, (std::vector<double>{5, 4, 3, 2, 1}));
}

}  // namespace stipple::testing::spectral_table_test
