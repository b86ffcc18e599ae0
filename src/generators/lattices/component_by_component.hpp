// SPDX-License-Identifier: MIT
//
// Worst-case error of rank-1 lattices, and the search for lattices with a small one.
//
// The lattice of n points with vector z integrates functions of the weighted Korobov space of
// smoothness 2 with a worst-case error whose square is
//
//     e^2(z) = -1 + 1/n sum_i prod_k (1 + weight_k omega(i z_k / n)),
//     omega(x) = 2 pi^2 (x^2 - x + 1/6) = 2 pi^2 B_2(x)    for x in [0, 1).
//
// Shape    n in [1, 2^24].
// Beware   weights above 6 / pi^2 make factors negative. With many negative factors, some products
//          become the more negative the worse the points are spread; then a repeated component
//          would give the least e^2.
// Units    with all weights 1, e^2 is the figure of merit P_2 of the lattice.
// Source   I. H. Sloan, S. Joe, Lattice Methods for Multiple Integration, Oxford 1994 (P_alpha).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

inline constexpr std::uint64_t largest_searched_lattice = std::uint64_t{1} << 24;

/// e^2 of the lattice, with a relative error of about 10^-14; infinite if its products overflow.
double squared_lattice_error(std::uint64_t n, std::span<const std::uint64_t> vector,
                             std::span<const double> weights);

/// Vector that begins with 1 and grows by the component with the least e^2, the smallest among
/// equals. Candidates are prime to n, at most n / 2, and among those used least often so far. There
/// is one component per weight.
std::vector<std::uint64_t> component_by_component(std::uint64_t n, std::span<const double> weights,
                                                  const RunContext& run);

/// Multiplier a, prime to n and at most n / 2, of the Korobov lattice z_k = a^k with the least e^2.
/// Tries all multipliers or, if there are more than `tries`, only `tries` spread over the range.
std::uint64_t korobov_multiplier(std::uint64_t n, std::span<const double> weights,
                                 std::uint64_t tries, const RunContext& run);

/// Number of candidates for a multiplier, 1 to n / 2; those prime to n are tried.
constexpr std::uint64_t korobov_range(std::uint64_t n) { return n < 4 ? 1 : n / 2; }

/// (1, a, a^2, ...) modulo n.
std::vector<std::uint64_t> powers_modulo(std::uint64_t a, std::size_t count, std::uint64_t n);

}  // namespace stipple
