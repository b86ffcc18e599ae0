// SPDX-License-Identifier: MIT
//
// d-th roots of doubles, without the C library's pow and cbrt, whose results differ between
// machines.
//
// Promise the same bits on every machine with IEEE 754 arithmetic; within 4 units in the last
//         place; the cube root within 1, and exact for cubes.
// Source  The cube root's last step is that of FDLIBM's s_cbrt.c (Sun Microsystems, 1993).
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace stipple {

/// value^(1/degree) for a finite value > 0 and a degree in [1, 64].
inline double nth_root(double value, std::size_t degree) {
    if (degree == 1) return value;
    if (degree == 2) return std::sqrt(value);
    const auto d = static_cast<int>(degree);
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);  // in [1/2, 1)
    const int whole = (exponent >= 0 ? exponent : exponent - d + 1) / d;
    const double rest = std::ldexp(fraction, exponent - whole * d);  // in [1/2, 2^(d-1))
    // Newton steps decrease from any start at or above the root, until rounding stops them.
    double root = 2;
    for (double last = 3; root < last;) {
        last = root;
        double power = 1;
        for (int i = 1; i < d; ++i) power *= root;
        root -= (root - rest / power) / d;
    }
    return std::ldexp(root, whole);
}

namespace detail {

/// A number t 8^(third - 341) with t in [1/2, 4), and a first guess of the cube root of t.
struct CubeRootStart {
    double t;
    double root;          ///< guess of the cube root of t, relative error 2e-7
    std::uint64_t third;  ///< a third of the biased exponent; 341 is that of the bias
};

/// Splits a number >= 2^-1022 into t and a power of 8, and guesses the cube root of t.
[[gnu::always_inline]] inline CubeRootStart cube_root_start(double size) {
    constexpr double round = 0x1.8p52;  // adding it puts the nearest integer into the low bits
    const auto bits = std::bit_cast<std::uint64_t>(size);
    const std::uint64_t exponent = bits >> 52;
    const double sum =
        (std::bit_cast<double>(0x4330000000000000 | exponent) - 0x1p52) * (1 / 3.0) + round;
    const std::uint64_t third = std::bit_cast<std::uint64_t>(sum) & 0x7ff;
    const auto t = std::bit_cast<double>(bits - ((3 * third - 1023) << 52));
    // Polynomial with an error of 0.6 %, then a Halley step, which cubes the error.
    const double y = 0.541053 + t * (0.578653 + t * (-0.137501 + t * 0.0146881));
    const double cube = y * y * y;
    return {t, y * (cube + 2 * t) / (2 * cube + t), third};
}

inline double cube_root_power(std::uint64_t third) {
    return std::bit_cast<double>((third + 1023 - 341) << 52);
}

}  // namespace detail

/// The cube root of any finite number, with its sign. Has no branches, so loops vectorise.
inline double cube_root(double value) {
    const double size = std::abs(value);
    const bool tiny = size < 0x1p-1022;
    const auto [t, near, third] = detail::cube_root_start(tiny ? size * 0x1p54 : size);
    // Keeps 26 bits, so that the square in the last step is exact.
    double y = std::bit_cast<double>(std::bit_cast<std::uint64_t>(near) & ~0x7ffffffULL);
    const double ratio = t / (y * y);
    y += y * ((ratio - y) / (2 * y + ratio));
    const double power = detail::cube_root_power(third);
    const double root = y * (tiny ? power * 0x1p-18 : power);
    return std::copysign(size > 0 ? root : 0, value);
}

/// The cube root of a number of at least 2^-1022, with a relative error of 2e-7: a starting value.
inline double rough_cube_root(double value) {
    const auto [t, root, third] = detail::cube_root_start(value);
    return root * detail::cube_root_power(third);
}

}  // namespace stipple
