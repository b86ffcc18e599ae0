// SPDX-License-Identifier: MIT
//
// Sine, cosine and the angle of a vector, in turns (1 turn = 2 pi), without the C library, whose
// results differ between machines:
//
//     cos_sin_turns(u) = (cos 2 pi u, sin 2 pi u)        turns_of(x, y) = atan2(y, x) / 2 pi mod 1
//
// An angle in turns is reduced exactly, by whole quarters, to |t| <= 1/8, and converted to radians
// with twice the working precision. Sine and cosine are then their power series up to y^17 and
// y^16, truncated by less than 3e-18. The angle of a vector is reduced by eighths to |q| <=
// tan(pi/8), where atan(q) / (2 pi q) is a polynomial of degree 11 in q^2, interpolated at the
// zeros of a Chebyshev polynomial; its relative error is below 2e-18.
//
// Units   turns.
// Cost    about 65 additions and multiplications for a pair (cos, sin), no branches or tables, so
//         that compilers vectorise loops over it; about 30 and a division for an angle.
// Promise sine and cosine within 1 unit in the last place, and never -0; the nearest doubles at
//         whole eighths (0, sqrt(1/2), 1), and with the symmetries of sine and cosine to the last
//         bit. The angle within 2^-53, and below 1/8 within 2 units in the last place; exact at
//         whole eighths; always in [0, 1). The same bits on every machine with IEEE 754 arithmetic,
//         compiled without contraction into fused multiply-adds.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/rng.hpp"
#include "math/functions/horner.hpp"

namespace stipple {

struct CosSin {
    double cos;
    double sin;
};

/// Cosine and sine of an angle in [-1/8, 1/8] turns.
inline CosSin cos_sin_eighth(double t) {
    // y + y_low = 2 pi t to twice the precision. 2 pi = head + tail; head and the upper part of t
    // have 26 bits each, so that their product is exact.
    constexpr double head = 0x1.921fb5p+2;
    constexpr double tail = 0x1.110b4611a6263p-24;
    const double upper = std::bit_cast<double>(std::bit_cast<std::uint64_t>(t) & ~0x7ffffffULL);
    const double rest = (t - upper) * head + t * tail;
    const double y = upper * head + rest;
    const double y_low = (upper * head - y) + rest;
    const double z = y * y;
    const double half = 0.5 * z;

    // Coefficients 1/17!, 1/15!, ..., 1/3! with alternating signs.
    const double s = horner(z, 1 / 355687428096000.0, -1 / 1307674368000.0, 1 / 6227020800.0,
                            -1 / 39916800.0, 1 / 362880.0, -1 / 5040.0, 1 / 120.0, -1 / 6.0);

    // Coefficients 1/16!, 1/14!, ..., 1/4! with alternating signs.
    const double c = horner(z, 1 / 20922789888000.0, -1 / 87178291200.0, 1 / 479001600.0,
                            -1 / 3628800.0, 1 / 40320.0, -1 / 720.0, 1 / 24.0);

    // The rounding error of 1 - half is added to the small terms.
    const double near = 1 - half;
    return {near + (((1 - near) - half) + (z * z * c - y * y_low)), y + (y * z * s + y_low * near)};
}

/// Cosine and sine of an angle in [0, 1] turns.
inline CosSin cos_sin_turns(double u) {
    constexpr double round = 0x1.8p52;  // adding it puts the nearest integer into the low bits
    const double sum = 4 * u + round;
    const double t = u - 0.25 * (sum - round);
    const auto quarter = std::bit_cast<std::uint64_t>(sum);
    const auto [c, s] = cos_sin_eighth(t);
    const auto c_bits = std::bit_cast<std::uint64_t>(c);
    const auto s_bits = std::bit_cast<std::uint64_t>(s);
    const std::uint64_t differ = (c_bits ^ s_bits) & (0 - (quarter & 1));
    const std::uint64_t c_sign = ((quarter + 1) & 2) << 62;
    const std::uint64_t s_sign = (quarter & 2) << 62;
    // Adding 0 changes -0 to 0.
    return {std::bit_cast<double>((c_bits ^ differ) ^ c_sign) + 0.0,
            std::bit_cast<double>((s_bits ^ differ) ^ s_sign) + 0.0};
}

namespace detail {

/// atan(q) in turns for |q| <= tan(pi/8).
inline double atan_turns(double q) {
    const double z = q * q;
    const double p = horner(z, -0.0028338169789549517, 0.006042358389537228, -0.00801361444942206,
                            0.009305595826769162, -0.010604417167221923, 0.012242270369000226,
                            -0.014468611643008781, 0.01768388198295435, -0.022736420431411494,
                            0.03183098861828499, -0.05305164769729811, 0.15915494309189535);
    return q * p;
}

}  // namespace detail

/// Angle of the vector (x, y) from the x axis towards the y axis, in [0, 1) turns; 0 for the null
/// vector. x and y must be finite and not both above 2^1022.
inline double turns_of(double x, double y) {
    constexpr double tan_sixteenth = 0.41421356237309503;
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    const double small = std::min(ax, ay);
    const double big = std::max(ax, ay);
    // The angle is base + sign * part, with base a whole number of eighths, so that only one
    // addition rounds. Reflections are products: branches would be mispredicted half of the time,
    // and would keep loops from being vectorised.
    const double null = big == 0;
    const double middle = small > tan_sixteenth * big;
    const double steep = ay > ax;
    const double left = x < 0;
    const double below = y < 0;
    const double part = detail::atan_turns((small - middle * big) / (big + middle * small + null));
    double base = 0.125 * middle;
    base = 0.25 * steep + (1 - 2 * steep) * base;
    base = 0.5 * left + (1 - 2 * left) * base;
    base = below + (1 - 2 * below) * base;
    const double sign = (1 - 2 * steep) * (1 - 2 * left) * (1 - 2 * below);
    // Rounding may give a whole turn just below the x axis.
    return std::min(base + sign * part, one_minus_ulp);
}

}  // namespace stipple
