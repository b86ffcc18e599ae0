// SPDX-License-Identifier: MIT
#include "math/neighbors/periodic_voronoi.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "core/machine/first_touch.hpp"

namespace stipple {
namespace {

double dot(const Vec2& a, const Vec2& b) { return a.x * b.x + a.y * b.y; }
double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Distance of x from the interval [low, low + size].
double gap(double x, double low, double size) { return std::max({low - x, x - (low + size), 0.0}); }

/// Whether b is no corner of the hull: no left turn from a via b to next, up to rounding.
bool is_hidden(const Vec2& a, const Vec2& b, const Vec2& next) {
    constexpr double ulps = 0x1p-50;
    const Vec2 to{b.x - a.x, b.y - a.y};
    const Vec2 on{next.x - b.x, next.y - b.y};
    const auto size = [](const Vec2& v) { return std::abs(v.x) + std::abs(v.y); };
    const double rounding = (size(a) + size(b)) * size(on) + size(to) * (size(b) + size(next));
    return cross(to, on) <= ulps * rounding;
}

}  // namespace

Vec2 VoronoiCell::farthest_corner() const {
    const auto far = std::ranges::max_element(
        corners_, {}, [](const CellCorner& corner) { return dot(corner.at, corner.at); });
    return far->at;
}

CellMoments VoronoiCell::moments() const {
    CellMoments sum;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
        const Vec2& a = corners_[k].at;
        const Vec2& b = corners_[k + 1 < corners_.size() ? k + 1 : 0].at;
        const double twice = cross(a, b);
        sum.mass += twice / 2;
        sum.first.x += twice * (a.x + b.x) / 6;
        sum.first.y += twice * (a.y + b.y) / 6;
        sum.second += twice * (dot(a, a) + dot(a, b) + dot(b, b)) / 12;
    }
    return sum;
}

void VoronoiCell::measure_reach() {
    squared_reach_ = 0;
    for (const CellCorner& corner : corners_)
        squared_reach_ = std::max(squared_reach_, dot(corner.at, corner.at));
}

void VoronoiCell::start(const std::array<CellCorner, 4>& corners) {
    corners_.assign(corners.begin(), corners.end());
    measure_reach();
}

