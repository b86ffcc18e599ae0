// SPDX-License-Identifier: MIT
#include "math/geometry/torus_packing.hpp"

#include <algorithm>
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

/// s a + t b = divisor, the greatest common one; a, b >= 0.
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

/// The v with u x v = n that is nearest to half of u, or minus that, along u; none if there is no
/// v.
std::optional<Vector> partner(Vector u, std::int64_t n) {
    const Bezout unit = bezout(u.x, u.y);
    const std::int64_t g = unit.divisor;
    if (n % g != 0) return std::nullopt;
    const Int128 vx = -Int128{unit.t} * (n / g);
    const Int128 vy = Int128{unit.s} * (n / g);
    const Int128 norm = Int128{u.x} * u.x + Int128{u.y} * u.y;
    const Int128 along = vx * u.x + vy * u.y;
    const Int128 step = norm / g;  // of `along`, when u / g is added to v
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

/// The best basis with low <= |u|^2 <= high, 0 <= u.y <= u.x: symmetries of the torus give others.
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

/// The lattice in rows of equal y.
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

}  // namespace

TorusPacking densest_torus_packing(std::uint64_t n) {
    // floor(2 n / sqrt(3)): the largest h with 3 h^2 <= 4 n^2.
    auto high = static_cast<std::uint64_t>(1.1547005383792515 * static_cast<double>(n));
    while (Wide{3} * (high + 1) * (high + 1) <= Wide{4} * n * n) ++high;
    while (Wide{3} * high * high > Wide{4} * n * n) --high;
    // In a shell of this width a lattice is expected; (1, 0) is the shortest u of some.
    const std::uint64_t width = 4 * floor_root(n, 2);
    for (;;) {
        const std::uint64_t low = high > width ? high - width : 1;
        if (const auto basis = best_within(low, high, static_cast<std::int64_t>(n)))
            return rows_of(*basis, static_cast<std::int64_t>(n));
        high = low - 1;
    }
}

}  // namespace stipple
