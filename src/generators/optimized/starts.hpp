// SPDX-License-Identifier: MIT
//
// Initial sets for the search over coordinates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/combinatorics/splitmix64.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

/// Rows (i phi) in one dimension or (i / n, i phi) in two, phi the golden ratio, modulo 1; shifted
/// at random.
std::vector<double> golden_rows(std::size_t count, std::size_t dimension, SplitMix64& draws);

/// Rows of a lattice of rank 1: i times a vector over n, plus a shift, modulo 1.
std::vector<double> rank1_rows(std::size_t count, std::span<const std::size_t> vector,
                               std::span<const double> shift);

/// Rows of a randomly shifted lattice of rank 1: of several random vectors, the one with the least
/// wraparound L2 discrepancy.
std::vector<double> lattice_rows(std::size_t count, std::size_t dimension, SplitMix64& draws,
                                 const RunContext& run);

/// Rows of i / n, shifted at random, followed by the first points of Sobol's sequence with Owen
/// scrambling; a net if the count is a power of two. Two or more coordinates.
std::vector<double> net_rows(std::size_t count, std::size_t dimension, SplitMix64& draws);

}  // namespace stipple::optimized
