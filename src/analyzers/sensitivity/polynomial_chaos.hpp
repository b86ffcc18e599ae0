// SPDX-License-Identifier: MIT
//
// Sobol' indices of a sparse polynomial chaos expansion, fitted to any sample and judged by runs it has
// not seen. The output is approximated by p(x) = c_0 + sum_a c_a P_a(x), with products P_a of polynomials
// that are orthonormal for each input's own distribution in the sample (orthonormal_basis.hpp), so that
// p splits into orthogonal parts p_u of groups u of terms: those of input i alone (first), all with
// input i (total), those of inputs i and j (second).
//
// Five times, a polynomial is fitted to four fifths of the runs: degree, terms and coefficients are
// chosen from these alone (matching_pursuit.hpp). With its errors r = f - p in the other fifth, the mean
// over all runs being of those where each was not seen,
//
//     V   = mean of sum_a c_a^2 + 2 (p - c_0) r + r^2,    Q2 = 1 - mean r^2 / Var f,
//     S_u = (mean of |p_u|^2 + 2 p_u r) / V,  |p_u|^2 the sum of the c_a^2 of u.
//
// That is ||f_u||^2 - ||f_u - p_u||^2 over V but for chance: what p_u explains of the index and, as terms
// that were fitted to noise explain nothing of other runs, no more. What p does not explain, 1 - Q2, may
// belong to u or not. So the interval ends at S_u less its error, and at S_u + 1 - Q2 plus its error; the
// errors are Student's quantile times the standard error of the ratio of the two means. Where the inputs'
// distributions are not known, the runs stand for these, too: in the standard error p_u (2 p_v - p_u) takes
// the place of |p_u|^2, with v all terms that have the inputs of u, and (f - mean f)^2 that of V's terms,
// which is what moves when the frequencies of an input's values do.
//
// Shape   eight runs or more, twenty for intervals; independent inputs. Those known to be uniform, or in
//         [0, 1] with mean and variance as of uniform ones, have Legendre polynomials, others those of
//         their values or of the ranks of these, as fits better.
// Cost    for P candidates and t terms O(n P t) time for each degree, n (P + t) numbers of memory. P is
//         at most 600 and 1e7 / n, t at most 0.4 n and 300.
// Beware  indices are shares of the whole variance: of noise in the output, too, which no input explains.
// Source  G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011) 2345-2367,
//         doi:10.1016/j.jcp.2010.12.021 (sparse polynomials); B. Sudret, Reliab. Eng. Syst. Saf. 93
//         (2008) 964-979, doi:10.1016/j.ress.2007.04.002 (indices); M. Stone, J. R. Stat. Soc. B 36 (1974)
//         111-147 (choice inside of cross-validation).
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Failed runs are left out. Nothing where no term is better than the mean.
/// @throws Error(input) where too few remain
std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
