// SPDX-License-Identifier: MIT
//
// Three ways to compute a squared L2 discrepancy, described in their sources: integers on a line or
// in the plane, divide and conquer in three or four dimensions, and sums over all pairs.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>

#include "core/machine/vectors.hpp"
#include "core/point_set.hpp"
#include "math/l2/kinds.hpp"
#include "stipple/run.hpp"

namespace stipple::l2 {

/// Squared discrepancy by all pairs; not finite if it exceeds the largest double.
Square pair_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                   const RunContext& run, Vectors widest = Vectors::eights);

/// Bytes that pair_square() needs.
double pair_memory(std::size_t count, std::size_t dimension);

/// Sums over the points of a set (see planar.cpp); phi_p of degree k is multiplied by 2^(63 k).
struct PlaneSums {
    using Integer = boost::multiprecision::cpp_int;
    using Symmetric = std::array<Integer, 5>;  ///< V_pq: 00, 01, 02, 03, 11

    std::size_t count = 0;
    std::array<std::array<Integer, 4>, 4> moments;  ///< M_pq, p on the first axis, q on the second
    std::array<Symmetric, 2> along;                 ///< V along one axis, with phi of the other
    Integer planar;                                 ///< T
};

/// Sums over points with one or two coordinates in [0, 1]; a missing second coordinate is 0.
PlaneSums plane_sums(const PointSet& points, const RunContext& run);

/// Squared discrepancy; the term of each projection is rounded to one of the two nearest doubles.
double plane_square(const PlaneSums& sums, std::size_t dimension, Kind kind,
                    const AxisWeights& weights);

/// True if divide_square() accepts points of this dimension with this kernel.
bool divides(std::size_t dimension, Kind kind, const AxisWeights& weights);

/// True if divide_square() is faster than pair_square().
bool divide_wins(std::size_t count, std::size_t dimension, Kind kind, const AxisWeights& weights);

/// Bytes that divide_square() needs.
double divide_memory(std::size_t count, std::size_t dimension, Kind kind,
                     const AxisWeights& weights);

/// Squared discrepancy by divide and conquer. Requires divides(), and not more points than the
/// largest count for which divide_wins() is true.
Square divide_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                     const RunContext& run);

}  // namespace stipple::l2
