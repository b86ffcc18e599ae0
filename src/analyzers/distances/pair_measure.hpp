// SPDX-License-Identifier: MIT
//
// How likely two independent uniform points of a box are at most r apart:
//
//     p(r) = 1 / V^2 * integral over |x| <= r of c(x) dx,
//
// where c is the box's set covariance: prod_k (L_k - |x_k|) for straight distances, and V within
// half a side along each axis for the torus, whose distances are never longer. With it the edges
// are accounted for exactly: n points have n (n - 1) / 2 * p(r) pairs on average.
//
// Shape   a box of 1, 2 or 3 dimensions and positive sides; r >= 0; p in [0, 1].
// Cost    closed forms in 1-D and 2-D, an integral over one angle in 3-D.
// Promise within 1e-15 in 1-D and 2-D, 1e-12 in 3-D.
// Source  S. N. Chiu, D. Stoyan, W. S. Kendall, J. Mecke, "Stochastic Geometry and its
//         Applications", 3rd ed., Wiley 2013, section 4.7 (edge correction by the set covariance).
#pragma once

#include "core/domain.hpp"

namespace stipple::analyzers {

double pair_probability(const Box& box, bool torus, double r);

/// The largest distance that two points of the box can have.
double longest_distance(const Box& box, bool torus);

}  // namespace stipple::analyzers
