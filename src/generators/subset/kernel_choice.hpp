// SPDX-License-Identifier: MIT
//
// Chooses n of N points with a small squared maximum mean discrepancy for a kernel K with mean m:
//
//     n^2 (squared - total)  =  sum_(i, k chosen) K(x_i, x_k)  -  2 n sum_(i chosen) m(x_i).
//
// Let P_j = sum_(i chosen) K(x_i, x_j) be the potential of each of the N points. Kernel herding
// chooses as number c the point with the least P_j + K_jj / 2 - c m_j. Then each chosen point in
// turn is replaced by the best of all points, until no exchange helps. After that, some points are
// exchanged at random and the search continues from the best choice so far.
//
// Cost    N values of K per choice, 2 N per exchange; 32 N bytes, the columns of the points, and
//         another 16 N bytes for the best choice so far.
// Promise depends only on the points, n, the seed and the number of steps, not on the number of
//         threads.
// Source  Y. Chen, M. Welling, A. Smola, "Super-samples from kernel herding", UAI 2010,
//         arXiv:1203.3472; for the Stein kernel: M. Riabiz et al., "Optimal thinning of MCMC
//         output", J. R. Stat. Soc. B 84 (2022) 1059-1081, arXiv:2005.03952. Exchanges: this
//         program's own.
#pragma once

#include <cstdint>
#include <vector>

#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::generators::subset {

/// Rows of points, ascending.
using Rows = std::vector<std::size_t>;

/// @param values budget of kernel evaluations after the greedy choice
Rows choose_by_kernel(const kernels::Kernel& kernel, const kernels::Columns& points, std::size_t n,
                      double values, std::uint64_t seed, const RunContext& run);

/// Bytes that choose_by_kernel() needs besides the columns.
double choice_memory(double points);

/// Columns of the given rows.
kernels::Columns columns_of(const kernels::Columns& points, const Rows& rows,
                            const RunContext& run);

}  // namespace stipple::generators::subset
