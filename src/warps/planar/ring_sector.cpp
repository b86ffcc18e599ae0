// SPDX-License-Identifier: MIT
#include "warps/planar/ring_sector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "warps/planar/placed_shape.hpp"

namespace stipple::warps {
namespace {

/// Distance of (x, y) from the positive x axis; the sign of y does not matter.
double beyond_side(double x, double y) { return x > 0 ? std::abs(y) : std::sqrt(x * x + y * y); }

}  // namespace

RingSector RingSector::between(double inner, double outer, double width) {
    if (!(outer - inner > lost_in_rounding * outer))
        fail(ErrorKind::usage, "--inner: {} is not below --radius {}, or too close to it", inner,
             outer);
    const double q = inner / outer;
    return {.inner = q, .spread = (outer - inner) / outer * (1 + q), .width = width};
}

double RingSector::area() const { return std::numbers::pi * spread * width; }

double RingSector::area_in(const Polygon& window) const {
    const auto in_ring = [&](const Polygon& part) {
        const double within = area_in_disk(part, {0, 0}, 1);
        return inner > 0 ? within - area_in_disk(part, {0, 0}, inner) : within;
    };
    if (width == 1) return in_ring(window);
    const auto [c, s] = cos_sin_turns(width);
    const PlanePair origin{0, 0};
    if (width <= 0.5) return in_ring(clipped(clipped(window, origin, {0, -1}), origin, {-s, c}));
    return in_ring(window) - in_ring(clipped(clipped(window, origin, {0, 1}), origin, {s, -c}));
}

double RingSector::beyond(double x, double y) const {
    const double r = std::sqrt(x * x + y * y);
    const double radial = std::max(r - 1, inner - r);
    if (width == 1 || turns_of(x, y) <= width) return radial;
    const auto [c, s] = cos_sin_turns(width);
    return std::max(radial, std::min(beyond_side(x, y), beyond_side(x * c + y * s, y * c - x * s)));
}

std::vector<PlanePoint> RingSector::hull(double turn) const {
    std::vector<PlanePoint> points;
    for (const double angle : {0.0, width}) {
        const auto [c, s] = cos_sin_turns(angle);
        points.push_back({c, s});
        points.push_back({inner * c, inner * s});
    }
    for (int quarter = 0; quarter < 8; ++quarter) {  // points extreme along an axis, after the turn
        const double angle = 0.25 * quarter - turn;
        if (angle < 0 || angle > width) continue;
        const auto [c, s] = cos_sin_turns(angle);
        points.push_back({c, s});
    }
    return points;
}

/// Each moment of order n = i + j is E r^n times the mean of cos^i sin^j over the angle.
PlaneMoments RingSector::moments() const {
    const double q = inner;
    const double r = 2 / 3.0 * (1 + q + q * q) / (1 + q);
    const double rr = 0.5 * (1 + q * q);
    const double rrr = 0.4 * (1 + q * (1 + q * (1 + q * (1 + q)))) / (1 + q);
    const double angle = 2 * std::numbers::pi * width;
    const auto [c, s] = cos_sin_turns(width);
    const double less = 1 - c;
    const double less_cube = less * (1 + c + c * c);  // 1 - c^3
    const double half = 0.5 * c * s / angle;
    const PlaneMoments raw{.mean = {r * s / angle, r * less / angle},
                           .xx = rr * (0.5 + half),
                           .xy = rr * 0.5 * s * s / angle,
                           .yy = rr * (0.5 - half),
                           .xxx = rrr * (s - s * s * s / 3) / angle,
                           .xxy = rrr * less_cube / 3 / angle,
                           .xyy = rrr * s * s * s / 3 / angle,
                           .yyy = rrr * (less - less_cube / 3) / angle};
    return about_the_mean(raw);
}

std::vector<std::string> RingSector::axes() const {
    const std::string area =
        inner > 0 ? "area fraction (r^2-q^2)/(R^2-q^2)" : "area fraction r^2/R^2";
    return {area, width < 1 ? "angle fraction" : "angle in turns"};
}

}  // namespace stipple::warps
