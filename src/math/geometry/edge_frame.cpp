// SPDX-License-Identifier: MIT
#include "math/geometry/edge_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stipple {
Vector3 space_point(std::span<const double> point) {
    return {point[0], point[1], point.size() > 2 ? point[2] : 0};
}

EdgeFrame::EdgeFrame(const Vector3& corner, const Vector3& a, const Vector3& b, double size)
    : corner_(corner) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    lengths_ = {length(a), length(b), length(minus(b, a))};
    const double longest = *std::ranges::max_element(lengths_);
    // In units of a power of 2 near the longest edge nothing over- or underflows or is rounded.
    const double unit = longest > 1e-140 ? std::ldexp(1.0, std::ilogb(longest)) : 1;
    const Vector3 e = times(a, 1 / unit);
    const Vector3 f = times(b, 1 / unit);
    const Vector3 n = cross(e, f);
    const double area = length(n);
    const double height = area * unit * (unit / longest);
    flat_ = !(longest > 1e-140 && height > 64 * epsilon * size);
    if (flat_) return;
    area_ = area * unit * unit;
    slack_ = 16 * epsilon * size * (longest / height);
    normal_ = times(n, 1 / area);
    g_ = times(cross(f, normal_), 1 / (area * unit));
    h_ = times(cross(normal_, e), 1 / (area * unit));
}

EdgeFrame::Coordinates EdgeFrame::coordinates(const Vector3& point) const {
    const Vector3 d = minus(point, corner_);
    return {dot(g_, d), dot(h_, d)};
}

double EdgeFrame::off_plane(const Vector3& point) const {
    return std::abs(dot(normal_, minus(point, corner_)));
}

}  // namespace stipple
