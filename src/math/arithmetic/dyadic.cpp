// SPDX-License-Identifier: MIT
#include "math/arithmetic/dyadic.hpp"

#include <bit>
#include <cmath>

namespace stipple {

Dyadic dyadic(double x) {
    if (x == 0) return {0, 0};
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(std::frexp(x, &exponent) * 0x1p53);
    const int zeros = std::countr_zero(mantissa);
    return {mantissa >> zeros, static_cast<unsigned>(53 - exponent - zeros)};
}

Integer scaled(double x, unsigned places) {
    const Dyadic fraction = dyadic(x);
    return Integer(fraction.mantissa) << (places - fraction.places);
}

Integer power_of_two(unsigned exponent) {
    Integer power = 1;
    power <<= exponent;
    return power;
}

double quotient(const Integer& above, std::uint64_t below, unsigned places) {
    if (above == 0) return 0;
    const unsigned shift = 128;  // so that the quotient has 64 bits and more
    Integer rest = 0;
    Integer whole = 0;
    divide_qr(Integer(above << shift), Integer(below), whole, rest);
    const auto spare = static_cast<unsigned>(msb(whole)) - 54;
    const bool inexact = rest != 0 || lsb(whole) < spare;
    // 55 bits: those of the double, the next one, and whether anything follows.
    const auto top = static_cast<std::uint64_t>(Integer(whole >> spare)) | (inexact ? 1U : 0U);
    return std::ldexp(static_cast<double>(top),
                      static_cast<int>(spare) - static_cast<int>(shift + places));
}

}  // namespace stipple
