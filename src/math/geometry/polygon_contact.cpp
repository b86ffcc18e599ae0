// SPDX-License-Identifier: MIT
#include "math/geometry/polygon_contact.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "math/geometry/orientation.hpp"

namespace stipple {
namespace {

/// Returns 1 if c is left of the line a b, -1 if right, 0 if on it within rounding.
int side_of(PlanePoint a, PlanePoint b, PlanePoint c) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double bound = rounding * (std::abs(left) + std::abs(right));
    const double twice = left - right;  // twice the area of the triangle
    if (std::abs(twice) <= bound) return 0;
    return twice > 0 ? 1 : -1;
}

bool in_box(const RingSegment& e, PlanePoint p) {
    return p.x >= std::min(e.a.x, e.b.x) && p.x <= std::max(e.a.x, e.b.x) &&
           p.y >= std::min(e.a.y, e.b.y) && p.y <= std::max(e.a.y, e.b.y);
}

/// True if the edge b c runs back along the edge a b.
bool is_spike(PlanePoint a, PlanePoint b, PlanePoint c) {
    const double along = (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y);
    return along > 0 && side_of(a, b, c) == 0;
}

/// A vertex of one ring on an edge of another ring.
struct Touch {
    std::size_t segment;
    PlanePoint at;
    std::size_t by;  ///< a segment with this vertex as its end
};

Contact contact_between(const RingEdge& e, const RingEdge& f, bool crossing) {
    return e < f ? Contact{e, f, crossing} : Contact{f, e, crossing};
}

/// One sweep over all edges by rows: finds the first forbidden contact, and the touches at which
/// edges must be cut.
class ContactSweep {
  public:
    ContactSweep(const std::vector<Ring>& rings, const std::vector<RingSegment>& segments)
        : rings_(rings), segments_(segments) {
        for (const RingSegment& s : segments) edges_.push_back(upward(s.a, s.b));
    }

    void sweep(const RunContext& run) {
        std::vector<std::pair<PlanePoint, std::size_t>> starts;
        std::vector<std::pair<PlanePoint, std::size_t>> ends;
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            starts.emplace_back(edges_[i].low, i);
            ends.emplace_back(edges_[i].high, i);
        }
        const auto by_rows = [](const auto& p, const auto& q) {
            return p.first == q.first ? p.second < q.second : is_before(p.first, q.first);
        };
        std::ranges::sort(starts, by_rows);
        std::ranges::sort(ends, by_rows);
        const auto to_right = [this](std::size_t i, std::size_t j) { return is_left_of(i, j); };
        std::set<std::size_t, decltype(to_right)> open(to_right);
        std::vector<decltype(open.begin())> place(edges_.size());
        auto next = starts.begin();
        for (std::size_t k = 0; k < ends.size(); ++k) {
            if (k % 4096 == 0) run.check_stop();
            for (; next != starts.end() && is_before(next->first, ends[k].first); ++next) {
                const auto here = place[next->second] = open.insert(next->second).first;
                if (here != open.begin()) compare(*std::prev(here), *here);
                if (std::next(here) != open.end()) compare(*here, *std::next(here));
            }
            const auto gone = open.erase(place[ends[k].second]);
            if (gone != open.begin() && gone != open.end()) compare(*std::prev(gone), *gone);
            if (contact) return;
        }
    }

    Contact contact_of(const Touch& touch) const {
        return contact_between(segments_[touch.segment].name, segments_[touch.by].name, false);
    }

    std::optional<Contact> contact;
    std::vector<Touch> touches;

  private:
    bool is_left_of(std::size_t i, std::size_t j) const {
        const int side = i == j ? 0 : side_of_edge(edges_[j], edges_[i]);
        return side != 0 ? side > 0 : i < j;
    }

    void refuse(std::size_t i, std::size_t j, bool crossing) {
        if (!contact) contact = contact_between(segments_[i].name, segments_[j].name, crossing);
    }

    /// True if the edges are neighbours in their ring, or are both parts of one edge.
    bool are_neighbors(const RingEdge& e, const RingEdge& f) const {
        if (e.ring != f.ring) return false;
        const std::size_t n = rings_[e.ring].size();
        return e.edge == f.edge || (e.edge + 1) % n == f.edge || (f.edge + 1) % n == e.edge;
    }

