// SPDX-License-Identifier: MIT
//
// Partitions all points into sets of n that are similarly even: the sum of their squared maximum
// mean discrepancies is made small. The points are dealt out at random; then the sets trade points
// in pairs, as in a tournament in which each meets each. If two sets A and B exchange a point i of
// A for a point j of B, the sum of K within the sets grows by
//
//     2 (K_ii + K_jj - 2 K_ij - D_i + D_j),    D_x = sum_(a in A) K(x, a) - sum_(b in B) K(x, b),
//
// so for each i in turn the best j is taken. The means of K are not needed, since all points stay.
//
// Cost    some 8 n^2 values of K per pair. Every round roughly halves the squared discrepancies,
//         until they are those of n good points.
// Promise depends only on the points, the number of sets, the seed and the number of values, not on
//         the number of threads.
// Source  this program's own; for halving by kernels see R. Dwivedi, L. Mackey, "Kernel thinning",
//         J. Mach. Learn. Res. 25 (2024), arXiv:2105.05842.
#pragma once

#include "generators/subset/kernel_choice.hpp"

namespace stipple::generators::subset {

/// @param sets must divide the number of points
/// @param values budget of kernel evaluations beyond the first few rounds
std::vector<Rows> part_by_kernel(const kernels::Kernel& kernel, const kernels::Columns& points,
                                 std::size_t sets, double values, std::uint64_t seed,
                                 const RunContext& run);

}  // namespace stipple::generators::subset
