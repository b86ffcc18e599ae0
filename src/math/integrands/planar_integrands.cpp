// SPDX-License-Identifier: MIT
//
// Indicator functions on the unit square with their areas: discontinuities as in rendered pictures.
//
//     disk-indicator        |x - c| <= r          c uniform in the square, r in [1/10, 1/2]
//     half-plane-indicator  n . (x - p) <= 0      p uniform in the square, n any direction
//     soft-shadow           the point c + x a + y b of a light is visible from 0 past a card
//
// with all parameters drawn from the seed. The light is a slightly skewed parallelogram at height 2
// above the receiver, with sides of about 1. The card is a randomly rotated rectangle about halfway
// up, which hides 10 to 90 % of the light. A point of the light is visible if the ray from the
// origin to it misses the card; the area is that of the card's clipped projection onto the light.
//
// Shape   2 coordinates; values 0 and 1.
// Promise areas to a few rounding errors.

#include "math/integrands/integrands.hpp"

#include "math/combinatorics/draws.hpp"
#include "math/functions/trigonometry.hpp"
#include "math/geometry/planar_area.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {
namespace {

constexpr Param<std::int64_t> placing_seed{
    .name = "seed", .fallback = 1, .low = 0, .help = "Seed of the random geometry"};

DrawStream draws(const Values& values, std::uint64_t what) {
    constexpr std::uint64_t stream = 0x706c616e6500;  // "plane"
    return DrawStream(Rng(static_cast<std::uint64_t>(values[placing_seed]), stream + what));
}

PlanePair direction(DrawStream& numbers) {
    const auto [cos, sin] = cos_sin_turns(numbers.next());
    return {cos, sin};
}

Integrand disk(std::size_t, const Values& values) {
    DrawStream numbers = draws(values, 0);
    const PlanePair c{numbers.next(), numbers.next()};
    const double r = 0.1 + 0.4 * numbers.next();
    return {[c, rr = r * r](auto x) {
                const double dx = x[0] - c[0];
                const double dy = x[1] - c[1];
                return dx * dx + dy * dy <= rr ? 1.0 : 0.0;
            },
            area_in_disk(unit_square(), c, r)};
}

Integrand half_plane(std::size_t, const Values& values) {
    DrawStream numbers = draws(values, 1);
    const PlanePair p{numbers.next(), numbers.next()};
    const PlanePair n = direction(numbers);
    return {[p, n](auto x) { return n[0] * (x[0] - p[0]) + n[1] * (x[1] - p[1]) <= 0 ? 1.0 : 0.0; },
            signed_area(clipped(unit_square(), p, n))};
}

Vector3 sum(const Vector3& a, double s, const Vector3& b, double t, const Vector3& c) {
    return {a[0] + s * b[0] + t * c[0], a[1] + s * b[1] + t * c[1], a[2] + s * b[2] + t * c[2]};
}

/// A parallelogram, and its intersection with rays from the origin.
struct Parallelogram {
    Vector3 corner, side, other;

    /// Intersects the parallelogram's plane with `ray`. Returns the intersection's coordinates (s,
    /// t) in the parallelogram, and the ray parameter; not finite if ray and plane are parallel.
    [[nodiscard]] Vector3 met_by(const Vector3& ray) const {
        const Vector3 normal = cross(side, other);
        const double far = dot(normal, corner) / dot(normal, ray);
        const Vector3 at = sum({far * ray[0], far * ray[1], far * ray[2]}, -1, corner, 0, corner);
        const double area = dot(normal, normal);
        return {dot(cross(at, other), normal) / area, dot(cross(side, at), normal) / area, far};
    }
};

struct Scene {
    Parallelogram light;
    Parallelogram card;

    [[nodiscard]] bool sees(double x, double y) const {
        const Vector3 to = sum(light.corner, x, light.side, y, light.other);
        const auto [s, t, far] = card.met_by(to);
        return !(s >= 0 && s <= 1 && t >= 0 && t <= 1 && far > 0 && far < 1);
    }

    /// Visible fraction of the light's area.
    [[nodiscard]] double seen() const {
        Polygon shadow;
        for (const auto& [s, t] : unit_square()) {
            const Vector3 at = light.met_by(sum(card.corner, s, card.side, t, card.other));
            shadow.push_back({at[0], at[1]});
        }
        return 1 - shared_area(shadow, unit_square());
    }
};

Scene draw_scene(DrawStream& numbers) {
    const auto about = [&](double x, double reach) { return x + reach * (2 * numbers.next() - 1); };
    Scene scene;
    scene.light = {{about(-0.5, 0.2), about(-0.5, 0.2), 2},
                   {about(1, 0.1), about(0, 0.2), about(0, 0.2)},
                   {about(0, 0.2), about(1, 0.1), about(0, 0.2)}};
    const auto [c, s] = direction(numbers);
    const double length = about(0.6, 0.3);
    const double width = about(0.4, 0.2);
    const Vector3 middle{about(0, 0.4), about(0, 0.4), about(1, 0.3)};
    const Vector3 side{c * length, s * length, about(0, 0.1)};
    const Vector3 other{-s * width, c * width, about(0, 0.1)};
    scene.card = {sum(middle, -0.5, side, -0.5, other), side, other};
    return scene;
}

Integrand soft_shadow(std::size_t, const Values& values) {
    DrawStream numbers = draws(values, 2);
    Scene scene = draw_scene(numbers);
    while (!(scene.seen() >= 0.1 && scene.seen() <= 0.9)) scene = draw_scene(numbers);
    return {[scene](auto x) { return scene.sees(x[0], x[1]) ? 1.0 : 0.0; }, scene.seen()};
}

IntegrandKind planar(std::string name, std::string summary,
                     Integrand (*make)(std::size_t, const Values&)) {
    return {.name = std::move(name),
            .summary = std::move(summary),
            .min_dimension = 2,
            .max_dimension = 2,
            .options = Schema(placing_seed),
            .make = make};
}

}  // namespace

std::vector<IntegrandKind> planar_integrands() {
    return {planar("disk-indicator", "1 in a disk, 0 outside", disk),
            planar("half-plane-indicator", "1 on one side of a line", half_plane),
            planar("soft-shadow", "1 where a light is visible past a card", soft_shadow)};
}

}  // namespace stipple
