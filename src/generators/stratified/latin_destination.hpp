// SPDX-License-Identifier: MIT
//
// Positions of a Latin hypercube's points in their strata; and preparation of the search for a
// hypercube whose points become parameters, which may be discrete or under constraints.
//
// Outcomes     Along the axis of a discrete parameter, distances are those of its outcomes, with
//              all categories equally far apart; points are in the middles of their strata.
// Constraints  The search begins with exchanges of strata until all points satisfy them. If that
//              fails, as for x + y < 1, which no Latin hypercube with strata of equal width
//              satisfies, the strata of each axis hold equal fractions of the cube's points that
//              satisfy the constraints, estimated from at least 16 random ones per stratum.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "generators/generator.hpp"
#include "generators/stratified/latin_hypercube_search/search.hpp"

namespace stipple::generators {

/// Points anywhere in their strata, or in the middle. Strata have equal widths or, if constraints
/// allow no such Latin hypercube, hold equal fractions of the points that satisfy them.
class LatinPlaces {
  public:
    LatinPlaces(const Plan& plan, bool centered)
        : plan_(plan), in_middle_(plan.dimension, centered) {}

    /// Puts points into the middles of their strata along this coordinate, from now on.
    void put_in_middles(std::size_t coordinate) { in_middle_[coordinate] = true; }

    /// Sets the boundaries of the strata along each coordinate, including both ends.
    void put_between(std::vector<std::vector<double>> edges) { edges_ = std::move(edges); }

    /// Coordinate of point i along axis `coordinate`, on which the point is in `stratum`.
    [[nodiscard]] double at(std::size_t coordinate, std::uint64_t i, double stratum) const;
    [[nodiscard]] double middle(std::size_t coordinate, double stratum) const;

  private:
    [[nodiscard]] double inside(std::size_t coordinate, double x, double stratum) const;

    Plan plan_;
    std::vector<bool> in_middle_;
    std::vector<std::vector<double>> edges_;  ///< empty: strata are of equal width
};

/// Adapts `task` and `places` to the discrete outcomes and the constraints of plan.destination.
/// @throws Error(usage); Error(input) if no start satisfies the constraints
void aim_at_destination(const Plan& plan, const std::shared_ptr<LatinPlaces>& places,
                        latin_hypercube_search::Search& task, const RunContext& run);

}  // namespace stipple::generators
