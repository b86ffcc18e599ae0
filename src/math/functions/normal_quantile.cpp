// SPDX-License-Identifier: MIT
#include "math/functions/normal_quantile.hpp"

#include <cstdint>

#include "core/machine/wide.hpp"

namespace stipple {
namespace {

constexpr std::size_t most = 128;

/// Whether all are done; else those of the far tails are left for later. The marks are small, so
/// that vectors of them hold many numbers, and that many chains of operations run side by side.
STIPPLE_WIDE [[gnu::flatten]] bool quantiles(const double* p, double* x, std::size_t count) {
    constexpr double far = 1.4e-11;  // a little above exp(-25)
    std::array<std::uint16_t, most> marks;
    for (std::size_t i = 0; i < count; ++i) {
        const double tail = detail::bounded_tail(p[i]);
        marks[i] = tail < far ? 1 : 0;
        x[i] = detail::near_normal_quantile(p[i] - 0.5, tail);
    }
    std::uint16_t left = 0;
    for (std::size_t i = 0; i < count; ++i) left = static_cast<std::uint16_t>(left | marks[i]);
    return left == 0;
}

}  // namespace

void bounded_normal_quantiles(std::span<double> p) {
    std::array<double, most> x;
    for (std::size_t first = 0; first < p.size(); first += most) {
        const auto some = p.subspan(first, std::min(most, p.size() - first));
        const bool done = quantiles(some.data(), x.data(), some.size());
        for (std::size_t i = 0; i < some.size(); ++i)
            some[i] = done ? x[i] : bounded_normal_quantile(some[i]);
    }
}

}  // namespace stipple
