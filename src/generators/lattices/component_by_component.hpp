// SPDX-License-Identifier: MIT
//
// How good a rank-1 lattice is, and the search for good ones.
//
// The lattice of n points with vector z integrates functions of the weighted Korobov space of
// smoothness 2 with a worst-case error whose square is
//
//     e^2(z) = -1 + 1/n sum_i prod_k (1 + weight_k omega(i z_k / n)),
//     omega(x) = 2 pi^2 (x^2 - x + 1/6) = 2 pi^2 B_2(x)    for x in [0, 1).
//
// Shape    n in [1, 2^24].
// Beware   weights above 6 / pi^2 make factors negative. With many of those the products of some
//          points become the more negative the worse they are spread, and the least e^2 would be
//          found by repeating a component, as it would with weights that have become very small.
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

/// e^2 of the lattice; more than any double for a lattice so bad that its products overflow.
double squared_lattice_error(std::uint64_t n, std::span<const std::uint64_t> vector,
                             std::span<const double> weights);

/// The vector that grows from z_1 = 1 by the component, prime to n and at most n / 2, with the
/// least e^2 of those that are in it least often; the smallest of those that are equally good. One
/// component a weight.
std::vector<std::uint64_t> component_by_component(std::uint64_t n, std::span<const double> weights,
                                                  const RunContext& run);

/// The multiplier a, prime to n and at most n / 2, of the Korobov lattice z_k = a^k with the least
/// e^2, among all or, where there are more than `tries`, that many spread over the range.
std::uint64_t korobov_multiplier(std::uint64_t n, std::span<const double> weights,
                                 std::uint64_t tries, const RunContext& run);

/// Multipliers up to n / 2, of which those are tried that are prime to n.
constexpr std::uint64_t korobov_range(std::uint64_t n) { return n < 4 ? 1 : n / 2; }

/// (1, a, a^2, ...) modulo n.
std::vector<std::uint64_t> powers_modulo(std::uint64_t a, std::size_t count, std::uint64_t n);

}  // namespace stipple
