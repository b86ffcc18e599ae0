// SPDX-License-Identifier: MIT
#include "math/geometry/polygon_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stipple {
namespace {

struct NamedEdge {
    PlanePoint a;
    PlanePoint b;
    RingEdge name;

    [[nodiscard]] double low() const { return std::min(a.y, b.y); }
    [[nodiscard]] double high() const { return std::max(a.y, b.y); }
};

/// On which side of the line a b the point c is: 1 left, -1 right, 0 on it but for rounding.
int side_of(PlanePoint a, PlanePoint b, PlanePoint c) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double bound = rounding * (std::abs(left) + std::abs(right));
    const double twice = left - right;  // the area
    if (std::abs(twice) <= bound) return 0;
    return twice > 0 ? 1 : -1;
}

bool in_box(const NamedEdge& e, PlanePoint p) {
    return p.x >= std::min(e.a.x, e.b.x) && p.x <= std::max(e.a.x, e.b.x) && p.y >= e.low() &&
           p.y <= e.high();
}

bool boxes_meet(const NamedEdge& e, const NamedEdge& f) {
    return std::max(e.a.x, e.b.x) >= std::min(f.a.x, f.b.x) &&
           std::max(f.a.x, f.b.x) >= std::min(e.a.x, e.b.x) && e.high() >= f.low() &&
           f.high() >= e.low();
}

/// Edges a b and b c: do they go back upon each other?
bool is_spike(PlanePoint a, PlanePoint b, PlanePoint c) {
    const double along = (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y);
    return along > 0 && side_of(a, b, c) == 0;
}

struct Verdict {
    bool meet = false;
    bool cross = false;
};

Verdict compare(const NamedEdge& e, const NamedEdge& f) {
    const int c = side_of(e.a, e.b, f.a);
    const int d = side_of(e.a, e.b, f.b);
    const int a = side_of(f.a, f.b, e.a);
    const int b = side_of(f.a, f.b, e.b);
    if (c * d < 0 && a * b < 0) return {true, true};
    const bool touch = (c == 0 && in_box(e, f.a)) || (d == 0 && in_box(e, f.b)) ||
                       (a == 0 && in_box(f, e.a)) || (b == 0 && in_box(f, e.b));
    return {touch, false};
}

/// As compare(), where edges may follow one another around their ring.
Verdict compare_in_rings(const NamedEdge& e, const NamedEdge& f, const std::vector<Ring>& rings) {
    if (!boxes_meet(e, f)) return {};
    if (e.name.ring != f.name.ring) return compare(e, f);
    const std::size_t n = rings[e.name.ring].size();
    if ((e.name.edge + 1) % n == f.name.edge) return {is_spike(e.a, e.b, f.b), false};
    if ((f.name.edge + 1) % n == e.name.edge) return {is_spike(f.a, f.b, e.b), false};
    return compare(e, f);
}

std::vector<NamedEdge> edges_upwards(const std::vector<Ring>& rings) {
    std::vector<NamedEdge> edges;
    for (std::size_t r = 0; r < rings.size(); ++r)
        for (std::size_t i = 0; i < rings[r].size(); ++i)
            edges.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], {r, i}});
    std::ranges::stable_sort(edges, {}, &NamedEdge::low);
    return edges;
}

}  // namespace

std::optional<Contact> find_contact(const std::vector<Ring>& rings, const RunContext& run) {
    const auto edges = edges_upwards(rings);
    std::vector<const NamedEdge*> open;  // those that reach the row of the edge at hand
    for (const NamedEdge& edge : edges) {
        run.check_stop();
        std::erase_if(open, [&](const NamedEdge* other) { return other->high() < edge.low(); });
        for (const NamedEdge* other : open) {
            const auto [meet, cross] = compare_in_rings(*other, edge, rings);
            if (!meet) continue;
            const auto [first, second] = std::minmax(other->name, edge.name);
            return Contact{first, second, cross};
        }
        open.push_back(&edge);
    }
    return std::nullopt;
}

}  // namespace stipple
