// SPDX-License-Identifier: MIT
//
// Histogram of the distances from each point to its nearest other one, with the density that
// independent uniform points have:
//
//     p(r) = d v_d rho r^(d-1) exp(-rho v_d r^d)
//
// where v_d is the volume of the unit ball and rho = n / V.
//
// Source  P. Hertz, Math. Ann. 67 (1909) 387-398, doi:10.1007/BF01450410.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "plot/chart.hpp"
#include "stipple/run.hpp"

namespace stipple::plot {

/// @throws Error(input) for a set of one point.
Chart distance_chart(std::span<const PointSet* const> sets, const std::vector<std::string>& names,
                     const RunContext& run);

}  // namespace stipple::plot
