// SPDX-License-Identifier: MIT
//
// The n of N points whose squared maximum mean discrepancy is small for a kernel K with mean m:
//
//     n^2 (squared - total)  =  sum_(i, k chosen) K(x_i, x_k)  -  2 n sum_(i chosen) m(x_i).
//
// With the potentials P_j = sum_(i chosen) K(x_i, x_j) of all N points, the one to choose next as
// number c is where P_j + K_jj / 2 - c m_j is least (kernel herding). Then one chosen point after
// the other is taken away and the best of all in its place chosen, until no exchange helps; then
// some are exchanged at random, and it goes on, from the best so far.
//
// Cost    N values of K a choice, 2 N an exchange; 32 N bytes and the columns of the points, and 16
//         N for the best so far.
// Promise a function of the points, n, the seed and the number of steps, for any number of threads.
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

/// @param values of the kernel that may be worked out after the greedy choice
Rows choose_by_kernel(const kernels::Kernel& kernel, const kernels::Columns& points, std::size_t n,
                      double values, std::uint64_t seed, const RunContext& run);

/// Bytes that it needs beside the columns.
double choice_memory(double points);

/// The columns of some points.
kernels::Columns columns_of(const kernels::Columns& points, const Rows& rows,
                            const RunContext& run);

}  // namespace stipple::generators::subset
