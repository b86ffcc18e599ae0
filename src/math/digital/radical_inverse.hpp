// SPDX-License-Identifier: MIT
//
// Radical inverse of i in base b: the digits of i in reverse order after the point.
//
//     phi_b(i) = sum_j a_j b^(-j-1) = m / b^k    where    i = sum_j a_j b^j,  0 <= a_j < b,
//
// and m is the integer whose k digits are those of i in reverse.
//
// Shape    i in [0, 2^53), b in [2, 65536].
// Promise  correctly rounded: m and b^k are exact and divided once. Never 1, since i < 2^53 implies
//          1 - phi_b(i) >= 2^-53.
// Source   J. H. Halton, Numer. Math. 2 (1960) 84-90, doi:10.1007/BF01386213.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stipple {

/// Maximum number of images of low digits in a table: 8 KiB, of which several fit into the
/// first-level cache.
constexpr std::uint64_t largest_digit_table = 1024;

/// Radical inverses. For consecutive indices the reversed low digits come from a table, so that
/// each index costs a multiplication, an addition and a division.
class RadicalInverse {
  public:
    explicit RadicalInverse(std::uint32_t base);

    /// @param permutation applied to every digit first; must map 0 to 0
    RadicalInverse(std::uint32_t base, std::vector<std::uint32_t> permutation);

    /// Returns phi_base(index).
    [[nodiscard]] double of(std::uint64_t index) const;

    /// Sets out[j * stride] = of(first + j) for j < count.
    void fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;

  private:
    std::uint64_t base_;
    std::uint64_t block_;           ///< b^t, the number of values of the t low digits
    std::uint64_t last_power_ = 0;  ///< upper limit of b^j with b^j b^t <= 2^53
    std::vector<double> reversed_;  ///< reversed low digits; empty if t = 1 without permutation
    std::vector<std::uint32_t> permutation_;  ///< permutation of the digits; empty for none
};

}  // namespace stipple
