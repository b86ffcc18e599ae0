// SPDX-License-Identifier: MIT
//
// Combinations of k of the integers 0, ..., n - 1, c_1 < ... < c_k, numbered from 0 in order of
// their largest element, then the second largest: {0,1}, {0,2}, {1,2}, {0,3}... So the number of a
// combination does not depend on n.
//
//     number of a combination  =  C(c_1, 1) + C(c_2, 2) + ... + C(c_k, k)
//
// Source  D. E. Knuth, The Art of Computer Programming 4A (2011), section 7.2.1.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stipple {

/// The chosen elements in increasing order.
using Combination = std::vector<std::size_t>;

/// C(n, k), or the largest 64-bit number if C(n, k) exceeds it.
std::uint64_t binomial(std::uint64_t n, std::uint64_t k);

/// Returns the combination of `size` elements with this number.
Combination combination(std::uint64_t number, std::size_t size);

std::uint64_t combination_number(const Combination& combination);

/// Advances to the combination with the next number.
void next_combination(Combination& combination);

}  // namespace stipple
