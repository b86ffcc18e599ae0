// SPDX-License-Identifier: MIT
#include "math/neighbors/delaunay.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "math/arithmetic/double_double.hpp"

namespace stipple {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon() / 2;

/// Exact sign of a sum: the terms are converted to non-overlapping ones with the same sum.
template <class Real>
int sign_of_sum(std::span<const Real> terms) {
    std::array<Real, 12> parts{};
    std::size_t count = 0;
    for (Real term : terms) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const Real sum = term + parts[k];
            const Real part = sum - term;
            const Real lost = (term - (sum - part)) + (parts[k] - part);
            if (lost != 0) parts[kept++] = lost;
            term = sum;
        }
        if (term != 0 || kept == 0) parts[kept++] = term;
        count = kept;
    }
    const Real largest = parts[count - 1];
    return largest > 0 ? 1 : largest < 0 ? -1 : 0;
}

template <class Real>
int exact_side(const double* a, const double* b, const double* c) {
    std::array<Real, 12> terms{};
    std::size_t count = 0;
    const auto add = [&](double x, double y) {
        const Real product = Real{x} * y;
        terms[count++] = product;
        terms[count++] = std::fma(Real{x}, Real{y}, -product);
    };
    add(a[0], b[1]);
    add(-a[1], b[0]);
    add(b[0], c[1]);
    add(-b[1], c[0]);
    add(c[0], a[1]);
    add(-c[1], a[0]);
    return sign_of_sum<Real>(terms);
}

/// True if products of the coordinates neither overflow nor lose digits by underflow.
bool multiply_exactly(std::initializer_list<const double*> places) {
    return std::ranges::all_of(places, [](const double* place) {
        return std::all_of(place, place + 2, [](double x) {
            return x == 0 || (std::abs(x) > 0x1p-400 && std::abs(x) < 0x1p400);
        });
    });
}

/// In-circle determinant, positive inside the circle, in numbers of type Real.
template <class Real>
struct InCircle {
    Real sum;
    double size;  ///< sum of absolute values of the terms

    /// @param difference difference(x, y) returns x - y as a Real
    template <class Difference>
    InCircle(const double* a, const double* b, const double* c, const double* d,
             const Difference& difference) {
        const Real ax = difference(a[0], d[0]), ay = difference(a[1], d[1]);
        const Real bx = difference(b[0], d[0]), by = difference(b[1], d[1]);
        const Real cx = difference(c[0], d[0]), cy = difference(c[1], d[1]);
        const auto part = [this](Real length, Real left, Real right) {
            size += to_double(length) * (std::abs(to_double(left)) + std::abs(to_double(right)));
            return length * (left + minus(right));
        };
        size = 0;
        sum = part(ax * ax + ay * ay, bx * cy, cx * by) + part(bx * bx + by * by, cx * ay, ax * cy);
        sum = sum + part(cx * cx + cy * cy, ax * by, bx * ay);
    }

    static double to_double(double x) { return x; }
    static double to_double(const DoubleDouble& x) { return x.high; }
    static double minus(double x) { return -x; }
    static DoubleDouble minus(const DoubleDouble& x) { return {-x.high, -x.low}; }
};

/// True if d is certainly inside the circle through a, b, c, which are in counterclockwise order.
bool surely_inside(const double* a, const double* b, const double* c, const double* d) {
    constexpr double least = 0x1p-900;  // smaller numbers may have lost digits
    const InCircle<double> quick(a, b, c, d, [](double x, double y) { return x - y; });
    if (quick.size > least && std::abs(quick.sum) > 12 * ulp * quick.size) return quick.sum > 0;
    const InCircle<DoubleDouble> good(a, b, c, d,
                                      [](double x, double y) { return exact_sum(x, -y); });
    return good.size > least && good.sum.high > 0x1p-96 * good.size;
}

