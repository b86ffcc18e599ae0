// SPDX-License-Identifier: MIT
//
// L2 discrepancies of points on a line or in the plane, without rounding, in O(n log n).
//
// On each axis all kernels are of the form
//
//     k(x, y) = sum_pq s_pq phi_p(x) phi_q(y)  +  sigma |x - y|,
//     phi = 1, x, x^2, |x - 1/2|,
//
// so that the double sum over pairs of points splits into products of
//
//     moments            M_pq = sum_i phi_p(x_i) phi_q(y_i),
//     sums along an axis V_pq = sum_ik phi_p(y_i) phi_q(y_k) |x_i - x_k|,  from running sums of the
//                        points in order of x, and the same with x and y exchanged,
//     one planar sum     T    = sum_ik |x_i - x_k| |y_i - y_k|
//                             = 4 sum_i x_i h_i - 2 sum_ik x_k |y_i - y_k|,
//                        h_i  = sum |y_i - y_k| over the points before i in order of x.
//
// T is the only sum that needs both orders at once; it is the same for every kernel, and merge sort
// of y finds it on its way: when a point from the right half goes out, the points of the left half
// that went before it are its lower left neighbors. Ties need no care, their terms are 0.
//
// Coordinates are whole multiples of 2^-63 (smaller parts are rounded away), sums are whole numbers
// of as many bits as it takes, and only their quotient at the end is rounded.
//
// Cost    O(n log n) time, 48 bytes a point.
// Promise the same for any number of threads, bit by bit; exact where coordinates are multiples of
//         2^-63, as all doubles from 2^-11 on are.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>

#include "analyzers/l2/kinds.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers::l2 {

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

}  // namespace stipple::analyzers::l2
