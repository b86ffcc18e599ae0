// SPDX-License-Identifier: MIT
#include "math/digital/stratum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/machine/wide.hpp"
#include "math/arithmetic/ratio.hpp"

namespace stipple {
namespace {

/// The double nearest to the middle of [low / parts, high / parts). Strata are at least 2^-53 wide,
/// the maximum distance between neighbouring doubles below 1, so that this double is inside. The
/// exception is 2^53 parts: there the middle is a tie, which may round to the upper edge. Then the
/// lower edge is returned, which is a double.
double safe_point(std::uint64_t low, std::uint64_t high, std::uint64_t parts) {
    const auto n = static_cast<double>(parts);
    const double middle = ratio(Wide{low} + high, Wide{parts} * 2);
    const bool below_edge = std::fma(middle, n, -static_cast<double>(high)) < 0;
    return below_edge ? middle : static_cast<double>(low) / n;
}

/// True if x is strictly between the stratum's edges in doubles, and hence in exact arithmetic.
inline bool holds(double low, double width, double parts, double x) {
    const double scaled = x * parts;
    return (scaled > low) & (scaled < low + width);
}

/// Moves each x[j] from [0, 1) into stratum j; returns true if all are strictly inside.
STIPPLE_WIDE bool place(const double* low, double width, double parts, std::size_t count,
                        double* x) {
    std::int64_t outside = 0;
    for (std::size_t j = 0; j < count; ++j) {
        x[j] = (low[j] + width * x[j]) / parts;
        outside += holds(low[j], width, parts, x[j]) ? 0 : 1;
    }
    return outside == 0;
}

double safe_point_of(const Strata& strata, std::size_t j) {
    const auto low = static_cast<std::uint64_t>(strata.low[j]);
    return safe_point(low, low + strata.width, strata.parts);
}

/// Moves each x[j] from [0, 1) into stratum j.
void place_all(const Strata& strata, double* x) {
    const auto width = static_cast<double>(strata.width);
    const auto parts = static_cast<double>(strata.parts);
    if (place(strata.low.data(), width, parts, strata.low.size(), x)) return;
    for (std::size_t j = 0; j < strata.low.size(); ++j)
        if (!holds(strata.low[j], width, parts, x[j])) x[j] = safe_point_of(strata, j);
}

}  // namespace

void place_in_strata(Strata strata, double* x, std::size_t stride) {
    if (stride == 1) return place_all(strata, x);
    std::array<double, 1024> some;
    for (auto rest = strata.low; !rest.empty(); rest = rest.subspan(strata.low.size())) {
        strata.low = rest.first(std::min(some.size(), rest.size()));
        for (std::size_t j = 0; j < strata.low.size(); ++j) some[j] = x[j * stride];
        place_all(strata, some.data());
        for (std::size_t j = 0; j < strata.low.size(); ++j) x[j * stride] = some[j];
        x += strata.low.size() * stride;
    }
}

void place_in_middles(const Strata& strata, double* x, std::size_t stride) {
    // Half the width of a stratum exceeds all rounding errors, except with more than 2^50 parts.
    const bool roomy = strata.parts <= std::uint64_t{1} << 50;
    if (roomy)
        return fill_quotients(strata.low, 1, static_cast<double>(strata.width) / 2,
                              static_cast<double>(strata.parts), x, stride);
    for (std::size_t j = 0; j < strata.low.size(); ++j) x[j * stride] = safe_point_of(strata, j);
}

}  // namespace stipple
