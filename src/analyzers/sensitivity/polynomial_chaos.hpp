// SPDX-License-Identifier: MIT
//
// Sobol' indices of a sparse polynomial chaos expansion, fitted to any sample and validated by runs
// it has not seen. The output is approximated by p(x) = c_0 + sum_a c_a P_a(x), with products P_a
// of polynomials that are orthonormal for each input's own distribution in the sample
// (orthonormal_basis.hpp). So p splits into orthogonal parts p_u of groups u of terms: those of
// input i alone (first), all with input i (total), those of inputs i and j (second).
//
// Five times, a polynomial is fitted to four fifths of the runs: degree, terms and coefficients are
// chosen from these alone (matching_pursuit.hpp). Let r = f - p be its errors in the other fifth.
// With means over all runs, each by the polynomial that has not seen it,
//
//     V   = mean of sum_a c_a^2 + 2 (p - c_0) r + r^2,    Q2 = 1 - mean r^2 / Var f,
//     S_u = (mean of |p_u|^2 + 2 p_u r) / V,  |p_u|^2 the sum of the c_a^2 of u.
//
// S_u is (||f_u||^2 - ||f_u - p_u||^2) / V up to chance: the part of the index that p_u explains,
// and no more, because terms fitted to noise explain nothing of other runs. The unexplained part 1
// - Q2 may belong to u or not. So the interval is from S_u minus its error to S_u + 1 - Q2 plus its
// error. The errors are Student's quantile times the standard error of the ratio of the two means.
//
// If the inputs' distributions are unknown, the runs are a sample of these, too. The standard error
// then takes p_u (2 p_v - p_u) instead of |p_u|^2, where v are all terms that contain the inputs of
// u, and (f - mean f)^2 instead of V's terms: these are what changes with the frequencies of an
// input's values.
//
// Shape   eight runs or more, twenty for intervals; independent inputs. Inputs that are known to be
//         uniform, or in [0, 1] with the mean and variance of uniform ones, have Legendre
//         polynomials. Others have those of their values or of the ranks of these, whichever fit
//         better.
// Cost    for P candidates and t terms O(n P t) time for each degree, n (P + t) numbers of memory.
//         P is at most 600 and 1e7 / n, t at most 0.4 n and 300.
// Beware  indices are fractions of the whole variance, including noise that no input explains.
// Source  G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011) 2345-2367,
//         doi:10.1016/j.jcp.2010.12.021 (sparse polynomials); B. Sudret, Reliab. Eng. Syst. Saf. 93
//         (2008) 964-979, doi:10.1016/j.ress.2007.04.002 (indices); M. Stone, J. R. Stat. Soc. B 36
//         (1974) 111-147 (choice inside of cross-validation).
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Leaves out failed runs. Returns nullopt if no term improves on the mean.
/// @throws Error(input) if too few runs remain
std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
