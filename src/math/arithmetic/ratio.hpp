// SPDX-License-Identifier: MIT
//
// Ratios of integers as doubles in [0, 1), correctly rounded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/machine/int128.hpp"

namespace stipple {

using Wide = Uint128;

/// Integers up to this limit are exact doubles, and their quotients are correctly rounded.
inline constexpr std::uint64_t exact_limit = std::uint64_t{1} << 53;

namespace detail {
double wide_ratio(Wide numerator, Wide denominator);
}

/// Returns numerator / denominator rounded to the nearest double, ties to even, but at most 1 -
/// 2^-53. Needs numerator < denominator <= 2^72.
inline double ratio(Wide numerator, Wide denominator) {
    if (denominator > exact_limit) return detail::wide_ratio(numerator, denominator);
    return static_cast<double>(static_cast<std::uint64_t>(numerator)) /
           static_cast<double>(static_cast<std::uint64_t>(denominator));
}

/// Sets x[j * stride] = ratio(first + j step, whole) for j < count; all ratios must be below 1.
void fill_ratios(Wide first, Wide step, Wide whole, std::size_t count, double* x,
                 std::size_t stride);

/// Sets x[j * stride] = (numbers[j] factor + term) / whole, in doubles.
void fill_quotients(std::span<const double> numbers, double factor, double term, double whole,
                    double* x, std::size_t stride);

}  // namespace stipple
