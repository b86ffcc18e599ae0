// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/domain.hpp"
#include "core/rng.hpp"
#include "media/density_map.hpp"

namespace stipple {

/// Moves a uniform point of a rectangle to where the density has it.
/// @return 1 / sqrt(density there), the mean density being 1: as far apart as such points are
inline double follow(const DensityMap& map, const Box& box, double* point) {
    std::array<double, 2> at{};
    for (std::size_t k = 0; k < 2; ++k)
        at[k] = std::min((point[k] - box.low[k]) / box.extent(k), one_minus_ulp);
    at = map.place(at[0], at[1]);
    for (std::size_t k = 0; k < 2; ++k)
        point[k] =
            std::min(box.low[k] + at[k] * box.extent(k), std::nextafter(box.high[k], box.low[k]));
    return 1 / std::sqrt(map.at(at[0], at[1]));
}

}  // namespace stipple
