// SPDX-License-Identifier: MIT
//
// Radical inverse of i in base b: the digits of i, reversed behind the point.
//
//     phi_b(i) = sum_j a_j b^(-j-1) = m / b^k    where    i = sum_j a_j b^j,  0 <= a_j < b,
//
// and m is the whole number whose k digits are those of i in reverse.
//
// Shape    i in [0, 2^53), b in [2, 65536].
// Promise  correctly rounded: m and b^k are exact and are divided once. Never 1, for i < 2^53 keeps
//          1 - phi_b(i) >= 2^-53.
// Source   J. H. Halton, Numer. Math. 2 (1960) 84-90, doi:10.1007/BF01386213.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stipple {

/// Tables of the images of low digits have at most this many entries: 8 KiB, so that a few of them
/// stay in the first-level cache.
constexpr std::uint64_t largest_digit_table = 1024;

/// Radical inverses. Of consecutive indices the low digits come reversed from a table, so that each
/// costs a multiplication, an addition and a division.
class RadicalInverse {
  public:
    explicit RadicalInverse(std::uint32_t base);

    /// Every digit goes through the permutation, of which 0 is a fixed point, first.
    RadicalInverse(std::uint32_t base, std::vector<std::uint32_t> permutation);

    /// phi_base(index).
    [[nodiscard]] double of(std::uint64_t index) const;

    /// out[j * stride] = of(first + j) for j < count.
    void fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;

  private:
    std::uint64_t base_;
    std::uint64_t block_;           ///< b^t, the number of values that the t low digits have
    std::vector<double> reversed_;  ///< of the low digits; empty for t = 1, where nothing turns
    std::vector<std::uint32_t> permutation_;  ///< of the digits; empty: none
};

}  // namespace stipple
