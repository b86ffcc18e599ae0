// SPDX-License-Identifier: MIT
#include "math/spherical_polygon.hpp"

#include <algorithm>
#include <utility>

#include "math/trigonometry.hpp"

namespace stipple {

double half_area_turns(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double volume = dot(a, cross(minus(b, a), minus(c, a)));
    return turns_of(1 + dot(a, b) + dot(b, c) + dot(c, a), std::abs(volume));
}

SphericalPolygon::SphericalPolygon(std::vector<Vector3> corners) : corners_(std::move(corners)) {
    const std::size_t n = corners_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector3 edge = minus(corners_[(i + 1) % n], corners_[i]);
        Vector3 normal = normalized(cross(corners_[i], edge));
        if (dot(normal, minus(corners_[(i + 2) % n], corners_[i])) < 0) normal = times(normal, -1);
        inward_.push_back(normal);
    }
}

bool SphericalPolygon::contains(const Vector3& v, double slack) const {
    if (!(std::abs(length(v) - 1) <= slack)) return false;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        if (!(dot(inward_[i], minus(v, corners_[i])) >= -slack)) return false;
    return true;
}

double SphericalPolygon::edge_top(std::size_t i, const Vector3& up) const {
    const Vector3& from = corners_[i];
    const Vector3& to = corners_[(i + 1) % corners_.size()];
    const Vector3& normal = inward_[i];
    const Vector3 highest = minus(up, times(normal, dot(normal, up)));  // of the edge's circle
    // Turning with or against the normal, the edge passes it between its ends or not.
    const double turn = dot(cross(from, to), normal);
    const bool passes =
        turn * dot(cross(from, highest), normal) > 0 && turn * dot(cross(highest, to), normal) > 0;
    return passes ? length(highest) : std::max(dot(from, up), dot(to, up));
}

Box SphericalPolygon::bounding_box() const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k)
        for (const double sign : {-1.0, 1.0}) {
            Vector3 up{};
            up[k] = sign;
            double top = contains(up, 0) ? 1 : -1;
            for (std::size_t i = 0; i < corners_.size(); ++i) top = std::max(top, edge_top(i, up));
            (sign < 0 ? box.low : box.high).push_back(sign * top);
        }
    return box;
}

}  // namespace stipple
