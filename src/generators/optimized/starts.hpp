// SPDX-License-Identifier: MIT
//
// Sets that a search over coordinates starts from.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/combinatorics/splitmix64.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

/// Rows of multiples of the golden ratio in one dimension or two, there behind i / n; shifted at
/// random.
std::vector<double> golden_rows(std::size_t count, std::size_t dimension, SplitMix64& draws);

/// Rows of a lattice of rank 1: i times a vector over n, and a shift, modulo 1.
std::vector<double> rank1_rows(std::size_t count, std::span<const std::size_t> vector,
                               std::span<const double> shift);

/// Rows of a lattice of rank 1, shifted at random: of some vectors that are drawn, the one with the
/// least wraparound L2 discrepancy.
std::vector<double> lattice_rows(std::size_t count, std::size_t dimension, SplitMix64& draws,
                                 const RunContext& run);

/// Rows of i / n, shifted at random, before the first points of Sobol's sequence, scrambled as Owen
/// does: of powers of two a net. Two or more coordinates.
std::vector<double> net_rows(std::size_t count, std::size_t dimension, SplitMix64& draws);

}  // namespace stipple::optimized
