// SPDX-License-Identifier: MIT
#include "math/geometry/zone_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/densities/quadrature.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// Adds the heights at which a circle meets the meridian of a longitude, or the opposite one.
void add_meridian(const SphereCircle& circle, double turn, std::vector<double>& cuts) {
    const auto& [n, h] = circle;
    const auto [cos, sin] = cos_sin_turns(turn);
    const double p = n[0] * cos + n[1] * sin;
    const double a = n[2] * n[2] + p * p;
    const double root = a - h * h;
    if (!(a > 0) || !(root >= 0)) return;
    for (const double sign : {-1.0, 1.0})
        cuts.push_back((h * n[2] + sign * std::abs(p) * std::sqrt(root)) / a);
}

/// Adds the heights at which two circles meet.
void add_corners(const SphereCircle& p, const SphereCircle& q, std::vector<double>& cuts) {
    const double g = dot(p.normal, q.normal);
    const double rest = 1 - g * g;
    if (!(rest > 1e-12)) return;
    const double a = (p.height - q.height * g) / rest;
    const double b = (q.height - p.height * g) / rest;
    const Vector3 middle = plus(times(p.normal, a), times(q.normal, b));
    const double root = (1 - dot(middle, middle)) / rest;
    if (!(root >= 0)) return;
    const double step = std::sqrt(root) * cross(p.normal, q.normal)[2];
    cuts.push_back(middle[2] + step);
    cuts.push_back(middle[2] - step);
}

std::vector<double> height_cuts(const Zone& zone, const SphereShape& shape) {
    std::vector<double> cuts;
    for (std::size_t i = 0; i < shape.circles.size(); ++i) {
        const SphereCircle& circle = shape.circles[i];
        const auto& [n, h] = circle;
        const double across = std::sqrt(n[0] * n[0] + n[1] * n[1]);
        const double reach = across * std::sqrt(std::max(0.0, 1 - h * h));
        cuts.push_back(h * n[2] - reach);
        cuts.push_back(h * n[2] + reach);
        add_meridian(circle, zone.turn_low, cuts);
        add_meridian(circle, zone.turn_high, cuts);
        for (std::size_t j = 0; j < i; ++j) add_corners(circle, shape.circles[j], cuts);
    }
    return ends_of(std::move(cuts), zone.z_low, zone.z_high);
}

/// Longitudes, in turns, at which circles cross this height.
std::vector<double> turn_cuts(double z, const Zone& zone, const SphereShape& shape) {
    std::vector<double> cuts;
    const double r = std::sqrt((1 - z) * (1 + z));
    for (const auto& [n, h] : shape.circles) {
        const double across = r * std::sqrt(n[0] * n[0] + n[1] * n[1]);
        const double cosine = (h - n[2] * z) / across;
        if (!(std::abs(cosine) < 1)) continue;
        const double middle = turns_of(n[0], n[1]);
        const double half = turns_of(cosine, std::sqrt((1 - cosine) * (1 + cosine)));
        for (const double turn : {middle - half, middle + half})
            cuts.push_back(turn - std::floor(turn));
    }
    return ends_of(std::move(cuts), zone.turn_low, zone.turn_high);
}

/// Integral over the longitudes at one height.
Estimate integrate_row(const SphereDensity& f, double z, const Zone& zone,
                       const SphereShape& shape) {
    const double r = std::sqrt((1 - z) * (1 + z));
    const auto at = [&](double turn) {
        const auto [cos, sin] = cos_sin_turns(turn);
        return f({r * cos, r * sin, z});
    };
    const auto turns = turn_cuts(z, zone, shape);
    Estimate sum;
    if (shape.level)
        for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
            const double width = turns[i + 1] - turns[i];
            if (width > 0) sum.value += width * at(turns[i] + 0.5 * width);
        }
    else
        sum = integrate_pieces(at, turns);
    return full_turn * sum;
}

}  // namespace

Estimate integrate_zone(const SphereDensity& f, const Zone& zone, const SphereShape& shape) {
    Estimate total;
    if (shape.level && shape.circles.empty()) {
        const double z = zone.z_low + 0.5 * (zone.z_high - zone.z_low);
        total.value = (zone.z_high - zone.z_low) * integrate_row(f, z, zone, shape).value;
        return total;
    }
    double inner = 0;
    const auto slice = [&](double z) {
        const Estimate row = integrate_row(f, z, zone, shape);
        inner = std::max(inner, row.error);
        return row.value;
    };
    total = integrate_pieces(slice, height_cuts(zone, shape));
    total.error += inner * (zone.z_high - zone.z_low);
    return total;
}

}  // namespace stipple
