// SPDX-License-Identifier: MIT
//
// Integrals by Gauss-Kronrod rules: with a single rule; of functions that are smooth except at the
// ends; and of any function, over intervals and boxes. The interval with the largest error is
// halved first. Integrals over boxes are nested, one coordinate at a time.
//
//     error of an interval = |Kronrod - Gauss| + 1/200 of its width times the differences of f at
//                            its ends from parabolas through the three nearest nodes
//
// Shape   any finite f; jumps and corners are found by halving.
// Cost    17 values per interval; at most `most` intervals per coordinate.
// Promise the returned error is the sum of these estimates: not a bound, but rarely exceeded. Not
//         for generating points, because rounding may differ between machines.
// Source  R. Piessens et al., QUADPACK (1983): the constants of the rules, and bisection of the
//         worst interval.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/domain.hpp"

namespace stipple {

/// A single 31-point rule, exact for polynomials of degree 46. The error is the difference from the
/// Gauss rule that it contains, before scaling to the interval.
Estimate gauss_kronrod(const std::function<double(double)>& f, double low, double high);

/// Integral of a function that is smooth inside, with square roots allowed at the ends. The
/// substitution
///
///     x = a + (b - a) t^2 (3 - 2 t),    dx = 6 (b - a) t (1 - t) dt
///
/// removes these roots. Uses the 31-point rule, bisected at most four times. The returned error is
/// far above the true one.
Estimate integrate_smooth(const std::function<double(double)>& f, double low, double high);

/// Ends of the pieces of [low, high]: the cuts inside, and low and high.
std::vector<double> ends_of(std::vector<double> cuts, double low, double high);

/// Integral of a function that is smooth between consecutive ends, as for integrate_smooth.
Estimate integrate_pieces(const std::function<double(double)>& f, std::span<const double> ends);

/// Conditions to stop: an error relative to the value, or the maximum number of intervals.
struct Effort {
    double tolerance = 1e-10;
    std::size_t most = 200;
    std::size_t first = 3;  ///< initial intervals; odd, so that no feature in the middle is missed
};

Estimate integrate_interval(const std::function<double(double)>& f, double low, double high,
                            const Effort& effort = {});

/// Integral of a function of a point, over a box with at least one dimension.
Estimate integrate_box(const std::function<double(std::span<const double>)>& f, const Box& box,
                       const Effort& effort = {});

}  // namespace stipple