/// Position on a Hilbert curve through 2^32 x 2^32 cells.
std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y) {
    std::uint64_t key = 0;
    for (std::uint32_t s = 1U << 31U; s > 0; s >>= 1U) {
        const bool right = (x & s) != 0;
        const bool up = (y & s) != 0;
        key = key << 2U | (right ? (up ? 2U : 3U) : (up ? 1U : 0U));
        if (!up) {
            if (right) {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return key;
}

struct Turn {
    std::uint32_t round;  ///< each round has about twice as many points as the one before
    std::uint64_t key;
    std::uint32_t point;
    auto operator<=>(const Turn&) const = default;
};

/// Points in their order of insertion.
std::vector<Turn> turns_of(std::span<const double> rows, const RunContext& run) {
    auto check_at_times = [&run, steps = std::uint64_t{0}]() mutable {
        if (++steps % 0x10000 == 0) run.check_stop();
    };
    std::array<double, 2> low = {rows[0], rows[1]};
    double size = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) low[i % 2] = std::min(low[i % 2], rows[i]);
    for (std::size_t i = 0; i < rows.size(); ++i) size = std::max(size, rows[i] - low[i % 2]);
    const auto cell = [&](double x, double from) {
        return size > 0 ? static_cast<std::uint32_t>((x - from) / size * 0xffff'ffff) : 0;
    };
    std::vector<Turn> turns(rows.size() / 2);
    for (std::size_t i = 0; i < turns.size(); ++i) {
        check_at_times();
        // The bits of a multiple of the golden ratio serve as a random number.
        const std::uint64_t random = (i + 1) * 0x9e3779b97f4a7c15U;
        turns[i] = {64U - static_cast<std::uint32_t>(std::countl_zero(random)),
                    hilbert_key(cell(rows[2 * i], low[0]), cell(rows[2 * i + 1], low[1])),
                    static_cast<std::uint32_t>(i)};
    }
    std::ranges::sort(turns, [&](const Turn& a, const Turn& b) {
        check_at_times();
        return a < b;
    });
    return turns;
}

}  // namespace

int side_of_line(const double* a, const double* b, const double* c) {
    const double left = (a[0] - c[0]) * (b[1] - c[1]);
    const double right = (a[1] - c[1]) * (b[0] - c[0]);
    const double area = left - right;
    const double bound =
        4 * ulp * (std::abs(left) + std::abs(right)) + std::numeric_limits<double>::min();
    if (area > bound) return 1;
    if (area < -bound) return -1;
    // long double covers the exponents of all products of doubles, but is slower.
    return multiply_exactly({a, b, c}) ? exact_side<double>(a, b, c)
                                       : exact_side<long double>(a, b, c);
}

Delaunay::Delaunay(std::span<const double> rows, const RunContext& run) {
    start(rows);
    std::uint64_t done = 0;
    for (const Turn& turn : turns_of(rows, run)) {
        if (done % 64 == 0) run.tick(done, rows.size() / 2);
        ++done;
        insert(turn.point + outer);
    }
}

/// Starts with two triangles of a square so distant that its corners are never nearest.
void Delaunay::start(std::span<const double> rows) {
    double reach = 0;
    for (const double x : rows) reach = std::max(reach, std::abs(x));
    reach = 64 * std::max(reach, std::numeric_limits<double>::min());
    places_ = {-reach, -reach, reach, -reach, reach, reach, -reach, reach};
    places_.insert(places_.end(), rows.begin(), rows.end());
    triangle_of_.assign(places_.size() / 2, none);
    triangles_.reserve(rows.size() + 2);
    triangles_.resize(2);
    set(0, {{0, 1, 2}, {none, 1, none}});
    set(1, {{0, 2, 3}, {none, none, 0}});
}

void Delaunay::set(std::uint32_t t, const Triangle& triangle) {
    triangles_[t] = triangle;
    for (const std::uint32_t corner : triangle.corners) triangle_of_[corner] = t;
}

void Delaunay::relink(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    if (t == none) return;
    for (std::uint32_t& across : triangles_[t].across)
        if (across == from) {
            across = to;
            return;
        }
}

/// Finds the triangle that contains a position, walking from the last one.
/// @param on_edge set to the corner opposite to an edge that contains the position; 3 if none does
std::uint32_t Delaunay::locate(const double* place, std::size_t& on_edge) const {
    std::uint32_t t = last_;
    for (std::size_t turn = 0;; turn = after(turn)) {
        const Triangle& triangle = triangles_[t];
        bool found = true;
        on_edge = 3;
        for (std::size_t i = 0, k = turn; i < 3 && found; ++i, k = after(k)) {
            const int side = side_of_line(at(triangle.corners[after(k)]),
                                          at(triangle.corners[before(k)]), place);
            if (side == 0) on_edge = k;
            if (side >= 0) continue;
            t = triangle.across[k];
            found = false;
        }
        if (found) return t;
    }
}

void Delaunay::insert(std::uint32_t point) {
    std::size_t on_edge = 3;
    const std::uint32_t t = locate(at(point), on_edge);
    for (const std::uint32_t corner : triangles_[t].corners)
        if (at(corner)[0] == at(point)[0] && at(corner)[1] == at(point)[1]) return;
    if (on_edge == 3)
        split_triangle(t, point);
    else
        split_edge(t, on_edge, point);
    make_delaunay(point);
    last_ = triangle_of_[point];
}

void Delaunay::split_triangle(std::uint32_t t, std::uint32_t point) {
    const auto [corners, across] = triangles_[t];
    const auto u = static_cast<std::uint32_t>(triangles_.size());
    triangles_.resize(u + 2);
    set(t, {{corners[0], corners[1], point}, {u, u + 1, across[2]}});
    set(u, {{corners[1], corners[2], point}, {u + 1, t, across[0]}});
    set(u + 1, {{corners[2], corners[0], point}, {t, u, across[1]}});
    relink(across[0], t, u);
    relink(across[1], t, u + 1);
    unsure_ = {t, u, u + 1};
}

/// Splits two triangles into four by a point on the edge opposite to corner k.
void Delaunay::split_edge(std::uint32_t t, std::size_t k, std::uint32_t point) {
    const auto [corners, across] = triangles_[t];
    const std::uint32_t s = across[k];
    const auto [corners_s, across_s] = triangles_[s];
    const std::uint32_t a = corners[k];
    const std::uint32_t b = corners[after(k)];
    const std::uint32_t c = corners[before(k)];
    const std::size_t m = 3 - corner_of(triangles_[s], b) - corner_of(triangles_[s], c);
    const std::uint32_t d = corners_s[m];
    const auto u = static_cast<std::uint32_t>(triangles_.size());
    triangles_.resize(u + 2);
    const std::uint32_t beyond_ca = across[after(k)];
    const std::uint32_t beyond_ab = across[before(k)];
    const std::uint32_t beyond_bd = across_s[after(m)];  // s has the corners d, c, b
    const std::uint32_t beyond_dc = across_s[before(m)];
    set(t, {{a, b, point}, {s, u, beyond_ab}});
    set(s, {{b, d, point}, {u + 1, t, beyond_bd}});
    set(u, {{c, a, point}, {t, u + 1, beyond_ca}});
    set(u + 1, {{d, c, point}, {u, s, beyond_dc}});
    relink(beyond_ca, t, u);
    relink(beyond_dc, s, u + 1);
    unsure_ = {t, s, u, u + 1};
}

/// Flips edges opposite to the new point until all are Delaunay.
void Delaunay::make_delaunay(std::uint32_t point) {
    while (!unsure_.empty()) {
        const std::uint32_t t = unsure_.back();
        unsure_.pop_back();
        const std::size_t k = corner_of(triangles_[t], point);
        const std::uint32_t s = triangles_[t].across[k];
        if (s == none) continue;
        const auto [corners, across] = triangles_[t];
        const auto [corners_s, across_s] = triangles_[s];
        const std::uint32_t b = corners[after(k)];
        const std::uint32_t c = corners[before(k)];
        const std::size_t m = 3 - corner_of(triangles_[s], b) - corner_of(triangles_[s], c);
        const std::uint32_t d = corners_s[m];
        if (!surely_inside(at(point), at(b), at(c), at(d))) continue;
        const std::uint32_t beyond_ca = across[after(k)];
        const std::uint32_t beyond_bd = across_s[after(m)];  // s has the corners d, c, b
        set(t, {{point, b, d}, {beyond_bd, s, across[before(k)]}});
        set(s, {{point, d, c}, {across_s[before(m)], beyond_ca, t}});
        relink(beyond_bd, s, t);
        relink(beyond_ca, t, s);
        unsure_.push_back(t);
        unsure_.push_back(s);
    }
}

}  // namespace stipple
