// SPDX-License-Identifier: MIT
//
// Scrambles of binary digits. A coordinate is a 64-bit fraction with its first digit in the top
// bit; the upper 53 bits form the double.
//
//     digital shift   y_j = x_j + s_j                               s_j random digits
//     matrix          y_j = x_j + sum_(i < j) l_ji x_i + s_j        l random, lower triangular
//     nested uniform  y_j = x_j + f(x_1 ... x_(j-1))                a random digit for each prefix
//
// all modulo 2. For nested scrambling f is a hash of the prefix. Each prefix of 5 k digits, k = 0
// to 10, gives 31 random bits, one for each of its extensions by up to 4 digits.
//
// Promise  each is a bijection on the first m digits for every m, and keeps the (t,m,s)-net
//          property in base 2. 53 digits are random, including those after the last nonzero one.
// Source   A. B. Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", in Monte Carlo and
//          Quasi-Monte Carlo Methods in Scientific Computing (1995), 299-317,
//          doi:10.1007/978-1-4612-2552-2_19;
//          J. Matousek, J. Complexity 14 (1998) 527-556, doi:10.1006/jcom.1998.0489 (matrix).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/arithmetic/bits.hpp"

namespace stipple {

/// x in [0, 1] as a fraction; 1 becomes the largest fraction with 53 digits.
std::uint64_t unit_to_fraction(double x);

/// Random digital shift of a coordinate.
std::uint64_t binary_shift(std::uint64_t seed, std::size_t coordinate);

/// Columns of a random nonsingular lower triangular matrix; digit j of a word is bit 63 - j.
std::array<std::uint64_t, 64> binary_matrix(std::uint64_t seed, std::size_t coordinate);

/// Nested uniform (Owen) scrambling of one coordinate.
class BinaryOwen {
  public:
    BinaryOwen(std::uint64_t seed, std::size_t coordinate);

    /// Scrambles fractions in place; results have 53 digits.
    void apply(std::span<std::uint64_t> fractions) const;

    [[nodiscard]] std::uint64_t of(std::uint64_t fraction) const;

    /// Keys of the hash, two for each group of five digits and two for the upper part as a whole.
    struct Keys {
        std::array<std::uint32_t, 12> before;
        std::array<std::uint32_t, 12> between;
        std::array<std::uint32_t, 12> factor;  ///< factor of the upper part's hash; upper groups: 0
    };

  private:
    Keys keys_;
};

}  // namespace stipple
