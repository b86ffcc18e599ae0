// SPDX-License-Identifier: MIT
//
// Orthogonal matching pursuit: terms enter a least squares fit one by one, each time that which
// correlates most with what is left. It ends with the least
//
//     (mean square of e_i / (1 - h_i)) n / (n - t) (1 + trace of the inverse of the Gram matrix) P^(2t/n)
//
// of t terms picked among P, in which e_i / (1 - h_i) are the leave-one-out errors. The last factor is
// what picking the best of P candidates is worth to pure noise.
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

inline constexpr std::size_t most_terms = 300;  ///< of a fit

/// Candidates: the columns of a table, row after row; the fit is one of some of the rows.
struct Candidates {
    std::span<const double> values;
    std::size_t columns;
    std::span<const std::size_t> rows;
};

struct SparseFit {
    double error = 0;  ///< what is least, over the mean square of z
    double constant = 0;
    std::vector<std::size_t> chosen = {};  ///< columns, in the order in which they came
    std::vector<double> coefficients = {};
};

/// The fit to z, a number for each row of the table, of a constant and columns; without columns where
/// none is worth it.
SparseFit sparse_fit(const Candidates& candidates, std::span<const double> z,
                     const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
