// SPDX-License-Identifier: MIT
//
// Products of Legendre polynomials of inputs in [0, 1], orthonormal for uniform ones.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "stipple/run.hpp"

namespace stipple::analyzers::sensitivity {

/// A product: inputs, rising, each with its degree above 0.
using BasisTerm = std::vector<std::pair<std::size_t, std::size_t>>;

/// Terms of k inputs of total degree 1 to p.
double term_count(std::size_t k, std::size_t p);

/// All of them, by their degree.
std::vector<BasisTerm> basis_terms(std::size_t k, std::size_t p);

/// Their values for rows u of k numbers: row after row, a column a term.
std::vector<double> basis_values(std::span<const double> u, std::size_t k,
                                 std::span<const BasisTerm> terms, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
