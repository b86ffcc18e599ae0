// SPDX-License-Identifier: MIT
//
// Products of polynomials of single inputs. The polynomials are orthonormal for the distribution of
// their input: a uniform one, or that of its values in the sample. In the latter case the mean over
// the runs of P_a(x_i) P_b(x_i) is 1 for a = b, otherwise 0. An input with m values then has
// polynomials of degree 0 to m - 1, which represent functions of discrete inputs exactly.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "stipple/run.hpp"

namespace stipple::analyzers::sensitivity {

/// Polynomials of one input, evaluated in all runs: run after run, by ascending degree.
struct Polynomials {
    std::size_t count = 1;  ///< number of polynomials: largest degree + 1
    std::vector<double> values = {};
};

/// Values of sqrt(2 m + 1) L_m(2 u - 1), with Legendre's L_m, for m from 0 to max_degree.
Polynomials legendre_polynomials(std::span<const double> u, std::size_t max_degree);

/// Orthonormal polynomials for the distribution of the values x; their degrees are at most
/// max_degree and below the number of distinct values.
Polynomials sample_polynomials(std::span<const double> x, std::size_t max_degree);

/// A product of polynomials of different inputs: pairs of an input, ascending, and its degree,
/// which is at least 1.
using BasisTerm = std::vector<std::pair<std::size_t, std::size_t>>;

/// Number of terms of k inputs with total degree 1 to p, if every input has enough values.
double term_count(std::size_t k, std::size_t p);

/// All products of the inputs' polynomials with total degrees from 1 to p, by ascending degree.
std::vector<BasisTerm> basis_terms(std::span<const Polynomials> inputs, std::size_t p);

/// Values of the terms in n runs; one row per run, one column per term.
std::vector<double> basis_values(std::span<const Polynomials> inputs, std::size_t n,
                                 std::span<const BasisTerm> terms, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
