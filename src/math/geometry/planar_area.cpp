// SPDX-License-Identifier: MIT
//
// A polygon is clipped to a half-plane edge by edge (Sutherland and Hodgman). Its area within a
// disk is a sum over its edges p -> q: the signed area that the disk shares with the triangle whose
// corners are p, q and the disk's centre. The part of the edge inside the disk contributes half a
// cross product, the part outside a sector.
//
// Source  I. E. Sutherland, G. W. Hodgman, Communications of the ACM 17 (1974) 32-42,
//         doi:10.1145/360767.360802.
#include "math/geometry/planar_area.hpp"

#include <algorithm>
#include <cmath>

#include "math/functions/radians.hpp"

namespace stipple {
namespace {

double planar_cross(const PlanePair& a, const PlanePair& b) { return a[0] * b[1] - a[1] * b[0]; }
double planar_dot(const PlanePair& a, const PlanePair& b) { return a[0] * b[0] + a[1] * b[1]; }
PlanePair planar_minus(const PlanePair& a, const PlanePair& b) {
    return {a[0] - b[0], a[1] - b[1]};
}
PlanePair between(const PlanePair& a, const PlanePair& b, double t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

/// Signed area that a disk about 0 shares with the triangle 0, p, q.
double triangle_in_disk(const PlanePair& p, const PlanePair& q, double radius) {
    const auto sector = [&](const PlanePair& from, const PlanePair& to) {
        return radius * radius * signed_angle(planar_cross(from, to), planar_dot(from, to)) / 2;
    };
    const PlanePair along = planar_minus(q, p);
    const double a = planar_dot(along, along);
    const double b = planar_dot(p, along);
    const double root = b * b - a * (planar_dot(p, p) - radius * radius);
    if (a == 0) return 0;
    if (!(root > 0)) return sector(p, q);
    const double in = std::clamp((-b - std::sqrt(root)) / a, 0.0, 1.0);
    const double out = std::clamp((-b + std::sqrt(root)) / a, 0.0, 1.0);
    if (!(in < out)) return sector(p, q);
    const PlanePair enters = between(p, q, in);
    const PlanePair leaves = between(p, q, out);
    double area = planar_cross(enters, leaves) / 2;
    if (in > 0) area += sector(p, enters);
    if (out < 1) area += sector(leaves, q);
    return area;
}

}  // namespace

Polygon unit_square() { return {{0, 0}, {1, 0}, {1, 1}, {0, 1}}; }

double signed_area(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += planar_cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return twice / 2;
}

Polygon clipped(const Polygon& polygon, const PlanePair& p, const PlanePair& n) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PlanePair& from = polygon[i];
        const PlanePair& to = polygon[(i + 1) % polygon.size()];
        const double here = planar_dot(n, planar_minus(from, p));
        const double there = planar_dot(n, planar_minus(to, p));
        if (here <= 0) kept.push_back(from);
        if ((here < 0 && there > 0) || (here > 0 && there < 0))
            kept.push_back(between(from, to, here / (here - there)));
    }
    return kept;
}

double area_in_disk(const Polygon& polygon, const PlanePair& center, double radius) {
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        area += triangle_in_disk(planar_minus(polygon[i], center),
                                 planar_minus(polygon[(i + 1) % polygon.size()], center), radius);
    return area;
}

double shared_area(const Polygon& polygon, const Polygon& window) {
    Polygon rest = polygon;
    for (std::size_t i = 0; i < window.size(); ++i) {
        const PlanePair edge = planar_minus(window[(i + 1) % window.size()], window[i]);
        rest = clipped(rest, window[i], {edge[1], -edge[0]});
    }
    return std::abs(signed_area(rest));
}

}  // namespace stipple
