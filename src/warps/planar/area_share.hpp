// SPDX-License-Identifier: MIT
//
// Probability of a box for points uniform on a plane shape: the area of their intersection divided
// by the shape's area.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/domain.hpp"
#include "math/geometry/planar_area.hpp"

namespace stipple::warps {

/// @param shared returns the area of the shape within a box inside the shape's bounding box. Its
/// argument is the polygon of the box's corners, counterclockwise from the lower left one.
/// @return with error 0 or, for shapes that are thin or far from 0, the error by rounding of
/// coordinates
template <class Shared>
Estimate area_share(const Box& box, const Domain& shape, const Shared& shared) {
    const Box around = shape.bounding_box();
    // How small the shape is beside its coordinates or, if it is thin, beside its bounding box.
    double far = std::max(1.0, around.extent(0) * around.extent(1) / shape.measure());
    double low[2];
    double high[2];
    for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::max(box.low[k], around.low[k]);
        high[k] = std::min(box.high[k], around.high[k]);
        if (!(low[k] < high[k])) return {};
        far = std::max({far, std::abs(around.low[k]) / around.extent(k),
                        std::abs(around.high[k]) / around.extent(k)});
    }
    const double area =
        shared(Polygon{{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}});
    const double share = std::clamp(area / shape.measure(), 0.0, 1.0);
    // Below this ratio, rounding of coordinates is neglected.
    constexpr double near = 16;
    return {share, far > near ? 8 * std::numeric_limits<double>::epsilon() * far : 0};
}

}  // namespace stipple::warps
