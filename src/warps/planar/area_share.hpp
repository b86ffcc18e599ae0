// SPDX-License-Identifier: MIT
//
// Probability of a box for points that are uniform on a shape of the plane: the area that they
// share, over the shape's.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/domain.hpp"
#include "math/geometry/planar_area.hpp"

namespace stipple::warps {

/// @param shared the area of the shape within a box, given by its corners counterclockwise from the
/// lowest; the box is not larger than the one around the shape. Far from 0, where coordinates round
/// more coarsely than the shape's size, that rounding is the error.
template <class Shared>
Estimate area_share(const Box& box, const Domain& shape, const Shared& shared) {
    const Box around = shape.bounding_box();
    double far = 1;
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
    constexpr double near = 16;  // within which rounding is that of an exact value
    return {share, far > near ? 8 * std::numeric_limits<double>::epsilon() * far : 0};
}

}  // namespace stipple::warps
