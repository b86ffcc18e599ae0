// SPDX-License-Identifier: MIT
#include "math/fourier/grid_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stipple::testing::grid_sum_test {

// Integers are added exactly in any order, and with sufficient accuracy.
TEST(ScaledGridSum, ForgetsTheOrder) {
    std::vector<std::vector<double>> grids(5, std::vector<double>(1000));
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t k = 0; k < 1000; ++k)
            grids[i][k] = std::ldexp(static_cast<double>((k * 7919 + i * 104'729) % 65'537) - 3e4,
                                     static_cast<int>(k % 40) - 30);
    ScaledGridSum forwards, backwards, part;
    for (const auto& grid : grids) forwards.add(grid, 1, {});
    for (std::size_t i = 5; i-- > 2;) backwards.add(grids[i], 1, {});
    for (std::size_t i = 0; i < 2; ++i) part.add(grids[i], 1, {});
    Packer packer;
    part.pack(packer);
    const std::string bytes = packer.take();
    Unpacker from(bytes);
    backwards.merge(from);
    std::vector<double> one(1000), other(1000);
    forwards.copy_to(one, {});
    backwards.copy_to(other, {});
    EXPECT_EQ(one, other);
    for (std::size_t k = 0; k < 1000; ++k) {
        long double sum = 0;
        for (const auto& grid : grids) sum += grid[k];
        EXPECT_NEAR(one[k], static_cast<double>(sum), 0x1p-60 + 1e-15 * std::abs(one[k])) << k;
    }
}

// Grids of very different magnitudes: each loses only what is small relative to itself.
TEST(ScaledGridSum, ForgetsTheOrderAndKeepsTheDigits) {
    const std::vector<double> sizes = {1, 1e-30, 3e8, 1e-30, 0, 7e120, 1e-300};
    const auto cell = [&](std::size_t i, std::size_t k) {
        return sizes[i] * (static_cast<double>((k * 7919 + i * 104'729) % 65'537) / 3e4 - 1);
    };
    const auto add = [&](ScaledGridSum& sum, std::size_t i) {
        std::vector<double> cells(100);
        for (std::size_t k = 0; k < 100; ++k) cells[k] = cell(i, k);
        const std::vector<double> before = cells;
        sum.add(cells, 2 * sizes[i], {});
        EXPECT_EQ(cells, before);
    };
    for (const auto& chosen :
         {std::vector<std::size_t>{0, 2}, {1, 3}, {6}, {0, 1, 2, 3, 4, 5, 6}}) {
        ScaledGridSum forwards, backwards, part;
        for (const std::size_t i : chosen) add(forwards, i);
        for (std::size_t j = chosen.size(); j-- > 1;) add(backwards, chosen[j]);
        add(part, chosen[0]);
        Packer packer;
        part.pack(packer);
        const std::string bytes = packer.take();
        Unpacker from(bytes);
        backwards.merge(from);
        std::vector<double> one(100), other(100);
        forwards.copy_to(one, {});
        backwards.copy_to(other, {});
        EXPECT_EQ(one, other);
        for (std::size_t k = 0; k < 100; ++k) {
            long double sum = 0;
            double largest = 0;
            for (const std::size_t i : chosen) {
                sum += cell(i, k);
                largest = std::max(largest, std::abs(cell(i, k)));
            }
            EXPECT_NEAR(one[k], static_cast<double>(sum), 1e-15 * largest) << k;
        }
    }
}

}  // namespace stipple::testing::grid_sum_test
