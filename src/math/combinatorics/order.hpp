// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace stipple {

/// Indices 0, ..., n - 1 sorted by at(i); ties by i.
template <class At>
std::vector<std::uint32_t> order_by(std::size_t n, const At& at) {
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return at(a) != at(b) ? at(a) < at(b) : a < b;
    });
    return order;
}

}  // namespace stipple
