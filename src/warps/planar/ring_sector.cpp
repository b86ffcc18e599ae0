// SPDX-License-Identifier: MIT
#include "warps/planar/ring_sector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "math/densities/quadrature.hpp"
#include "math/functions/powers.hpp"
#include "warps/planar/placed_shape.hpp"

namespace stipple::warps {
namespace {

/// Distance of (x, y) from the positive x axis; the sign of y does not matter.
double beyond_side(double x, double y) { return x > 0 ? std::abs(y) : std::sqrt(x * x + y * y); }

}  // namespace

RingSector RingSector::between(double inner, double outer, double width) {
    if (!is_resolved(outer - inner, outer))
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

/// About the bisector of the angles as x axis: point = (r cos a, r sin a) with independent r and a,
/// |a| <= half. Central moments of r and of cos a are used, so that thin rings and narrow sectors
/// lose no digits. With v = 1 - cos a:
///
///     x - E x = (r - R) C + R (V - v) + (r - R) (V - v),    R = E r, V = E v, C = 1 - V.
PlaneMoments RingSector::moments() const {
    const double q = inner;
    const double rr = 0.5 * (1 + q * q);
    if (width == 1) return {.xx = 0.5 * rr, .yy = 0.5 * rr};
    const double thick = spread / (1 + q);
    const double middle = 0.5 * (1 + q);
    const double ratio = thick / middle * thick;
    const double r = middle + ratio / 12;
    const double r_2 = thick * thick / 12 - ratio * ratio / 144;
    const double r_3 = ratio * (ratio * ratio / 864 - thick * thick / 120);

    const double half = std::numbers::pi * width;
    const auto mean_of = [&](const auto& term) {
        const auto at = [&](double angle) {
            const CosSin own = cos_sin_turns(0.25 * std::numbers::inv_pi * angle);
            const double v = 2 * own.sin * own.sin;
            return term(v, v * (2 - v));  // 1 - cos and sin^2 of the angle
        };
        return gauss_kronrod(at, 0, half).value / half;
    };
    const double v_mean = mean_of([](double v, double) { return v; });
    const double c = 1 - v_mean;
    const double ss = mean_of([](double, double s) { return s; });
    const auto central = [&](std::size_t n) {
        return mean_of([&](double v, double) { return whole_power(v_mean - v, n); });
    };
    const double c_2 = central(2);
    const double c_3 = central(3);
    const double mixed = mean_of([&](double v, double s) { return (v_mean - v) * s; });

    const double xx = r_2 * c * c + r * r * c_2 + r_2 * c_2;
    const double yy = rr * ss;
    const double xxx = r_3 * (c * c * c + c_3 + 3 * c * c_2) + r * r * r * c_3 + 3 * r * r_2 * c_3 +
                       6 * c * r * r_2 * c_2;
    const double xyy = rr * r * mixed + (r_3 + 2 * r * r_2) * (c * ss + mixed);
    const auto [cos, sin] = cos_sin_turns(0.5 * width);
    const double cc = cos * cos;
    const double sin_2 = sin * sin;
    return {.mean = {r * c * cos, r * c * sin},
            .xx = cc * xx + sin_2 * yy,
            .xy = cos * sin * (xx - yy),
            .yy = sin_2 * xx + cc * yy,
            .xxx = cos * (cc * xxx + 3 * sin_2 * xyy),
            .xxy = sin * (cc * (xxx - 2 * xyy) + sin_2 * xyy),
            .xyy = cos * (sin_2 * (xxx - 2 * xyy) + cc * xyy),
            .yyy = sin * (sin_2 * xxx + 3 * cc * xyy)};
}

std::vector<std::string> RingSector::axes() const {
    const std::string area =
        inner > 0 ? "area fraction (r^2-q^2)/(R^2-q^2)" : "area fraction r^2/R^2";
    return {area, width < 1 ? "angle fraction" : "angle in turns"};
}

}  // namespace stipple::warps
