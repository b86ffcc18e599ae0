// SPDX-License-Identifier: MIT
//
// Orthogonal matching pursuit with the leave-one-out error as its end: see polynomial_chaos.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple::analyzers::sensitivity {

inline constexpr std::size_t most_terms = 300;  ///< of a fit

/// Candidates: the columns of a table, row after row.
struct Candidates {
    std::span<const double> values;
    std::size_t columns;

    [[nodiscard]] std::size_t rows() const { return values.size() / columns; }
};

/// A least squares fit of t columns and a constant, by an orthonormal basis q of them.
struct SparseFit {
    std::vector<std::size_t> chosen = {};        ///< columns, in the order in which they came
    std::vector<std::vector<double>> q = {};     ///< t + 1, that of the constant first
    std::vector<std::vector<double>> back = {};  ///< columns of the inverse of R, upper triangular
    std::vector<double> along = {};              ///< q . z
    double error = 1;  ///< mean square leave-one-out error, corrected, over the mean square of z

    /// The coefficients of the chosen columns.
    [[nodiscard]] std::vector<double> coefficients() const;

    /// What z has left.
    [[nodiscard]] std::vector<double> residual(std::span<const double> z) const;
};

/// The fit to z, whose mean is 0, with the least error; without columns where none is better.
SparseFit sparse_fit(const Candidates& candidates, std::span<const double> z,
                     const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
