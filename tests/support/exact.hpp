// SPDX-License-Identifier: MIT
//
// Exact arithmetic for oracles: doubles as fractions of integers.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace stipple::testing {

using Fraction = boost::multiprecision::cpp_rational;

/// Exact value of a double.
inline Fraction exactly(double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    const Fraction whole(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
    const int shift = exponent - 53;
    const boost::multiprecision::cpp_int two_power = boost::multiprecision::cpp_int(1)
                                                     << std::abs(shift);
    return shift < 0 ? Fraction(whole / two_power) : Fraction(whole * two_power);
}

/// Whether x is the double nearest to the fraction, with ties rounded to even.
inline bool is_nearest_double(double x, const Fraction& value) {
    const Fraction error = abs(exactly(x) - value);
    for (const double other : {std::nextafter(x, -1.0), std::nextafter(x, 2.0)}) {
        const Fraction other_error = abs(exactly(other) - value);
        int exponent = 0;
        const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
        if (other_error < error || (other_error == error && digits % 2 != 0)) return false;
    }
    return true;
}

}  // namespace stipple::testing
