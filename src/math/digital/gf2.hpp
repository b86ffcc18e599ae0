// SPDX-License-Identifier: MIT
//
// Polynomials over the field of two elements, stored as integers: bit j is the coefficient of x^j,
// so x^3 + x + 1 is 11.
//
// Shape   degrees up to 52.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "math/combinatorics/primes.hpp"

namespace stipple::gf2 {

/// Degree of p; -1 for p = 0.
constexpr int degree(std::uint64_t p) { return static_cast<int>(std::bit_width(p)) - 1; }

/// Remainder of a divided by p != 0.
constexpr std::uint64_t remainder(std::uint64_t a, std::uint64_t p) {
    while (degree(a) >= degree(p)) a ^= p << (degree(a) - degree(p));
    return a;
}

constexpr std::uint64_t common_divisor(std::uint64_t a, std::uint64_t b) {
    while (b != 0) {
        const std::uint64_t rest = remainder(a, b);
        a = b;
        b = rest;
    }
    return a;
}

/// a b modulo p; the degrees of a and b must be below that of p.
constexpr std::uint64_t product(std::uint64_t a, std::uint64_t b, std::uint64_t p) {
    const std::uint64_t top = std::uint64_t{1} << degree(p);
    std::uint64_t sum = 0;
    for (; b != 0; b >>= 1) {
        if ((b & 1) != 0) sum ^= a;
        a <<= 1;
        if ((a & top) != 0) a ^= p;
    }
    return sum;
}

constexpr std::uint64_t power(std::uint64_t a, std::uint64_t exponent, std::uint64_t p) {
    std::uint64_t result = remainder(1, p);
    for (; exponent > 0; exponent >>= 1, a = product(a, a, p))
        if ((exponent & 1) != 0) result = product(result, a, p);
    return result;
}

namespace detail {
/// x^(2^k) modulo p.
constexpr std::uint64_t frobenius(int k, std::uint64_t p) {
    std::uint64_t value = remainder(2, p);
    for (; k > 0; --k) value = product(value, value, p);
    return value;
}
}  // namespace detail

/// True if p of degree m >= 1 has no factor except itself and 1: x^(2^m) = x modulo p, and
/// x^(2^(m/r)) - x is coprime to p for every prime factor r of m (Rabin 1980).
constexpr bool is_irreducible(std::uint64_t p) {
    const int m = degree(p);
    if (m < 1) return false;
    if (detail::frobenius(m, p) != remainder(2, p)) return false;
    for (int r = 2; r <= m; ++r)
        if (m % r == 0 && is_prime(static_cast<std::uint64_t>(r)) &&
            common_divisor(p, detail::frobenius(m / r, p) ^ remainder(2, p)) != 1)
            return false;
    return true;
}

/// The irreducible polynomial of degree m >= 1 that is smallest as an integer.
constexpr std::uint64_t smallest_irreducible(int m) {
    std::uint64_t p = std::uint64_t{1} << m;
    while (!is_irreducible(p)) ++p;
    return p;
}

/// True if the powers of a are all 2^m - 1 units modulo p, which must be irreducible of degree m.
constexpr bool is_generator(std::uint64_t a, std::uint64_t p) {
    const std::uint64_t order = (std::uint64_t{1} << degree(p)) - 1;
    for (std::uint64_t rest = order; rest > 1;) {
        const std::uint64_t factor = smallest_factor(rest);
        if (power(a, order / factor, p) == 1) return false;
        while (rest % factor == 0) rest /= factor;
    }
    return true;
}

/// All units modulo an irreducible p, as powers 1, g, g^2, ... of the smallest generator g.
inline std::vector<std::uint32_t> units(std::uint32_t p) {
    std::uint64_t g = 1;
    while (!is_generator(g, p)) ++g;
    std::vector<std::uint32_t> found;
    std::uint64_t unit = 1;
    do {
        found.push_back(static_cast<std::uint32_t>(unit));
        unit = product(unit, g, p);
    } while (unit != 1);
    return found;
}

}  // namespace stipple::gf2
