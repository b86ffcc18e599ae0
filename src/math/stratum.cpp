// SPDX-License-Identifier: MIT
#include "math/stratum.hpp"

#include <cmath>

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

}  // namespace stipple
