// SPDX-License-Identifier: MIT
//
// Elementary effects, or Morris screening: on trajectories, one input moves at a time; on stars,
// each input moves from the centre,
//
//     EE_i = (f(x + step along i) - f(x)) / step,    mu = mean EE, mu* = mean |EE|,
//
// and sigma is the standard deviation of EE over the trajectories. Steps are differences of
// probabilities F_i(x_i) if the distributions of the inputs are known (unit_inputs).
//
// Shape   n = r (k + 1) rows: trajectories of k + 1 consecutive rows, in which each input moves
//         once. A discrete input may stay the same in some, which then have no effect of it.
// Units   mu, mu* and sigma are those of the output: steps are of inputs in [0, 1].
// Cost    O(n k), and the bootstrap over trajectories.
// Source  M. D. Morris, Technometrics 33 (1991) 161-174, doi:10.1080/00401706.1991.10484804; mu*:
//         F. Campolongo, J. Cariboni, A. Saltelli, Environ. Model. Softw. 22 (2007) 1509-1518,
//         doi:10.1016/j.envsoft.2006.10.004; stars: F. Campolongo, A. Saltelli, J. Cariboni,
//         Comput. Phys. Commun. 182 (2011) 978-988, doi:10.1016/j.cpc.2010.12.039.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

Layout find_trajectories(const PointSet& design);

/// Leaves out trajectories with a failed run. @throws Error(input) if too few remain
Effects elementary_effects(const Layout& layout, const Inputs& inputs, const Response& response,
                           const Setting& setting, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
