// SPDX-License-Identifier: MIT
#include "math/combinatorics/radix_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace stipple::testing::radix_sort_test {
namespace {

std::vector<std::uint32_t> order_of(const std::vector<double>& values) {
    std::vector<Placed> items;
    for (const double x : values) items.push_back({x, static_cast<std::uint32_t>(items.size())});
    radix_sort(items, {});
    std::vector<std::uint32_t> order;
    for (const auto& item : items) {
        EXPECT_EQ(item.value, values[item.place]);
        order.push_back(item.place);
    }
    return order;
}

std::vector<std::uint32_t> order_by_library(const std::vector<double>& values) {
    std::vector<std::uint32_t> order;
    for (const double x : values) {
        (void)x;
        order.push_back(static_cast<std::uint32_t>(order.size()));
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return values[i]; });
    return order;
}

}  // namespace

TEST(RadixSort, SortsAllMagnitudes) {
    EXPECT_EQ(order_of({}), (std::vector<std::uint32_t>{}));
    EXPECT_EQ(order_of({.5}), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(order_of({1, 0, 0x1p-1074, 1e300, 1 - 0x1p-53, 0x1p-1022,
                        std::numeric_limits<double>::infinity()}),
              (std::vector<std::uint32_t>{1, 2, 5, 4, 0, 3, 6}));
}

TEST(RadixSort, AgreesWithTheLibraryAndKeepsTiesInOrder) {
    for (const std::uint64_t distinct : {1, 2, 100, 1'000'000}) {
        const Rng rng(distinct);
        std::vector<double> values;
        for (std::uint64_t i = 0; i < 5000; ++i)
            values.push_back(static_cast<double>(rng.below(i, distinct)) /
                             static_cast<double>(distinct));
        EXPECT_EQ(order_of(values), order_by_library(values)) << distinct << " values";
    }
}

TEST(RadixSort, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    std::vector<Placed> items(10);
    EXPECT_THROW(radix_sort(items, {.stop = source.get_token()}), Error);
}

}  // namespace stipple::testing::radix_sort_test
