// SPDX-License-Identifier: MIT
//
// Worst-case error of polynomial lattices in base 2, and the search for lattices with a small one.
//
// For n = 2^m points with a random digital shift, the worst-case error of integration in the
// weighted, unanchored Sobolev space of square-integrable mixed first derivatives has the mean
// square
//
//     e^2 = -1 + 1/n sum_i prod_k (1 + weight_k omega(x_ik)),
//     omega(x) = 1/6 - 2^(floor(log2 x) - 1),    omega(0) = 1/6.
//
// Up to the factor 12, omega is also that of the Walsh space of smoothness 2.
//
// Units    polynomials are whole numbers, as in math/digital/gf2.hpp.
// Source   J. Dick, F. Pillichshammer, Digital Nets and Sequences, Cambridge 2010, chapters 10, 12,
//          doi:10.1017/CBO9780511761188.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// Largest degree of the modulus for which vectors are searched.
inline constexpr int largest_searched_degree = 22;

/// omega(x) of the formula above.
double digital_shift_kernel(double x);

/// e^2 of the polynomial lattice with all 2^deg(modulus) points, for the given weights, with a
/// relative error of about 10^-14; infinite if its products overflow.
double squared_polynomial_error(std::uint64_t modulus, std::span<const std::uint64_t> vector,
                                std::span<const double> weights);

/// Vector that begins with 1 and grows by the component with the least e^2; among components that
/// are equal up to rounding, the smallest as an integer. There is one component per weight. The
/// modulus must be irreducible, of degree 1 to largest_searched_degree.
std::vector<std::uint64_t> polynomial_components(std::uint64_t modulus,
                                                 std::span<const double> weights,
                                                 const RunContext& run);

}  // namespace stipple