void VoronoiCell::cut(const Vec2& neighbor, double bound, std::uint32_t site) {
    const std::size_t n = corners_.size();
    beyond_.resize(n);
    std::size_t most = 0;
    for (std::size_t k = 0; k < n; ++k) {
        beyond_[k] = dot(corners_[k].at, neighbor) - bound;
        if (beyond_[k] > beyond_[most]) most = k;
    }
    if (n == 0 || !(beyond_[most] > 0)) return;

    // Cuts off the corners `first` to `last`: `most` and those next to it that are also beyond.
    const auto after = [n](std::size_t k) { return k + 1 < n ? k + 1 : 0; };
    const auto before = [n](std::size_t k) { return k > 0 ? k - 1 : n - 1; };
    std::size_t first = most;
    std::size_t last = most;
    while (beyond_[before(first)] > 0 && before(first) != most) first = before(first);
    while (beyond_[after(last)] > 0 && after(last) != most) last = after(last);
    if (beyond_[before(first)] > 0) return clear();

    const auto crossing = [&](std::size_t in, std::size_t out) {
        const double t = beyond_[in] / (beyond_[in] - beyond_[out]);
        const Vec2& a = corners_[in].at;
        const Vec2& b = corners_[out].at;
        return Vec2{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    };
    spare_.clear();
    for (std::size_t k = after(last);; k = after(k)) {
        spare_.push_back(corners_[k]);
        if (k == before(first)) break;
    }
    spare_.push_back({crossing(before(first), first), neighbor, site});
    spare_.push_back({crossing(after(last), last), corners_[last].neighbor, corners_[last].site});
    corners_.swap(spare_);
    measure_reach();
}

/// Uses duality: the plane x . v <= |v|^2 / 2 corresponds to the point 2 v / |v|^2. The planes of
/// the cell's edges correspond to the corners of the convex hull of these points.
void VoronoiCell::enclose(std::vector<CellCorner>& planes) {
    for (CellCorner& plane : planes) {
        const double half = dot(plane.neighbor, plane.neighbor) / 2;
        plane.at = {plane.neighbor.x / half, plane.neighbor.y / half};
    }
    const auto lower = [](const Vec2& v) { return v.y < 0 || (v.y == 0 && v.x < 0); };
    std::ranges::sort(planes, [&](const CellCorner& a, const CellCorner& b) {
        if (lower(a.at) != lower(b.at)) return lower(b.at);
        return cross(a.at, b.at) > 0;
    });
    // The nearest plane always has an edge.
    const auto nearest = std::ranges::max_element(
        planes, {}, [](const CellCorner& plane) { return dot(plane.at, plane.at); });
    std::rotate(planes.begin(), nearest, planes.end());
    spare_.clear();
    const auto drop_hidden_before = [&](const Vec2& next) {
        while (spare_.size() > 1 && is_hidden(spare_[spare_.size() - 2].at, spare_.back().at, next))
            spare_.pop_back();
    };
    for (const CellCorner& plane : planes) {
        drop_hidden_before(plane.at);
        spare_.push_back(plane);
    }
    drop_hidden_before(planes.front().at);
    corners_.clear();
    for (std::size_t k = 0; k < spare_.size(); ++k) {
        const Vec2& a = spare_[k > 0 ? k - 1 : spare_.size() - 1].at;
        const Vec2& b = spare_[k].at;
        // Rounding errors of `along` move the corner along the line of a's plane, not off it.
        const Vec2 to{b.x - a.x, b.y - a.y};
        const bool alike = dot(to, to) < dot(b, b);  // cross(a, to) is then more precise
        const double along = -dot(a, to) / cross(a, alike ? to : b);
        const double squared = dot(a, a);
        corners_.push_back({{(a.x - along * a.y) / squared, (a.y + along * a.x) / squared},
                            spare_[k].neighbor,
                            spare_[k].site});
    }
    measure_reach();
}

PeriodicVoronoi::PeriodicVoronoi(Vec2 sides, bool torus, std::size_t expected, bool uneven,
                                 const RunContext& run)
    : sides_(sides), torus_(torus) {
    grow(sites_, expected, run);
    // Grid cells of such a size that the ring of cells around a site's own cell contains most of
    // the site's neighbours, and few other sites.
    const double sites_a_cell = uneven ? 0.5 : 2;
    const double cells = std::max(1.0, static_cast<double>(expected) / sites_a_cell);
    const double size = std::sqrt(sides.x * sides.y / cells);
    const auto along = [&](double side) {
        return static_cast<std::int64_t>(std::clamp(side / size, 1.0, 2 * cells));
    };
    columns_ = along(sides.x);
    rows_ = along(sides.y);
    size_ = {sides.x / static_cast<double>(columns_), sides.y / static_cast<double>(rows_)};
    heads_.assign(static_cast<std::size_t>(columns_ * rows_), none);
}

PeriodicVoronoi::PeriodicVoronoi(Vec2 sides, bool torus, std::span<const double> rows, bool uneven,
                                 const RunContext& run)
    : PeriodicVoronoi(sides, torus, rows.size() / 2, uneven, run) {
    for (std::size_t i = 0; i < sites_.size(); ++i) insert(i, {rows[2 * i], rows[2 * i + 1]});
}

std::int64_t PeriodicVoronoi::column_of(double x) const {
    return std::min(static_cast<std::int64_t>(x / size_.x), columns_ - 1);
}

std::int64_t PeriodicVoronoi::row_of(double y) const {
    return std::min(static_cast<std::int64_t>(y / size_.y), rows_ - 1);
}

void PeriodicVoronoi::insert(std::size_t i, Vec2 at) {
    assert(at.x >= 0 && at.x <= sides_.x && at.y >= 0 && at.y <= sides_.y);
    const auto cell = static_cast<std::uint32_t>(row_of(at.y) * columns_ + column_of(at.x));
    sites_[i] = {at, heads_[cell], cell};
    heads_[cell] = static_cast<std::uint32_t>(i);
}

void PeriodicVoronoi::remove(std::size_t i) {
    std::uint32_t* link = &heads_[sites_[i].cell];
    while (*link != i) link = &sites_[*link].next;
    *link = sites_[i].next;
    sites_[i].cell = none;
}

void PeriodicVoronoi::move(std::size_t i, Vec2 to) {
    const auto cell = static_cast<std::uint32_t>(row_of(to.y) * columns_ + column_of(to.x));
    if (cell == sites_[i].cell) {
        sites_[i].at = to;
        return;
    }
    remove(i);
    insert(i, to);
}

void PeriodicVoronoi::set_weights(std::span<const double> weights) {
    weights_.assign(weights.begin(), weights.end());
    largest_weight_ = weights_.empty() ? 0 : *std::ranges::max_element(weights_);
}

Vec2 PeriodicVoronoi::inside(Vec2 at) const {
    if (!torus_) return {std::clamp(at.x, 0.0, sides_.x), std::clamp(at.y, 0.0, sides_.y)};
    const auto wrap = [](double x, double side) {
        x -= side * std::floor(x / side);
        return x < side && x >= 0 ? x : 0.0;
    };
    return {wrap(at.x, sides_.x), wrap(at.y, sides_.y)};
}

Vec2 PeriodicVoronoi::shortest(Vec2 from, Vec2 to) const {
    const auto step = [](double d, double side) { return d - side * std::round(d / side); };
    const Vec2 d{to.x - from.x, to.y - from.y};
    return torus_ ? Vec2{step(d.x, sides_.x), step(d.y, sides_.y)} : d;
}

void PeriodicVoronoi::start(Vec2 sides, bool torus, Vec2 at, std::uint32_t i, VoronoiCell& cell) {
    const auto [a, b] = sides;
    const Vec2 low = torus ? Vec2{-a / 2, -b / 2} : Vec2{-at.x, -at.y};
    const Vec2 high = torus ? Vec2{a / 2, b / 2} : Vec2{a - at.x, b - at.y};
    const std::uint32_t beyond = torus ? i : CellCorner::wall;
    cell.start({CellCorner{{low.x, low.y}, {0, 2 * low.y}, beyond},
                CellCorner{{high.x, low.y}, {2 * high.x, 0}, beyond},
                CellCorner{{high.x, high.y}, {0, 2 * high.y}, beyond},
                CellCorner{{low.x, high.y}, {2 * low.x, 0}, beyond}});
}

double PeriodicVoronoi::squared_security(double squared_reach, double weight) const {
    const double reach = std::sqrt(squared_reach);
    const double security = reach + std::sqrt(squared_reach + (largest_weight_ - weight));
    return security * security;
}

void PeriodicVoronoi::gather(const Site& site, std::int64_t column, std::int64_t row,
                             double squared_limit, VoronoiCell& cell) const {
    constexpr double slack = 1 + 1e-9;
    const double dx = gap(site.at.x, static_cast<double>(column) * size_.x, size_.x);
    const double dy = gap(site.at.y, static_cast<double>(row) * size_.y, size_.y);
    if (dx * dx + dy * dy > squared_limit * slack) return;
    Vec2 turn;
    if (column < 0 || column >= columns_) {
        const std::int64_t turns = column < 0 ? -1 : column / columns_;
        column -= turns * columns_;
        turn.x = static_cast<double>(turns) * sides_.x;
    }
    if (row < 0 || row >= rows_) {
        const std::int64_t turns = row < 0 ? -1 : row / rows_;
        row -= turns * rows_;
        turn.y = static_cast<double>(turns) * sides_.y;
    }
    for (std::uint32_t j = heads_[static_cast<std::size_t>(row * columns_ + column)]; j != none;
         j = sites_[j].next) {
        // Grouped so that both sites of a pair compute the same distance, to the last bit.
        const Vec2 seen{(sites_[j].at.x - site.at.x) + turn.x,
                        (sites_[j].at.y - site.at.y) + turn.y};
        const double squared = dot(seen, seen);
        if (squared < squared_limit && &sites_[j] != &site)
            cell.candidates_.push_back({squared, seen, j});
    }
}

void PeriodicVoronoi::gather_ring(const Site& site, std::int64_t ring, double squared_limit,
                                  VoronoiCell& cell) const {
    const std::int64_t column = column_of(site.at.x);
    const std::int64_t row = row_of(site.at.y);
    // On the torus, copies more than one period away are never nearest to a point of the cell.
    const std::int64_t left = std::max(column - ring, torus_ ? column - columns_ : 0);
    const std::int64_t right = std::min(column + ring, torus_ ? column + columns_ : columns_ - 1);
    const std::int64_t bottom = std::max(row - ring, torus_ ? row - rows_ : 0);
    const std::int64_t top = std::min(row + ring, torus_ ? row + rows_ : rows_ - 1);
    for (std::int64_t r = bottom; r <= top; ++r) {
        if (std::abs(r - row) == ring) {
            for (std::int64_t c = left; c <= right; ++c) gather(site, c, r, squared_limit, cell);
            continue;
        }
        if (left == column - ring) gather(site, left, r, squared_limit, cell);
        if (right == column + ring) gather(site, right, r, squared_limit, cell);
    }
}

void PeriodicVoronoi::cut_by_candidates(std::uint32_t i, VoronoiCell& cell, double needed) const {
    std::ranges::sort(cell.candidates_, {}, [](const auto& candidate) {
        const auto& [squared, seen, site] = candidate;
        return std::tuple(squared, site, seen.x, seen.y);
    });
    const double weight = weights_.empty() ? 0 : weights_[i];
    double limit = squared_security(cell.squared_reach(), weight);
    double reach = cell.squared_reach();
    for (const auto& candidate : cell.candidates_) {
        if (candidate.squared >= limit) break;
        const double lead = weights_.empty() ? 0 : weight - weights_[candidate.site];
        if (candidate.squared == 0 && lead == 0 && candidate.site < i) return cell.clear();
        cell.cut(candidate.seen, (candidate.squared + lead) / 2, candidate.site);
        if (cell.empty() || cell.squared_reach() < needed) return;
        if (cell.squared_reach() == reach) continue;
        reach = cell.squared_reach();
        limit = squared_security(reach, weight);
    }
}

void PeriodicVoronoi::cut_cell(std::size_t i, VoronoiCell& cell, double needed) const {
    start(sides_, torus_, sites_[i].at, static_cast<std::uint32_t>(i), cell);
    cut_started(i, cell, needed);
}

void PeriodicVoronoi::cut_exactly(std::size_t i, VoronoiCell& cell) const {
    cut_cell(i, cell);
    // The corners have errors of about 1e-16 times the size of the rectangle at the start. So it is
    // cut again from a smaller one around its corners, as long as it is much smaller than that.
    const Vec2 at = sites_[i].at;
    double size = std::max(sides_.x, sides_.y);
    while (cell.squared_reach() < 1e-12 * size * size) {
        const double half = 4 * std::sqrt(cell.squared_reach()) + 1e-14 * size;
        start(sides_, torus_, at, static_cast<std::uint32_t>(i), cell);
        std::array<CellCorner, 4> box;
        std::ranges::copy(cell.corners(), box.begin());
        for (CellCorner& corner : box) {
            const double across = std::abs(corner.neighbor.x) + std::abs(corner.neighbor.y);
            if (across > 2 * half) {  // an edge of the smaller rectangle, at this distance
                const double shrink = 2 * half / across;
                corner.neighbor = {corner.neighbor.x * shrink, corner.neighbor.y * shrink};
                corner.site = static_cast<std::uint32_t>(i);
            }
            corner.at = {std::clamp(corner.at.x, -half, half),
                         std::clamp(corner.at.y, -half, half)};
        }
        cell.start(box);
        cut_started(i, cell, 0);
        size = 2 * half;
    }
}

void PeriodicVoronoi::cut_started(std::size_t i, VoronoiCell& cell, double needed) const {
    const Site& site = sites_[i];
    const auto own = static_cast<std::uint32_t>(i);
    const std::int64_t rings = std::max(columns_, rows_);
    const double weight = weights_.empty() ? 0 : weights_[i];
    // Sites outside a block of rings are at least as far away as the block's rim.
    const double x = site.at.x - static_cast<double>(column_of(site.at.x)) * size_.x;
    const double y = site.at.y - static_cast<double>(row_of(site.at.y)) * size_.y;
    for (std::int64_t ring = 0; ring <= rings; ++ring) {
        if (cell.empty() || cell.squared_reach() < needed) return;
        const double limit = squared_security(cell.squared_reach(), weight);
        const auto before = static_cast<double>(ring - 1);
        const double rim = std::min(std::min(x, size_.x - x) + before * size_.x,
                                    std::min(y, size_.y - y) + before * size_.y);
        if (ring > 0 && rim * rim >= limit && rim > 0) break;
        cell.candidates_.clear();
        gather_ring(site, ring, limit, cell);
        cut_by_candidates(own, cell, needed);
    }
}

}  // namespace stipple
