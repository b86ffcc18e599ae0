// SPDX-License-Identifier: MIT
#include "math/geometry/lattice.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::lattice_test {

TEST(Lattice, VisitsEveryCellOfAStretchInOrder) {
    for (const std::vector<std::uint64_t>& shape :
         {std::vector<std::uint64_t>{7}, {3, 4}, {1, 5, 2}, {2, 1, 1, 3}, {4, 1}}) {
        std::uint64_t size = 1;
        for (const std::uint64_t k : shape) size *= k;
        for (std::uint64_t first = 0; first <= size; ++first)
            for (std::size_t count = 0; first + count <= size; ++count) {
                std::vector<std::uint64_t> visited;
                for_each_lattice_row(shape, first, count,
                                     [&](auto cell, std::size_t offset, std::size_t length) {
                                         EXPECT_EQ(offset, visited.size());
                                         std::uint64_t number = 0;
                                         for (std::size_t k = shape.size(); k-- > 0;)
                                             number = number * shape[k] + cell[k];
                                         EXPECT_LE(cell[0] + length, shape[0]);
                                         for (std::size_t j = 0; j < length; ++j)
                                             visited.push_back(number + j);
                                     });
                std::vector<std::uint64_t> expected;
                for (std::uint64_t i = 0; i < count; ++i) expected.push_back(first + i);
                EXPECT_EQ(visited, expected);
            }
    }
}

}  // namespace stipple::testing::lattice_test
