// SPDX-License-Identifier: MIT
//
// Visits all Latin hypercubes of few points to find the best of them.
//
// The first coordinate numbers the points. The levels of every other one take all orders except
// mirror images, which are the same to every criterion, by plain changes: exchanges of two
// neighbouring levels, back and forth like the digits of a reflected Gray code. So consecutive
// designs differ by one exchange.
//
// Cost    (n! / 2)^(d - 1) designs, O(n^2) each; n! / 2 bytes.
// Source  D. E. Knuth, The Art of Computer Programming 4A (2011), 7.2.1.1 algorithm H, 7.2.1.2
//         algorithm P.
#pragma once

#include "generators/stratified/latin_hypercube_search/criteria.hpp"

namespace stipple::latin_hypercube_search {

/// Number of designs, (n! / 2)^(d - 1); infinite for more than 11 points in two or more
/// coordinates.
double designs_to_try(const Design& start);

/// Returns the best design, or the best so far if the run is stopped and keeps it.
/// @throws Error(cancelled)
Result best_of_all(const Objective& objective, const Design& start, const RunContext& run);

}  // namespace stipple::latin_hypercube_search
