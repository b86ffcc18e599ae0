// SPDX-License-Identifier: MIT
//
// Powers and roots of counts, in whole numbers; whole powers of real numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stipple {

/// base^exponent, or the largest 64-bit number when it does not fit.
std::uint64_t saturating_power(std::uint64_t base, std::size_t exponent);

/// The largest k with k^exponent <= value; value and exponent at least 1.
std::uint64_t floor_root(std::uint64_t value, std::size_t exponent);

/// The k^exponent nearest to value, k >= 1; the smaller of two that are equally near.
std::uint64_t nearest_power(std::uint64_t value, std::size_t exponent);

/// x^exponent by multiplications.
inline double whole_power(double x, std::size_t exponent) {
    double power = 1;
    for (; exponent > 0; exponent /= 2, x *= x)
        if (exponent % 2 == 1) power *= x;
    return power;
}

/// base^exponent as a real number.
double real_power_of(std::size_t base, std::size_t exponent);

/// The square root, rounded to the nearest whole number.
std::uint64_t rounded_root(std::uint64_t value);

}  // namespace stipple
