// SPDX-License-Identifier: MIT
//
// Integer powers and roots of counts; integer powers of real numbers; powers of 2 as units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace stipple {

/// base^exponent, or the largest 64-bit number if it overflows.
std::uint64_t saturating_power(std::uint64_t base, std::size_t exponent);

/// The largest k with k^exponent <= value; value and exponent must be at least 1.
std::uint64_t floor_root(std::uint64_t value, std::size_t exponent);

/// The power k^exponent, k >= 1, nearest to value; the smaller one on a tie.
std::uint64_t nearest_power(std::uint64_t value, std::size_t exponent);

/// x^exponent by repeated squaring.
inline double whole_power(double x, std::size_t exponent) {
    double power = 1;
    for (; exponent > 0; exponent /= 2, x *= x)
        if (exponent % 2 == 1) power *= x;
    return power;
}

/// The largest power of 2 up to a size, between 2^-1022 and 2^1022; 1 if the size is 0 or not finite.
/// Dividing numbers of this size by it keeps their digits, and their powers leave float64 no more.
double unit_for(double size);
/// The same for the largest magnitude of several numbers.
double unit_for(std::span<const double> numbers);

/// The unit for the largest magnitude of the numbers.
double unit_for(std::span<const double> numbers);

/// base^exponent as a double.
double real_power_of(std::size_t base, std::size_t exponent);

/// The square root, rounded to the nearest integer.
std::uint64_t rounded_root(std::uint64_t value);

}  // namespace stipple
