// SPDX-License-Identifier: MIT
//
// The first 1000 primes, 2, 3, 5, ..., 7919; primality test, next prime and smallest factor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stipple {
namespace detail {

consteval std::array<std::uint32_t, 1000> first_primes() {
    std::array<std::uint32_t, 1000> found{2};
    std::size_t count = 1;
    for (std::uint32_t candidate = 3; count < found.size(); candidate += 2) {
        std::size_t k = 1;
        while (k < count && found[k] * found[k] <= candidate && candidate % found[k] != 0) ++k;
        if (k == count || found[k] * found[k] > candidate) found[count++] = candidate;
    }
    return found;
}

}  // namespace detail

inline constexpr std::array<std::uint32_t, 1000> primes = detail::first_primes();

/// The smallest factor of n >= 2 other than 1; n itself if prime. Cost O(sqrt(n)).
constexpr std::uint64_t smallest_factor(std::uint64_t n) {
    for (std::uint64_t factor = 2; factor * factor <= n; ++factor)
        if (n % factor == 0) return factor;
    return n;
}

constexpr bool is_prime(std::uint64_t n) { return n >= 2 && smallest_factor(n) == n; }

/// The smallest prime p >= n.
constexpr std::uint64_t next_prime(std::uint64_t n) {
    while (!is_prime(n)) ++n;
    return n;
}

}  // namespace stipple
