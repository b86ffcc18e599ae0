// SPDX-License-Identifier: MIT
#include "math/digital/stratum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/wide.hpp"
#include "math/functions/ratio.hpp"

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

/// Strata as doubles, which all their edges are.
struct Placing {
    Placing(const Strata& strata, std::size_t skipped)
        : low(static_cast<double>(strata.low + strata.step * skipped)),
          step(static_cast<double>(strata.step)),
          width(static_cast<double>(strata.width)),
          parts(static_cast<double>(strata.parts)) {}

    [[nodiscard]] double low_of(std::int32_t j) const { return low + step * j; }
    [[nodiscard]] double place(std::int32_t j, double u) const {
        return (low_of(j) + width * u) / parts;
    }

    /// Strictly between the edges after rounding is strictly between them before.
    [[nodiscard]] bool holds(std::int32_t j, double x) const {
        const double scaled = x * parts;
        return (scaled > low_of(j)) & (scaled < low_of(j) + width);
    }

    double low;
    double step;
    double width;
    double parts;
};

/// Points placed at a time.
constexpr std::size_t portion = 1024;

/// Places numbers; whether all are inside of their strata.
STIPPLE_WIDE bool place(Placing placing, std::int32_t count, double* x) {
    std::int64_t outside = 0;
    for (std::int32_t j = 0; j < count; ++j) {
        x[j] = placing.place(j, x[j]);
        outside += placing.holds(j, x[j]) ? 0 : 1;
    }
    return outside == 0;
}

/// Places each number in a stratum of its own, one part wide; whether all are inside.
STIPPLE_WIDE bool place_each(const double* low, double parts, std::size_t count, double* x) {
    std::int64_t outside = 0;
    for (std::size_t j = 0; j < count; ++j) {
        x[j] = (low[j] + x[j]) / parts;
        const double scaled = x[j] * parts;
        outside += (scaled > low[j]) & (scaled < low[j] + 1) ? 0 : 1;
    }
    return outside == 0;
}

void place_each_in_strata(std::span<const double> low, std::uint64_t parts, double* x) {
    const auto n = static_cast<double>(parts);
    if (place_each(low.data(), n, low.size(), x)) return;
    for (std::size_t j = 0; j < low.size(); ++j) {
        if (x[j] * n > low[j] && x[j] * n < low[j] + 1) continue;
        const auto first = static_cast<std::uint64_t>(low[j]);
        x[j] = safe_point(first, first + 1, parts);
    }
}

/// Places numbers side by side, the j-th in the (first + j)-th stratum.
void place_in_strata(const Strata& strata, std::size_t first, std::span<double> x) {
    const Placing placing(strata, first);
    if (place(placing, static_cast<std::int32_t>(x.size()), x.data())) return;
    for (std::size_t j = 0; j < x.size(); ++j) {
        const std::uint64_t low = strata.low + strata.step * (first + j);
        if (!placing.holds(static_cast<std::int32_t>(j), x[j]))
            x[j] = safe_point(low, low + strata.width, strata.parts);
    }
}

}  // namespace

void place_in_strata(const Strata& strata, std::size_t count, double* x, std::size_t stride) {
    std::array<double, portion> some;
    for (std::size_t at = 0; at < count; at += portion, x += portion * stride) {
        const std::size_t size = std::min(portion, count - at);
        for (std::size_t j = 0; j < size; ++j) some[j] = x[j * stride];
        place_in_strata(strata, at, std::span(some).first(size));
        for (std::size_t j = 0; j < size; ++j) x[j * stride] = some[j];
    }
}

void place_in_strata(std::span<const double> low, std::uint64_t parts, double* x,
                     std::size_t stride) {
    if (stride == 1) return place_each_in_strata(low, parts, x);
    std::array<double, portion> some;
    for (; !low.empty(); x += portion * stride) {
        const auto part = low.first(std::min(portion, low.size()));
        for (std::size_t j = 0; j < part.size(); ++j) some[j] = x[j * stride];
        place_each_in_strata(part, parts, some.data());
        for (std::size_t j = 0; j < part.size(); ++j) x[j * stride] = some[j];
        low = low.subspan(part.size());
    }
}

void place_pairs_in_strata(const Strata& first, const Strata& second, std::size_t count,
                           double* rows) {
    std::array<double, portion> x;
    std::array<double, portion> y;
    for (std::size_t at = 0; at < count; at += portion, rows += 2 * portion) {
        const std::size_t size = std::min(portion, count - at);
        for (std::size_t j = 0; j < size; ++j) {
            x[j] = rows[2 * j];
            y[j] = rows[2 * j + 1];
        }
        place_in_strata(first, at, std::span(x).first(size));
        place_in_strata(second, at, std::span(y).first(size));
        for (std::size_t j = 0; j < size; ++j) {
            rows[2 * j] = x[j];
            rows[2 * j + 1] = y[j];
        }
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
