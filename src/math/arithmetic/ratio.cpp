// SPDX-License-Identifier: MIT
#include "math/arithmetic/ratio.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/rng.hpp"

namespace stipple {
namespace {

int bit_width(Wide x) {
    const auto high = static_cast<std::uint64_t>(x >> 64);
    return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                     : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(x)));
}

}  // namespace

double detail::wide_ratio(Wide numerator, Wide denominator) {
    if (numerator == 0) return 0;
    // A quotient of 55 or 56 bits: two more than a double holds. The remainder joins as one sticky
    // bit below them, so that the conversion to double is the one and only rounding.
    const int shift = bit_width(denominator) - bit_width(numerator) + 55;
    const Wide scaled = numerator << shift;
    const auto quotient = static_cast<std::uint64_t>(scaled / denominator);
    const std::uint64_t sticky = scaled % denominator != 0;
    const double rounded = std::ldexp(static_cast<double>(quotient << 1 | sticky), -(shift + 1));
    return std::min(rounded, one_minus_ulp);
}

void fill_ratios(std::uint64_t first, std::uint64_t step, std::uint64_t whole, std::size_t count,
                 double* x, std::size_t stride) {
    if (whole > exact_limit) {
        for (std::size_t j = 0; j < count; ++j) x[j * stride] = ratio(first + step * j, whole);
        return;
    }
    // Every number here is whole and at most 2^53: only the division rounds.
    const auto begin = static_cast<double>(first);
    const auto ahead = static_cast<double>(step);
    const auto parts = static_cast<double>(whole);
    for (std::size_t j = 0; j < count; ++j)
        x[j * stride] = (begin + ahead * static_cast<double>(static_cast<std::int64_t>(j))) / parts;
}

}  // namespace stipple
