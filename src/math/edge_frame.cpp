// SPDX-License-Identifier: MIT
#include "math/edge_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stipple {
namespace {

SpacePoint times(const SpacePoint& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
double dot(const SpacePoint& a, const SpacePoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const SpacePoint& a) { return std::sqrt(dot(a, a)); }
SpacePoint cross(const SpacePoint& a, const SpacePoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

SpacePoint space_point(std::span<const double> point) {
    return {point[0], point[1], point.size() > 2 ? point[2] : 0};
}

SpacePoint difference(const SpacePoint& a, const SpacePoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

EdgeFrame::EdgeFrame(const SpacePoint& corner, const SpacePoint& a, const SpacePoint& b,
                     double size)
    : corner_(corner) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    lengths_ = {length(a), length(b), length(difference(b, a))};
    const double longest = *std::ranges::max_element(lengths_);
    // In units of a power of 2 near the longest edge nothing over- or underflows or is rounded.
    const double unit = longest > 1e-140 ? std::ldexp(1.0, std::ilogb(longest)) : 1;
    const SpacePoint e = times(a, 1 / unit);
    const SpacePoint f = times(b, 1 / unit);
    const SpacePoint n = cross(e, f);
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

EdgeFrame::Coordinates EdgeFrame::coordinates(const SpacePoint& point) const {
    const SpacePoint d = difference(point, corner_);
    return {dot(g_, d), dot(h_, d)};
}

double EdgeFrame::off_plane(const SpacePoint& point) const {
    return std::abs(dot(normal_, difference(point, corner_)));
}

}  // namespace stipple
