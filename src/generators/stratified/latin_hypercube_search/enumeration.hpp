// SPDX-License-Identifier: MIT
//
// All Latin hypercubes of few points, one by one, for the best of them.
//
// The first coordinate numbers the points. The levels of each other one take all orders but their
// mirror images, which are the same to every criterion, by plain changes: exchanges of two neighbouring
// levels, back and forth as the digits of a reflected Gray code. So from design to design it takes one
// exchange.
//
// Cost    (n! / 2)^(d - 1) designs, O(n^2) each; n! / 2 bytes.
// Source  D. E. Knuth, The Art of Computer Programming 4A (2011), 7.2.1.1 algorithm H, 7.2.1.2
//         algorithm P.
#pragma once

#include "generators/stratified/latin_hypercube_search/criteria.hpp"

namespace stipple::latin_hypercube_search {

/// (n! / 2)^(d - 1); infinite for more than 11 points of two coordinates or more.
double designs_to_try(const Design& start);

/// The best design, or the best so far where the run is stopped and keeps it. @throws Error(cancelled)
Result best_of_all(const Objective& objective, const Design& start, const RunContext& run);

}  // namespace stipple::latin_hypercube_search
