// SPDX-License-Identifier: MIT
//
// Where the points of a Latin hypercube are, whose strata are known: somewhere in them, or in the
// middle. Strata are of equal width or, under constraints that no such Latin hypercube satisfies, those
// that hold equal shares of the points of the cube that have an image.
#pragma once

#include <cstdint>
#include <vector>

#include "generators/generator.hpp"

namespace stipple::generators {

class LatinPlaces {
  public:
    LatinPlaces(const Plan& plan, bool centered)
        : plan_(plan), in_middle_(plan.dimension, centered) {}

    /// Along this coordinate, points are in the middle of their strata.
    void put_in_middles(std::size_t coordinate) { in_middle_[coordinate] = true; }

    /// Of each coordinate, where strata begin and the last one ends.
    void put_between(std::vector<std::vector<double>> edges) { edges_ = std::move(edges); }

    /// A coordinate of point i, which is in this stratum.
    [[nodiscard]] double at(std::size_t coordinate, std::uint64_t i, double stratum) const;
    [[nodiscard]] double middle(std::size_t coordinate, double stratum) const;

  private:
    [[nodiscard]] double inside(std::size_t coordinate, double x, double stratum) const;

    Plan plan_;
    std::vector<bool> in_middle_;
    std::vector<std::vector<double>> edges_;  ///< empty: strata are of equal width
};

}  // namespace stipple::generators
