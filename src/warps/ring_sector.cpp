// SPDX-License-Identifier: MIT
#include "warps/ring_sector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stipple::warps {
namespace {

/// Distance of (x, y) from the half-line along the x axis, where y tells the side.
double beyond_side(double x, double y) { return x > 0 ? std::abs(y) : std::sqrt(x * x + y * y); }

}  // namespace

double RingSector::area() const { return std::numbers::pi * spread * width; }

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
    for (int quarter = 0; quarter < 8; ++quarter) {  // where the turned rim meets the axes
        const double angle = 0.25 * quarter - turn;
        if (angle < 0 || angle > width) continue;
        const auto [c, s] = cos_sin_turns(angle);
        points.push_back({c, s});
    }
    return points;
}

std::vector<std::string> RingSector::axes() const {
    const std::string area =
        inner > 0 ? "area fraction (r^2-q^2)/(R^2-q^2)" : "area fraction r^2/R^2";
    return {area, width < 1 ? "angle fraction" : "angle in turns"};
}

}  // namespace stipple::warps
