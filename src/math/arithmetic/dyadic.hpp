// SPDX-License-Identifier: MIT
//
// Doubles as the fractions that they are, for comparisons and quotients without rounding.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

namespace stipple {

using Integer = boost::multiprecision::cpp_int;

/// A double in [0, 1] as mantissa * 2^-places, with an odd mantissa or 0.
struct Dyadic {
    std::uint64_t mantissa;
    unsigned places;
};

Dyadic dyadic(double x);

/// x * 2^places for an x in [0, 1] that has no more binary places than that.
Integer scaled(double x, unsigned places);

/// 2^exponent.
Integer power_of_two(unsigned exponent);

/// above / (below * 2^places), rounded to the nearest double, ties to even. Needs above >= 0.
double quotient(const Integer& above, std::uint64_t below, unsigned places);

}  // namespace stipple
