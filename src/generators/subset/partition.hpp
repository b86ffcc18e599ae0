// SPDX-License-Identifier: MIT
//
// All points parted into sets of n that are even alike: the sum of their squared maximum mean
// discrepancies is made small. The points are dealt out at random; then the sets trade points in
// pairs, as in a tournament in which each meets each. Of two sets A and B, whichever point i of A
// is exchanged for j of B, the sum of K within the sets grows by
//
//     2 (K_ii + K_jj - 2 K_ij - D_i + D_j),    D_x = sum_(a in A) K(x, a) - sum_(b in B) K(x, b),
//
// so for each i in turn the best j is taken. The means of K need not be known, since all points
// stay.
//
// Cost    some 8 n^2 values of K a pair. Every round halves the squared discrepancies or so, until
//         they are those of n good points.
// Promise a function of the points, the number of sets, the seed and the number of values, for any
//         number of threads.
// Source  this program's own; of halving by kernels: R. Dwivedi, L. Mackey, "Kernel thinning", J.
//         Mach. Learn. Res. 25 (2024), arXiv:2105.05842.
#pragma once

#include "generators/subset/kernel_choice.hpp"

namespace stipple::generators::subset {

/// @param sets divides the number of points
/// @param values of the kernel that may be worked out, beyond the first few rounds
std::vector<Rows> part_by_kernel(const kernels::Kernel& kernel, const kernels::Columns& points,
                                 std::size_t sets, double values, std::uint64_t seed,
                                 const RunContext& run);

}  // namespace stipple::generators::subset
