// SPDX-License-Identifier: MIT
#include "math/geometry/torus_packing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/machine/int128.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

struct Vector {
    std::int64_t x;
    std::int64_t y;
};

struct Bezout {
    std::int64_t divisor;
    std::int64_t s;
    std::int64_t t;
};

/// Coefficients with s a + t b = divisor, the greatest common divisor of a, b >= 0.
Bezout bezout(std::int64_t a, std::int64_t b) {
    Bezout now{a, 1, 0};
    Bezout next{b, 0, 1};
    while (next.divisor != 0) {
        const std::int64_t q = now.divisor / next.divisor;
        now = {now.divisor - q * next.divisor, now.s - q * next.s, now.t - q * next.t};
        std::swap(now, next);
    }
    return now;
}

constexpr Int128 modulo(Int128 a, Int128 m) { return (a % m + m) % m; }

/// Returns the v with u x v = n whose component along u is closest to u / 2 or -u / 2, or nullopt.
std::optional<Vector> partner(Vector u, std::int64_t n) {
    const Bezout unit = bezout(u.x, u.y);
    const std::int64_t g = unit.divisor;
    if (n % g != 0) return std::nullopt;
    const Int128 vx = -Int128{unit.t} * (n / g);
    const Int128 vy = Int128{unit.s} * (n / g);
    const Int128 norm = Int128{u.x} * u.x + Int128{u.y} * u.y;
    const Int128 along = vx * u.x + vy * u.y;
    const Int128 step = norm / g;  // change of `along` if u / g is added to v
    const Int128 upper = norm / 2 - modulo(norm / 2 - along, step);
    const Int128 lower = -(norm / 2) + modulo(norm / 2 + along, step);
    const Int128 turns = ((upper >= -lower ? upper : lower) - along) / step;
    return Vector{static_cast<std::int64_t>(vx + turns * (u.x / g)),
                  static_cast<std::int64_t>(vy + turns * (u.y / g))};
}

std::uint64_t norm(Vector v) {
    return static_cast<std::uint64_t>(v.x * v.x) + static_cast<std::uint64_t>(v.y * v.y);
}

struct Basis {
    Vector u;
    Vector v;
};

/// Basis with |v| >= |u| and the longest u, low <= |u|^2 <= high; tries only 0 <= u.y <= u.x.
std::optional<Basis> best_within(std::uint64_t low, std::uint64_t high, std::int64_t n) {
    std::optional<Basis> best;
    for (std::uint64_t a = floor_root(high, 2); 2 * a * a >= low; --a) {
        std::uint64_t b = std::min(a, a * a == high ? 0 : floor_root(high - a * a, 2));
        for (;; --b) {
            const Vector u{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)};
            if (norm(u) < low || (best && norm(u) <= norm(best->u))) break;
            const auto v = partner(u, n);
            if (v && norm(*v) >= norm(u)) best = Basis{u, *v};
            if (b == 0) break;
        }
    }
    return best;
}

/// Describes the lattice by rows of equal y.
TorusPacking rows_of(const Basis& basis, std::int64_t n) {
    const auto [u, v] = basis;
    const Bezout unit = bezout(std::abs(u.y), std::abs(v.y));
    const std::int64_t s = u.y < 0 ? -unit.s : unit.s;
    const std::int64_t t = v.y < 0 ? -unit.t : unit.t;
    const Int128 shift = modulo(Int128{s} * u.x + Int128{t} * v.x, n / unit.divisor);
    return {.row_points = static_cast<std::uint64_t>(unit.divisor),
            .shift = static_cast<std::uint64_t>(shift),
            .shortest = norm(u)};
}

/// Lengths of integer vectors on a rectangle.
struct Metric {
    double x2;  ///< squared length of the vector (1, 0)
    double y2;

    double dot(Vector a, Vector b) const {
        return x2 * static_cast<double>(a.x) * static_cast<double>(b.x) +
               y2 * static_cast<double>(a.y) * static_cast<double>(b.y);
    }
    double norm(Vector v) const { return dot(v, v); }
};

