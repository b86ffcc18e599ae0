// SPDX-License-Identifier: MIT
//
// Integrals by the rules of Gauss and Kronrod: one rule, functions that are smooth but for the
// ends, and any function over intervals and boxes, the interval with the largest error halved
// first; over boxes, one coordinate inside the other.
//
//     error of an interval = |Kronrod - Gauss| + 1/200 of it times what f at its ends, which the
//                            rule does not look at, differs from a parabola through the nodes there
//
// Shape   any finite f; jumps and corners are found by halving.
// Cost    17 values an interval; at most `most` intervals a coordinate.
// Promise the error told is that estimate, summed: no bound, but rarely exceeded. Not for making
//         points: roundings may differ between machines.
// Source  R. Piessens et al., QUADPACK (1983): the rules' numbers, and choosing the worst interval.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/domain.hpp"

namespace stipple {

/// One rule of 31 points, exact for polynomials of degree 46. The error is the difference from the
/// rule of Gauss that it contains, before it is scaled to the interval.
Estimate gauss_kronrod(const std::function<double(double)>& f, double low, double high);

/// Of a function that is smooth between the ends, up to square roots at the ends, which
///
///     x = a + (b - a) t^2 (3 - 2 t),    dx = 6 (b - a) t (1 - t) dt
///
/// takes away; by 31 points, halved at most four times. The error is far above the true one.
Estimate integrate_smooth(const std::function<double(double)>& f, double low, double high);

/// The ends of the pieces of a range: those of `cuts` inside, and its own.
std::vector<double> ends_of(std::vector<double> cuts, double low, double high);

/// Of a function that is so between these ends.
Estimate integrate_pieces(const std::function<double(double)>& f, std::span<const double> ends);

/// How far an integral is taken: to this error relative to its value, or so many intervals.
struct Effort {
    double tolerance = 1e-10;
    std::size_t most = 200;
    std::size_t first = 3;  ///< intervals to begin with; odd, so that a feature in the middle of a
                            ///< side is not missed by symmetry
};

Estimate integrate_interval(const std::function<double(double)>& f, double low, double high,
                            const Effort& effort = {});

/// Of a function of a point, over a box of at least one dimension.
Estimate integrate_box(const std::function<double(std::span<const double>)>& f, const Box& box,
                       const Effort& effort = {});

}  // namespace stipple
