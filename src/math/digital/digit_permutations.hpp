// SPDX-License-Identifier: MIT
//
// Permutations of the digits of radical inverses,
//
//     sum_j pi_j(a_j) b^(-j-1)    where    i = sum_j a_j b^j,  0 <= a_j < b.
//
// Faure's: one permutation for all positions j, made for a small discrepancy; pi(0) = 0. It is
// (0, 1) for b = 2; (2 pi, 2 pi + 1) of that of b / 2 for even b; for odd b that of b - 1 with the
// values from c = (b - 1) / 2 on raised by 1, and c put into the middle.
//
// Random: an independent permutation for each position, for the endlessly many zeros before the
// first digit of i, too. Those that no index below 2^53 fills with anything else give one uniform
// number.
//
// Shape    i in [0, 2^53), b in [2, 65536].
// Promise  random: within 2^-52 of the sum above, below 1, and in the interior of the interval that
//          the t low digits lead to, b^t being at most max(b, 1024).
// Source   H. Faure, J. Number Theory 42 (1992) 47-56, doi:10.1016/0022-314X(92)90023-Z; random:
//          A. B. Owen, "A randomized Halton algorithm in R", arXiv:1706.02808 (2017).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"

namespace stipple {

/// pi(0), ..., pi(base - 1).
std::vector<std::uint32_t> faure_permutation(std::uint32_t base);

/// Radical inverses under random permutations, one for each position of a digit.
class PermutedInverse {
  public:
    /// @param numbers of which the first 64 base are used
    PermutedInverse(std::uint32_t base, const Rng& numbers);

    [[nodiscard]] double of(std::uint64_t index) const;

    /// out[j * stride] = of(first + j) for j < count.
    void fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;

  private:
    [[nodiscard]] double behind(std::uint64_t high) const;

    std::uint64_t base_;
    std::uint64_t block_;                  ///< b^t, the number of values that the t low digits have
    double margin_;                        ///< kept from the ends of an interval of length 1
    std::vector<double> low_;              ///< images of the t low digits, as whole numbers
    std::vector<std::uint16_t> permuted_;  ///< of the positions behind them, one after the other
    std::vector<double> zeros_;            ///< fraction that all zeros from a position on give
};

}  // namespace stipple
