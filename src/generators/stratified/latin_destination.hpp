// SPDX-License-Identifier: MIT
//
// Search for a Latin hypercube whose points become parameters, some of which may be discrete or
// under constraints.
//
// Outcomes     along discrete axes, distances are those of outcomes, all categories being equally
//              far from each other, and points are in the middles of their strata.
// Constraints  all points satisfy them. The search begins with exchanges of strata until they do.
//              If that fails, as for x + y < 1, which no Latin hypercube with strata of equal width
//              satisfies, the strata of each axis hold equal fractions of the points of the cube
//              that satisfy them, estimated from at least 16 random ones per stratum.
#pragma once

#include <memory>

#include "generators/stratified/latin_hypercube_search/search.hpp"
#include "generators/stratified/latin_places.hpp"

namespace stipple::generators {

/// Adapts the search, whose points are at `places`, to plan.destination.
/// @throws Error(usage), Error(input) if no start is found
void aim_at_destination(const Plan& plan, const std::shared_ptr<LatinPlaces>& places,
                        latin_hypercube_search::Search& task, const RunContext& run);

}  // namespace stipple::generators
