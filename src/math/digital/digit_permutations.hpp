// SPDX-License-Identifier: MIT
//
// Permutations of the digits of radical inverses,
//
//     sum_j pi_j(a_j) b^(-j-1)    where    i = sum_j a_j b^j,  0 <= a_j < b.
//
// Faure: one permutation for all positions j, designed for a small discrepancy; pi(0) = 0. For b =
// 2 it is (0, 1). For even b it is (2 pi, 2 pi + 1) with the permutation pi of b / 2. For odd b it
// is the permutation of b - 1 with values from c = (b - 1) / 2 on increased by 1, and c inserted in
// the middle.
//
// Random: an independent permutation for each position, including those of the infinitely many
// leading zeros of i. The positions that are 0 for all indices below 2^53 give one uniform number.
//
// Shape    i in [0, 2^53), b in [2, 65536].
// Promise  random: within 2^-52 of the sum above, below 1, and in the interior of the interval
//          given by the t low digits, where b^t is at most max(b, 1024).
// Source   H. Faure, J. Number Theory 42 (1992) 47-56, doi:10.1016/0022-314X(92)90023-Z; random:
//          A. B. Owen, "A randomized Halton algorithm in R", arXiv:1706.02808 (2017).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"

namespace stipple {

/// Returns pi(0), ..., pi(base - 1).
std::vector<std::uint32_t> faure_permutation(std::uint32_t base);

/// Radical inverses with random digit permutations, one for each position.
class PermutedInverse {
  public:
    /// @param numbers random numbers, of which those with an index below 64 * base are used
    PermutedInverse(std::uint32_t base, const Rng& numbers);

    [[nodiscard]] double of(std::uint64_t index) const;

    /// Sets out[j * stride] = of(first + j) for j < count.
    void fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;

  private:
    [[nodiscard]] double behind(std::uint64_t high) const;

    std::uint64_t base_;
    std::uint64_t block_;                  ///< b^t, the number of values of the t low digits
    double margin_;                        ///< behind() is clamped to [margin_, 1 - margin_]
    std::vector<double> low_;              ///< images of the t low digits, as integers
    std::vector<std::uint16_t> permuted_;  ///< permutations of the higher positions, in order
    std::vector<double> zeros_;            ///< by position: image of all-zero digits from there on
};

}  // namespace stipple