    void compare(std::size_t i, std::size_t j) {
        const RingSegment& e = segments_[i];
        const RingSegment& f = segments_[j];
        for (const auto& [p, q] : {std::pair{e.a, e.b}, {e.b, e.a}})
            for (const auto& [r, s] : {std::pair{f.a, f.b}, {f.b, f.a}}) {
                if (p != r) continue;
                const bool strange = e.name.ring == f.name.ring && !are_neighbors(e.name, f.name);
                if (strange || is_spike(q, p, s)) refuse(i, j, false);
                return;
            }
        const int c = side_of(e.a, e.b, f.a);
        const int d = side_of(e.a, e.b, f.b);
        const int a = side_of(f.a, f.b, e.a);
        const int b = side_of(f.a, f.b, e.b);
        if (c * d < 0 && a * b < 0) return refuse(i, j, true);
        std::vector<Touch> found;
        if (c == 0 && in_box(e, f.a)) found.push_back({i, f.a, j});
        if (d == 0 && in_box(e, f.b)) found.push_back({i, f.b, j});
        if (a == 0 && in_box(f, e.a)) found.push_back({j, e.a, i});
        if (b == 0 && in_box(f, e.b)) found.push_back({j, e.b, i});
        if (found.size() > 1 || (found.size() == 1 && e.name.ring == f.name.ring))
            return refuse(i, j, false);
        touches.insert(touches.end(), found.begin(), found.end());
    }

    const std::vector<Ring>& rings_;
    const std::vector<RingSegment>& segments_;
    std::vector<UpwardEdge> edges_;
};

/// Cuts segments at the vertices that touch them.
void cut_at(std::vector<RingSegment>& segments, std::vector<Touch> touches) {
    const auto along = [&](const Touch& t) {
        const RingSegment& s = segments[t.segment];
        return std::abs(t.at.x - s.a.x) + std::abs(t.at.y - s.a.y);
    };
    std::ranges::sort(touches, [&](const Touch& t, const Touch& u) {
        return t.segment != u.segment ? t.segment < u.segment : along(t) < along(u);
    });
    std::vector<std::pair<std::size_t, PlanePoint>> ends;
    for (const Touch& t : touches)
        if (ends.empty() || ends.back() != std::pair{t.segment, t.at})
            ends.emplace_back(t.segment, t.at);
    for (auto first = ends.begin(); first != ends.end();) {
        const std::size_t whole = first->first;
        const RingSegment before = segments[whole];
        PlanePoint from = before.a;
        for (; first != ends.end() && first->first == whole; ++first) {
            segments.push_back({from, first->second, before.name});
            from = first->second;
        }
        segments[whole].a = from;
    }
}

/// A segment directed away from its end `at`, a vertex shared with other segments.
struct Arm {
    PlanePoint at;
    PlanePoint away;
    RingEdge name;
};

/// Order of directions, counterclockwise from the right.
bool turns_before(const Arm& a, const Arm& b) {
    const bool up_a = is_before(a.at, a.away);
    const bool up_b = is_before(b.at, b.away);
    return up_a != up_b ? up_a : orientation(a.at, a.away, b.away) > 0;
}

/// Returns a contact if rings cross in the arms' vertex, or if a ring passes it twice; or nullopt.
std::optional<Contact> crossing_among(std::span<Arm> arms) {
    std::ranges::sort(arms, {}, &Arm::name);
    for (std::size_t i = 2; i < arms.size(); ++i)
        if (arms[i].name.ring == arms[i - 2].name.ring)
            return contact_between(arms[i - 2].name, arms[i].name, false);
    std::ranges::sort(arms, turns_before);
    std::vector<const Arm*> open;
    std::set<std::size_t> seen;
    for (const Arm& arm : arms) {
        if (!open.empty() && open.back()->name.ring == arm.name.ring) {
            open.pop_back();
        } else if (seen.insert(arm.name.ring).second) {
            open.push_back(&arm);
        } else {
            return contact_between(open.back()->name, arm.name, true);
        }
    }
    return std::nullopt;
}

std::optional<Contact> crossing_in_vertex(const std::vector<RingSegment>& segments) {
    std::vector<Arm> arms;
    for (const RingSegment& s : segments) {
        arms.push_back({s.a, s.b, s.name});
        arms.push_back({s.b, s.a, s.name});
    }
    std::ranges::sort(arms, is_before, &Arm::at);
    for (auto first = arms.begin(); first != arms.end();) {
        const auto last =
            std::find_if(first, arms.end(), [&](const Arm& arm) { return arm.at != first->at; });
        if (last - first > 2)
            if (const auto contact = crossing_among({first, last})) return contact;
        first = last;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Contact> find_contact(const std::vector<Ring>& rings, const RunContext& run,
                                    std::vector<RingSegment>* segments) {
    std::vector<RingSegment> parts;
    for (std::size_t r = 0; r < rings.size(); ++r)
        for (std::size_t i = 0; i < rings[r].size(); ++i)
            parts.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], {r, i}});
    constexpr int most_passes = 16;  // rounding could create new touches forever
    for (int pass = 0;; ++pass) {
        if (const auto contact = crossing_in_vertex(parts)) return contact;
        ContactSweep sweep(rings, parts);
        sweep.sweep(run);
        if (sweep.contact) return sweep.contact;
        if (sweep.touches.empty()) {
            if (segments) *segments = std::move(parts);
            return std::nullopt;
        }
        if (pass == most_passes) return sweep.contact_of(sweep.touches.front());
        cut_at(parts, std::move(sweep.touches));
    }
}

}  // namespace stipple
