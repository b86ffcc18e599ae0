// SPDX-License-Identifier: MIT
//
// Choices of k of n things, c_1 < ... < c_k, numbered from 0 by their largest, then the next one:
// {0,1}, {0,2}, {1,2}, {0,3}...; so the numbers do not depend on n.
//
//     number of a choice  =  C(c_1, 1) + C(c_2, 2) + ... + C(c_k, k)
//
// Source  D. E. Knuth, The Art of Computer Programming 4A (2011), section 7.2.1.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stipple {

/// Rising.
using Combination = std::vector<std::size_t>;

/// C(n, k), or the largest 64-bit number when it does not fit.
std::uint64_t binomial(std::uint64_t n, std::uint64_t k);

/// The choice of `size` things with that number.
Combination combination(std::uint64_t number, std::size_t size);

std::uint64_t combination_number(const Combination& combination);

/// Goes on to the choice with the next number.
void next_combination(Combination& combination);

}  // namespace stipple
