// SPDX-License-Identifier: MIT
//
// Sobol' indices of a sparse polynomial chaos expansion fitted to any sample. The output is
// approximated by
//
//     f(u) = c_0 + sum_a c_a P_a(u),    P_a(u) = prod_i sqrt(2 a_i + 1) L_(a_i)(2 u_i - 1),
//
// with Legendre polynomials L and inputs u_i uniform on [0, 1], so that with V = sum c_a^2
//
//     S_i = sum over a of i alone,    ST_i = sum over a with a_i > 0,    S_ij = over a of i and j
//
// of c_a^2 / V. Terms of total degree up to p enter one by one: orthogonal matching pursuit takes
// the one that correlates most with what is left, and least squares fit all that are in. Their
// number, and p, are those of the least leave-one-out error e_i / (1 - h_i), its mean square
// corrected for the number of terms by the factor n / (n - t) (1 + trace of the inverse of the
// Gram matrix); Q2 = 1 - that / Var f. Intervals are the jackknife's, the terms being fixed.
//
// Shape   eight runs or more; independent inputs. Those of a cube or box are scaled, others ranked.
// Cost    for P candidates and t terms O(n P t) time, n (P + t) numbers of memory. P is at most
//         2000 and 1e7 / n, t at most n / 2 and 300. 1 s for n = 1024, k = 4, degree 12 and 245
//         terms on one core.
// Beware  the indices are those of the polynomial: they are off by about 1 - Q2.
// Source  G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011) 2345-2367,
//         doi:10.1016/j.jcp.2010.12.021 (sparse by leave-one-out error, there with least angles);
//         B. Sudret, Reliab. Eng. Syst. Saf. 93 (2008) 964-979, doi:10.1016/j.ress.2007.04.002.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Failed runs are left out. Nothing where no term is better than the mean.
/// @throws Error(input) where too few remain
std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
