// SPDX-License-Identifier: MIT
//
// Sobol' indices from pick-freeze designs. Two independent samples A and B of N points are mixed:
// AB_i is A with coordinate i of B, BA_i is B with coordinate i of A. With the outputs f centred at
// their mean and V the variance of f(A) and f(B),
//
//     first   S_i   = mean f(B) (f(AB_i) - f(A)) / V
//     total   ST_i  = mean (f(A) - f(AB_i))^2 / (2 V)
//     second  S_ij  = mean (f(BA_i) f(AB_j) - f(A) f(B)) / V - S_i - S_j.
//
// Shape   n = N (k + 2) rows, for each base row A, AB_1, ..., AB_k, B; or N (2k + 2) rows: A, AB_1,
//         ..., AB_k, BA_1, ..., BA_k, B. Coordinates that were copied must be equal to the last
//         bit, as they are after any map of single coordinates.
// Cost    O(n k) and the bootstrap over base rows, to which pairs add k (k - 1) / 2 terms.
// Source  A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto, S. Tarantola, Comput. Phys.
//         Commun. 181 (2010) 259-270, doi:10.1016/j.cpc.2009.09.018, table 2 (b) and (f), the
//         latter due to M. J. W. Jansen, Comput. Phys. Commun. 117 (1999) 35-43. Pairs and the
//         order of rows: A. Saltelli, Comput. Phys. Commun. 145 (2002) 280-297.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

Layout find_pick_freeze(const PointSet& design);

/// Leaves out base rows with a failed run. @throws Error(input) if too few remain
Effects pick_freeze(const Layout& layout, const Inputs& inputs, const Response& response,
                    const Setting& setting, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
