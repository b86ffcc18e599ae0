// SPDX-License-Identifier: MIT
#include "math/stratum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/wide.hpp"
#include "math/ratio.hpp"

namespace stipple {
namespace {

/// The double nearest to the middle of [low / parts, high / parts). Strata are at least 2^-53 wide,
/// which is how far apart doubles are at most, so that it is inside; but for 2^53 parts the middle
/// is a tie and may go to the upper edge, and there the lower one is a double.
double safe_point(std::uint64_t low, std::uint64_t high, std::uint64_t parts) {
    const auto n = static_cast<double>(parts);
    const double middle = ratio(Wide{low} + high, Wide{parts} * 2);
    const bool below_edge = std::fma(middle, n, -static_cast<double>(high)) < 0;
    return below_edge ? middle : static_cast<double>(low) / n;
}

/// x[j] = (low[j] + x[j]) / parts; whether all are strictly between the edges after rounding.
STIPPLE_WIDE bool move_inside(const double* low, double parts, std::size_t count, double* x) {
    std::int64_t outside = 0;
    for (std::size_t j = 0; j < count; ++j) {
        const double value = (low[j] + x[j]) / parts;
        const double scaled = value * parts;
        outside += scaled > low[j] && scaled < low[j] + 1 ? 0 : 1;
        x[j] = value;
    }
    return outside == 0;
}

}  // namespace

void place_in_strata(const Strata& strata, std::size_t count, double* x, std::size_t stride) {
    const auto first = static_cast<double>(strata.low);
    const auto step = static_cast<double>(strata.step);
    const auto width = static_cast<double>(strata.width);
    const auto parts = static_cast<double>(strata.parts);
    // Strictly between the edges after rounding is strictly between them before.
    const auto inside = [&](std::size_t j, double value) {
        const double low = first + step * static_cast<double>(static_cast<std::int64_t>(j));
        const double scaled = value * parts;
        return scaled > low && scaled < low + width;
    };
    bool all_inside = true;
    for (std::size_t j = 0; j < count; ++j) {
        const double low = first + step * static_cast<double>(static_cast<std::int64_t>(j));
        x[j * stride] = (low + width * x[j * stride]) / parts;
        all_inside &= inside(j, x[j * stride]);
    }
    if (all_inside) return;
    for (std::size_t j = 0; j < count; ++j) {
        const std::uint64_t low = strata.low + strata.step * j;
        if (!inside(j, x[j * stride]))
            x[j * stride] = safe_point(low, low + strata.width, strata.parts);
    }
}

void place_in_middles(const Strata& strata, std::size_t count, double* x, std::size_t stride) {
    // Half a stratum is more than all rounding, unless there are very many.
    const bool roomy = strata.parts <= std::uint64_t{1} << 50;
    for (std::size_t j = 0; j < count; ++j) {
        const std::uint64_t low = strata.low + strata.step * j;
        x[j * stride] = roomy ? ratio(2 * low + strata.width, 2 * strata.parts)
                              : safe_point(low, low + strata.width, strata.parts);
    }
}

void place_in_strata(std::span<const double> low, std::uint64_t parts, double* x,
                     std::size_t stride) {
    constexpr std::size_t most = 256;
    std::array<double, most> value;
    for (std::size_t begin = 0; begin < low.size(); begin += most) {
        const auto part = low.subspan(begin, std::min(most, low.size() - begin));
        double* to = x + begin * stride;
        for (std::size_t j = 0; j < part.size(); ++j) value[j] = to[j * stride];
        if (!move_inside(part.data(), static_cast<double>(parts), part.size(), value.data()))
            for (std::size_t j = 0; j < part.size(); ++j) {
                const auto first = static_cast<std::uint64_t>(part[j]);
                const double scaled = value[j] * static_cast<double>(parts);
                if (!(scaled > part[j] && scaled < part[j] + 1))
                    value[j] = safe_point(first, first + 1, parts);
            }
        for (std::size_t j = 0; j < part.size(); ++j) to[j * stride] = value[j];
    }
}

void place_in_middles(std::span<const double> low, std::uint64_t parts, double* x,
                      std::size_t stride) {
    const bool roomy = parts <= std::uint64_t{1} << 50;
    const auto whole = static_cast<double>(parts);
    for (std::size_t j = 0; j < low.size(); ++j) {
        const auto first = static_cast<std::uint64_t>(low[j]);
        x[j * stride] = roomy ? (low[j] + 0.5) / whole : safe_point(first, first + 1, parts);
    }
}

}  // namespace stipple
