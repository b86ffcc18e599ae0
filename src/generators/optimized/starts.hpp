// SPDX-License-Identifier: MIT
//
// Sets that a search over coordinates starts from.
#pragma once

#include <cstddef>
#include <vector>

#include "math/combinatorics/splitmix64.hpp"

namespace stipple::optimized {

/// Rows of a Kronecker set: multiples of the powers of 1 / g, shifted at random, where
/// g^(m+1) = g + 1 for m coordinates; the first coordinate is i / n, shifted, and not counted in m,
/// if `stepped`.
/// Source  the generalized golden ratios of M. Roberts (2018).
std::vector<double> kronecker_rows(std::size_t count, std::size_t dimension, bool stepped,
                                   SplitMix64& draws);

}  // namespace stipple::optimized
