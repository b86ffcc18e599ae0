// SPDX-License-Identifier: MIT
#include "math/combinatorics/radix_sort.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/machine/large_pages.hpp"

namespace stipple {
namespace {

constexpr unsigned digit_bits = 11;
constexpr unsigned digit_count = 6;  // 6 * 11 bits cover the 64 bits of a double
constexpr std::size_t radix = std::size_t{1} << digit_bits;
constexpr std::size_t stretch = std::size_t{1} << 20;  // items between two checks of the stop token

using Histogram = std::array<std::uint32_t, radix>;

std::size_t digit(const Placed& item, unsigned d) {
    return std::bit_cast<std::uint64_t>(item.value) >> (d * digit_bits) & (radix - 1);
}

/// Calls body(i) for all i < n, with regular stop checks.
template <class Body>
void each(std::size_t n, const RunContext& run, Body&& body) {
    for (std::size_t first = 0; first < n; first += stretch) {
        run.check_stop();
        const std::size_t last = std::min(n, first + stretch);
        for (std::size_t i = first; i < last; ++i) body(i);
    }
}

}  // namespace

void radix_sort(std::vector<Placed>& items, const RunContext& run) {
    const std::size_t n = items.size();
    std::vector<Histogram> counts(digit_count, Histogram{});
    each(n, run, [&](std::size_t i) {
        for (unsigned d = 0; d < digit_count; ++d) ++counts[d][digit(items[i], d)];
    });
    std::vector<Placed> other;
    fill_with_zeros(other, n);
    for (unsigned d = 0; d < digit_count; ++d) {
        Histogram& next = counts[d];
        if (std::ranges::find(next, n) != next.end()) continue;  // all items have the same digit
        std::uint32_t before = 0;
        for (auto& count : next) before += std::exchange(count, before);
        each(n, run, [&](std::size_t i) { other[next[digit(items[i], d)]++] = items[i]; });
        items.swap(other);
    }
}

}  // namespace stipple
