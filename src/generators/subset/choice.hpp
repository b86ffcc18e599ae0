// SPDX-License-Identifier: MIT
//
// Functions that choose n of N points, or split all N, each described in its source file. Results
// depend only on the points and the other arguments, not on the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/point_set.hpp"
#include "math/kernels/kernel.hpp"
#include "stipple/run.hpp"

namespace stipple::generators::subset {

/// Row indices of points. Functions return them in ascending order.
using Rows = std::vector<std::size_t>;

// kernel_choice.cpp

/// Rows of n chosen points. @param values budget of kernel evaluations after the greedy choice
Rows choose_by_kernel(const kernels::Kernel& kernel, const kernels::Columns& points, std::size_t n,
                      double values, std::uint64_t seed, const RunContext& run);

/// Bytes that choose_by_kernel() needs besides the columns.
double choice_memory(double points);

/// Kernel columns of the points at the given rows.
kernels::Columns columns_of(const kernels::Columns& points, const Rows& rows,
                            const RunContext& run);

// partition.cpp

/// @param sets must divide the number of points
/// @param values budget of kernel evaluations, exceeded if the first few rounds need more
std::vector<Rows> part_by_kernel(const kernels::Kernel& kernel, const kernels::Columns& points,
                                 std::size_t sets, double values, std::uint64_t seed,
                                 const RunContext& run);

// star_choice.cpp

/// Bounds of a star discrepancy, equal if its value is known.
struct StarBounds {
    double lower = 0;
    double upper = 1;
};

/// Star discrepancy of the points at these rows, exact unless computing it takes minutes.
StarBounds star_discrepancy(const PointSet& points, const Rows& rows, const RunContext& run);

/// @param start initial rows
/// @param measures number of sets whose star discrepancy may be computed
Rows choose_by_star(const PointSet& points, Rows start, std::uint64_t measures, std::uint64_t seed,
                    const RunContext& run);

/// Reduces the largest star discrepancy of `sets`, a partition of the points, by exchanges.
void even_out_by_star(const PointSet& points, std::vector<Rows>& sets, std::uint64_t measures,
                      std::uint64_t seed, const RunContext& run);

/// Bytes that choose_by_star() needs.
double star_memory(double points);

}  // namespace stipple::generators::subset
