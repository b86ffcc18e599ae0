// SPDX-License-Identifier: MIT
//
// Orthogonal matching pursuit: adds terms to a least squares fit one by one, each time the term
// that correlates most with the residual. It keeps the number of terms t that minimizes
//
//     (mean square of e_i / (1 - h_i)) n / (n - t - 1) (1 + trace of inverse Gram matrix) P^(2t/n)
//
// for terms chosen from P candidates, where e_i / (1 - h_i) are the leave-one-out errors. The last
// factor compensates for choosing the best of P candidates, which reduces the error even for pure
// noise.
//
// Source  Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, Asilomar Conf. 27 (1993) 40-44,
//         doi:10.1109/ACSSC.1993.342465; O. Chapelle, V. Vapnik, Y. Bengio, Mach. Learn. 48 (2002)
//         9-23, doi:10.1023/A:1013943418833 (trace); D. P. Foster, E. I. George, Ann. Statist. 22
//         (1994) 1947-1975, doi:10.1214/aos/1176325766 (2 log P for a term).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple::analyzers::sensitivity {

inline constexpr std::size_t most_terms = 300;  ///< largest number of terms in a fit

/// Candidate terms: the columns of a table, stored row by row. The fit uses only the given rows.
struct Candidates {
    std::span<const double> values;
    std::size_t columns;
    std::span<const std::size_t> rows;
};

struct SparseFit {
    double error = 0;  ///< value of the criterion, relative to the mean square of z
    double constant = 0;
    std::vector<std::size_t> chosen = {};  ///< columns, in the order of their choice
    std::vector<double> coefficients = {};
};

/// Fits z, which has one number per row of the table, by a constant and columns. Uses only the
/// constant if no column improves the criterion.
SparseFit sparse_fit(const Candidates& candidates, std::span<const double> z,
                     const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
