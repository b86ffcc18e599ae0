// SPDX-License-Identifier: MIT
//
// Three ways to the square of an L2 discrepancy, each described in its source: whole numbers on a
// line or in the plane, divide and conquer in three or four dimensions, and sums over all pairs.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>

#include "core/machine/vectors.hpp"
#include "core/point_set.hpp"
#include "math/l2/kinds.hpp"
#include "stipple/run.hpp"

namespace stipple::l2 {

/// The squared discrepancy; not finite where it is beyond the largest double.
Square pair_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                   const RunContext& run, Vectors widest = Vectors::eights);

/// Bytes that it needs.
double pair_memory(std::size_t count, std::size_t dimension);

/// Sums over the points of a set; phi_p is scaled by 2^63 to the power of its degree.
struct PlaneSums {
    using Integer = boost::multiprecision::cpp_int;
    using Symmetric = std::array<Integer, 5>;  ///< V of (0,0), (0,1), (0,2), (0,3), (1,1)

    std::size_t count = 0;
    std::array<std::array<Integer, 4>, 4> moments;  ///< of the first axis and the second
    std::array<Symmetric, 2> along;                 ///< each axis, with phi of the other
    Integer planar;                                 ///< T
};

/// Of points with one or two coordinates in [0, 1]; a second coordinate that is missing is 0.
PlaneSums plane_sums(const PointSet& points, const RunContext& run);

/// The squared discrepancy: of each projection the double nearest to the exact value, or one of its
/// neighbors.
double plane_square(const PlaneSums& sums, std::size_t dimension, Kind kind,
                    const AxisWeights& weights);

/// Whether divide_square() takes such points.
bool divides(std::size_t dimension, Kind kind, const AxisWeights& weights);

/// Whether it is faster than all pairs are.
bool divide_wins(std::size_t count, std::size_t dimension, Kind kind);

/// Bytes that it needs.
double divide_memory(std::size_t count, std::size_t dimension, Kind kind);

/// The squared discrepancy of points that divides() and divide_wins() let pass, or fewer.
Square divide_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                     const RunContext& run);

}  // namespace stipple::l2
