// SPDX-License-Identifier: MIT
//
// Distribution of D_n = sup |F_n(x) - x|, where F_n(x) is the fraction of n independent uniform
// numbers that are at most x.
//
//     n D^2 > 4:      P(D_n >= D) = 2 P(D_n+ >= D), the one-sided distribution: exact except for
//                     samples that reach both sides, at most a fraction of 4e-11
//     n D <= 200:     P(D_n <= D) by a power of a matrix, exact (so all D with n D^2 <= 4, for n up
//                     to 10^4)
//     otherwise:      P(D_n <= D) by an expansion in powers of n^(-1/2), to the third
//
// One-sided, exactly (n <= 10^6; above, its expansion's first terms):
//
//     P(D_n+ >= x) = x sum_{0 <= j <= n (1 - x)} C(n, j) (x + j/n)^(j-1) (1 - x - j/n)^(n-j)
//
// Cost    O((n D)^3 log n) for the power, half a second at most; O(n) for the sum; else negligible.
// Promise exact values have a relative error below 1e-9 in the lower tail, however small it is, and
//         in the upper tail if it is below 1e-3; otherwise the upper tail's absolute error is below
//         1e-9. The expansion is used only for n > 10^4, where its error is less than 1e-9.
//         One-sided above 10^6: relative error below 2e-4 for tails down to 1e-13.
// Source  G. Marsaglia, W. W. Tsang, J. Wang, Journal of Statistical Software 8(18) (2003),
//         doi:10.18637/jss.v008.i18 (matrix). Z. W. Birnbaum, F. H. Tingey, Annals of Mathematical
//         Statistics 22 (1951) 592-596, doi:10.1214/aoms/1177729550 (one-sided). W. Pelz,
//         I. J. Good, Journal of the Royal Statistical Society B 38 (1976) 152-156 (expansion).
//         R. Simard, P. L'Ecuyer, Journal of Statistical Software 39(11) (2011),
//         doi:10.18637/jss.v039.i11 (choice of the method).
#pragma once

#include <cstdint>

#include "analyzers/uniformity/pearson.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// P(D_n >= statistic) and P(D_n <= statistic).
Tails kolmogorov_tails(std::uint64_t n, double statistic, const RunContext& run);

/// P(D_n <= x) by the matrix; for n x up to a few hundred.
double kolmogorov_exact(std::uint64_t n, double x, const RunContext& run);

/// P(D_n <= x) by the expansion.
double kolmogorov_expansion(std::uint64_t n, double x);

/// P(D_n+ >= x).
double smirnov_upper(std::uint64_t n, double x);

}  // namespace stipple::analyzers
