// SPDX-License-Identifier: MIT
//
// Products of polynomials of single inputs, orthonormal for the distribution of each: a uniform one, or
// that of its values in the sample, where the mean over the runs of P_a(x_i) P_b(x_i) is 1 for a = b, else
// 0. An input with m values has polynomials of degree 0 to m - 1 there, and discrete inputs are met exactly.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "stipple/run.hpp"

namespace stipple::analyzers::sensitivity {

/// Values of the polynomials of one input, run after run, by rising degree.
struct Polynomials {
    std::size_t count = 1;  ///< one more than the largest degree
    std::vector<double> values = {};
};

/// sqrt(2 m + 1) L_m(2 u - 1), with Legendre's L_m, for m from 0 to max_degree.
Polynomials legendre_polynomials(std::span<const double> u, std::size_t max_degree);

/// Those of degree up to max_degree and below the number of different values, for the distribution of these.
Polynomials sample_polynomials(std::span<const double> x, std::size_t max_degree);

/// A product: inputs, rising, each with its degree above 0.
using BasisTerm = std::vector<std::pair<std::size_t, std::size_t>>;

/// Terms of k inputs of total degree 1 to p, where no input has few values.
double term_count(std::size_t k, std::size_t p);

/// All of them that the inputs' polynomials make, by their degree.
std::vector<BasisTerm> basis_terms(std::span<const Polynomials> inputs, std::size_t p);

/// Their values in n runs: run after run, a column a term.
std::vector<double> basis_values(std::span<const Polynomials> inputs, std::size_t n,
                                 std::span<const BasisTerm> terms, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
