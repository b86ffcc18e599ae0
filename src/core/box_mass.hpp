// SPDX-License-Identifier: MIT
//
// Where in space a domain's probability lies. A mixture has no coordinates of its own that would
// preserve probability: its cells are boxes of space, or zones of the sphere, whose probabilities
// are sums over its components.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/domain.hpp"

namespace stipple {

/// What a domain also is that knows the probability of boxes of its own space.
class Weighable {
  public:
    Weighable() = default;
    Weighable(const Weighable&) = delete;
    Weighable& operator=(const Weighable&) = delete;
    virtual ~Weighable() = default;

    /// Of points that follow the domain's density; the box may be larger than the domain, and
    /// reach to infinity.
    [[nodiscard]] virtual Estimate box_mass(const Box& box) const = 0;
};

/// Of a domain on which the coordinate k of to_cube depends on coordinate k of a point alone, and
/// rises or falls with it.
inline Estimate box_mass_by_axes(const Domain& domain, const Box& box) {
    const std::size_t d = domain.dimension();
    const Box ends = domain.bounding_box();
    const bool finite = domain.measure() < std::numeric_limits<double>::infinity();
    const auto cube_of = [&](std::vector<double> corner) {
        for (std::size_t k = 0; k < d && finite; ++k)
            corner[k] = std::clamp(corner[k], ends.low[k], ends.high[k]);
        std::vector<double> cube(d);
        domain.to_cube(corner, cube);
        return cube;
    };
    Box cell{cube_of(box.low), cube_of(box.high)};
    for (std::size_t k = 0; k < d; ++k) {
        if (!(box.low[k] < box.high[k])) return {};
        if (cell.low[k] > cell.high[k]) std::swap(cell.low[k], cell.high[k]);
    }
    return domain.probability(cell);
}

}  // namespace stipple
