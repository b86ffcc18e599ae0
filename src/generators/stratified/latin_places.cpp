// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_places.hpp"

#include <algorithm>

#include "generators/stratified/stratified.hpp"

namespace stipple::generators {

double LatinPlaces::inside(std::size_t coordinate, double x, double stratum) const {
    if (edges_.empty()) return x;
    const double* edge = &edges_[coordinate][static_cast<std::size_t>(stratum)];
    const double part = x * static_cast<double>(plan_.count) - stratum;
    return edge[0] + std::clamp(part, 0.0, 1.0) * (edge[1] - edge[0]);
}

double LatinPlaces::at(std::size_t coordinate, std::uint64_t i, double stratum) const {
    const double x =
        place_in_stratum(plan_, in_middle_[coordinate], coordinate, i, stratum, plan_.count);
    return inside(coordinate, x, stratum);
}

double LatinPlaces::middle(std::size_t coordinate, double stratum) const {
    return inside(coordinate, place_in_stratum(plan_, true, coordinate, 0, stratum, plan_.count),
                  stratum);
}

}  // namespace stipple::generators