/// Like partner(u, n), with lengths by `metric`.
std::optional<Vector> partner(Vector u, std::int64_t n, const Metric& metric) {
    const Bezout unit = bezout(u.x, u.y);
    const std::int64_t g = unit.divisor;
    if (n % g != 0) return std::nullopt;
    // Some v with u x v = n, made small by subtracting multiples of u / g (u x v stays n).
    const Int128 far_x = -Int128{unit.t} * (n / g);
    const Int128 far_y = Int128{unit.s} * (n / g);
    const Int128 turns = u.x > u.y ? far_x / (u.x / g) : far_y / (u.y / g);
    const Vector v{static_cast<std::int64_t>(far_x - turns * (u.x / g)),
                   static_cast<std::int64_t>(far_y - turns * (u.y / g))};
    const double half = metric.norm(u) / 2;
    const double step = metric.norm(u) / static_cast<double>(g);
    constexpr double rounding = 1e-9;  // in steps; keeps a component of exactly u / 2
    const double along = metric.dot(u, v);
    const auto up = static_cast<std::int64_t>(std::floor((half - along) / step + rounding));
    const auto down = static_cast<std::int64_t>(std::ceil((-half - along) / step - rounding));
    const auto moved = [&](std::int64_t t) {
        return Vector{v.x + t * (u.x / g), v.y + t * (u.y / g)};
    };
    const bool above = metric.dot(u, moved(up)) >= -metric.dot(u, moved(down));
    return moved(above ? up : down);
}

/// Basis with |v| >= |u| and the longest u, low <= |u|^2 <= high; tries only u.x, u.y >= 0.
std::optional<Basis> best_within(double low, double high, std::int64_t n, const Metric& metric) {
    std::optional<Basis> best;
    const auto last = static_cast<std::int64_t>(std::sqrt(high / metric.x2));
    for (std::int64_t a = 0; a <= last; ++a) {
        const double part = metric.x2 * static_cast<double>(a) * static_cast<double>(a);
        auto b = static_cast<std::int64_t>(std::sqrt(std::max(0.0, high - part) / metric.y2));
        for (; b >= 0; --b) {
            const Vector u{a, b};
            const double norm = metric.norm(u);
            if (norm < low || norm == 0 || (best && norm <= metric.norm(best->u))) break;
            const auto v = partner(u, n, metric);
            if (v && metric.norm(*v) >= norm * (1 - 1e-12)) best = Basis{u, *v};
        }
    }
    return best;
}

}  // namespace

TorusPacking densest_torus_packing(std::uint64_t n, double ratio) {
    const bool wide = ratio >= 1;  // if false, x and y are exchanged
    const Metric metric{wide ? ratio : 1 / ratio, wide ? 1 / ratio : ratio};
    const auto count = static_cast<double>(n);
    const double width = 4 * std::sqrt(count);
    double high = 1.1547005383792517 * count;  // 2 n / sqrt(3)
    std::optional<Basis> basis;
    while (!basis) {
        const double low = high > width ? high - width : 0;
        basis = best_within(low, high, static_cast<std::int64_t>(n), metric);
        high = low;
    }
    if (!wide)
        for (Vector* v : {&basis->u, &basis->v}) std::swap(v->x, v->y);
    TorusPacking packing = rows_of(*basis, static_cast<std::int64_t>(n));
    packing.shortest = 0;
    return packing;
}

TorusPacking densest_torus_packing(std::uint64_t n) {
    // Computes floor(2 n / sqrt(3)), the largest h with 3 h^2 <= 4 n^2.
    auto high = static_cast<std::uint64_t>(1.1547005383792515 * static_cast<double>(n));
    while (Wide{3} * (high + 1) * (high + 1) <= Wide{4} * n * n) ++high;
    while (Wide{3} * high * high > Wide{4} * n * n) --high;
    // Each range [low, high] of |u|^2 is expected to contain that of some lattice. The search ends
    // at the latest at u = (1, 0), the shortest vector of some lattice.
    const std::uint64_t width = 4 * floor_root(n, 2);
    for (;;) {
        const std::uint64_t low = high > width ? high - width : 1;
        if (const auto basis = best_within(low, high, static_cast<std::int64_t>(n)))
            return rows_of(*basis, static_cast<std::int64_t>(n));
        high = low - 1;
    }
}

}  // namespace stipple
