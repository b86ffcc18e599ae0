// SPDX-License-Identifier: MIT
//
// A search for a Latin hypercube whose points become something else: parameters of which some are
// discrete, and which constraints hold for.
//
// Outcomes     points count as being where their outcomes are, those of categories all as far from
//              each other, and are in the middles of their strata along such axes.
// Constraints  all points satisfy them. The search begins with exchanges of strata until they do.
//              Where it finds none, as of x + y < 1, of which no Latin hypercube of strata of equal
//              width is, each axis has strata that hold equal shares of the points of the cube that
//              satisfy them, by 16 or more random ones a stratum.
#pragma once

#include <memory>

#include "generators/stratified/latin_hypercube_search/search.hpp"
#include "generators/stratified/latin_places.hpp"

namespace stipple::generators {

/// The task under plan.destination, of which `places` tells where points are.
/// @throws Error(usage), Error(input) where no start is found
void aim_at_destination(const Plan& plan, const std::shared_ptr<LatinPlaces>& places,
                        latin_hypercube_search::Search& task, const RunContext& run);

}  // namespace stipple::generators
