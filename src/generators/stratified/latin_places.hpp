// SPDX-License-Identifier: MIT
//
// Coordinates of the points of a Latin hypercube with known strata: anywhere in their strata, or in
// the middle. Strata have equal widths or, if constraints allow no such Latin hypercube, hold equal
// fractions of the points of the cube that have an image.
#pragma once

#include <cstdint>
#include <vector>

#include "generators/generator.hpp"

namespace stipple::generators {

class LatinPlaces {
  public:
    LatinPlaces(const Plan& plan, bool centered)
        : plan_(plan), in_middle_(plan.dimension, centered) {}

    /// Puts points into the middles of their strata along this coordinate.
    void put_in_middles(std::size_t coordinate) { in_middle_[coordinate] = true; }

    /// Sets the boundaries of the strata along each coordinate, including both ends.
    void put_between(std::vector<std::vector<double>> edges) { edges_ = std::move(edges); }

    /// Coordinate of point i along axis `coordinate`, on which the point is in this stratum.
    [[nodiscard]] double at(std::size_t coordinate, std::uint64_t i, double stratum) const;
    [[nodiscard]] double middle(std::size_t coordinate, double stratum) const;

  private:
    [[nodiscard]] double inside(std::size_t coordinate, double x, double stratum) const;

    Plan plan_;
    std::vector<bool> in_middle_;
    std::vector<std::vector<double>> edges_;  ///< empty: strata are of equal width
};

}  // namespace stipple::generators
