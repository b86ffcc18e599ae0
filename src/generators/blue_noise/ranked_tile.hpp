// SPDX-License-Identifier: MIT
//
// A tile of blue noise whose points have ranks: the first m of them are well spread, for every m.
//
// The tile is toroidal Gaussian blue noise (gaussian_relaxation.hpp). Its points are ranked
// from the last to the first: each time the point goes that feels most of those left,
//
//     argmax over i of  sum over j of exp(-|x_i - x_j|^2 / (2 sigma^2)),
//
// as void-and-cluster takes cells away; sigma is 0.47 of the mean distance of all points, and
// doubles when a quarter is left.
//
// Shape   2-D, any proportions up to those of gaussian_relaxation.hpp.
// Cost    O(t (steps + t)): 1.5 seconds for t = 4096 and 250 steps.
// Promise coordinates are multiples of 2^-28, so that those of repeated tiles are exact sums.
// Source  R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913
//         (1993) 332-343, doi:10.1117/12.152707: the order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/neighbors/periodic_voronoi.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Points of [0, 1)^2, those of the lowest rank in front; distances are those of a torus with sides
/// in proportion to `sides`.
std::vector<Vec2> ranked_tile(std::size_t count, std::uint64_t steps, Vec2 sides,
                              std::uint64_t seed, const RunContext& run);

}  // namespace stipple
