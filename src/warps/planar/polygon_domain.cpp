// SPDX-License-Identifier: MIT
#include "warps/planar/polygon_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/densities/line_table.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/planar_area.hpp"
#include "warps/planar/area_share.hpp"

namespace stipple::warps {
namespace {

/// An edge that is not level, from its lower to its upper end.
struct SlantedEdge {
    PlanePoint low;
    PlanePoint high;

    [[nodiscard]] double x_at(double y) const {
        if (y == high.y) return high.x;
        return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
    }
};

/// An edge that passes through the slab at hand, and where it does half way up.
struct Passing {
    const SlantedEdge* edge;
    double x = 0;
};

/// By insertion: edges don't cross, so that all but the new ones at the end are in order already.
void sort_from_left(std::vector<Passing>& passing, double middle) {
    for (Passing& p : passing) p.x = p.edge->x_at(middle);
    for (auto p = passing.begin(); p != passing.end(); ++p) {
        if (p == passing.begin() || (p - 1)->x <= p->x) continue;
        const auto place = std::ranges::upper_bound(passing.begin(), p, p->x, {}, &Passing::x);
        std::rotate(place, p, p + 1);
    }
}

/// The share of a slab's height, from the end where its row is w0 long, that has the share f of its
/// area; the longer one of w0 and w1 is 1.
double height_share(double f, double w0, double w1) {
    const double root = std::sqrt((1 - f) * w0 * w0 + f * w1 * w1);
    const double null = f == 0;  // where w0 = 0, too, this is 0 / 0
    return f * (w0 + w1) / (w0 + root + null);
}

/// A share in [0, 1] next to `share` that forward() finds in the piece [low, high) of the whole, on
/// whose edge it may be.
double share_within(double share, double whole, double low, double high) {
    double x = std::clamp(share, 0.0, 1.0);
    while (x < 1 && x * whole < low) x = std::nextafter(x, 1);
    while (x > 0 && x * whole >= high) x = std::nextafter(x, 0);
    return x;
}

double distance(PlanePoint p, PlanePoint a, PlanePoint b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double longest = std::max(std::abs(dx), std::abs(dy));  // so that squares don't overflow
    const double ex = dx / longest;
    const double ey = dy / longest;
    const double along = ((p.x - a.x) * ex + (p.y - a.y) * ey) / (ex * ex + ey * ey);
    const double t = std::clamp(along / longest, 0.0, 1.0);
    const double x = (p.x - a.x) / longest - t * ex;
    const double y = (p.y - a.y) / longest - t * ey;
    return longest * std::sqrt(x * x + y * y);
}

}  // namespace

PolygonDomain::PolygonDomain(std::string spec, const std::vector<Ring>& rings,
                             const RunContext& run)
    : NamedDomain(std::move(spec), 2, 2) {
    measure_rings(rings);
    cut_slabs(run);
    measure_slabs();
}

void PolygonDomain::measure_rings(const std::vector<Ring>& rings) {
    std::vector<double> rows;
    for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            rim_.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
            rows.insert(rows.end(), {ring[i].x, ring[i].y});
        }
    box_ = stipple::bounding_box(rows, 2);
    double size = 0;
    for (const double x : rows) size = std::max(size, std::abs(x));
    slack_ = 16 * std::numeric_limits<double>::epsilon() * size;
}

/// One slab between each height of a vertex and the next, with the parts of it that are inside:
/// every second interval between the edges that pass through it, from left to right.
void PolygonDomain::cut_slabs(const RunContext& run) {
    std::vector<SlantedEdge> edges;
    std::vector<double> heights;
    for (const auto& [p, q] : rim_) {
        heights.push_back(p.y);
        if (p.y != q.y) edges.push_back(p.y < q.y ? SlantedEdge{p, q} : SlantedEdge{q, p});
    }
    std::ranges::sort(heights);
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    std::ranges::sort(edges, {}, [](const SlantedEdge& edge) { return edge.low.y; });

    std::vector<Passing> passing;
    auto next = edges.begin();
    for (std::size_t j = 0; j + 1 < heights.size(); ++j) {
        run.check_stop();
        const double bottom = heights[j];
        const double top = heights[j + 1];
        std::erase_if(passing, [&](const Passing& p) { return p.edge->high.y <= bottom; });
        for (; next != edges.end() && next->low.y <= bottom; ++next) passing.push_back({&*next});
        sort_from_left(passing, bottom + 0.5 * (top - bottom));
        const std::size_t first = parts_.size();
        for (std::size_t k = 0; k + 1 < passing.size(); k += 2) {
            const SlantedEdge& left = *passing[k].edge;
            const SlantedEdge& right = *passing[k + 1].edge;
            parts_.push_back(
                {left.x_at(bottom), left.x_at(top), right.x_at(bottom), right.x_at(top)});
        }
        slabs_.push_back({.bottom = bottom, .top = top, .first = first, .last = parts_.size()});
        run.need_memory(static_cast<double>(parts_.size()) * 2 * sizeof(Part),
                        "the rows of the polygon");
    }
}

void PolygonDomain::measure_slabs() {
    std::vector<double> sums;
    for (std::size_t j = 0; j < slabs_.size(); ++j) {
        Slab& slab = slabs_[j];
        for (const Part& part : parts_of(slab)) {
            slab.width_bottom += part.right(0) - part.left(0);
            slab.width_top += part.right(1) - part.left(1);
        }
        slab.area = 0.5 * (slab.width_bottom + slab.width_top) * slab.height();
        slab.area_below = area_;
        area_ += slab.area;
        sums.push_back(area_);
        if (!(slab.area > 0)) continue;
        const double widest = std::max(slab.width_bottom, slab.width_top);
        slab.share_bottom = slab.width_bottom / widest;
        slab.share_top = slab.width_top / widest;
        last_filled_ = j;
    }
    areas_ = GuideTable(std::move(sums), std::max<std::size_t>(64, 4 * slabs_.size()));
    double above = 0;
    for (std::size_t j = slabs_.size(); j-- > 0;) {
        slabs_[j].area_above = above;
        above += slabs_[j].area;
    }
}

/// What is between two edges from one height to another is a quadrilateral.
std::optional<Estimate> PolygonDomain::box_mass(const Box& box) const {
    return area_share(box, *this, [&](const Polygon& window) {
        const auto from = std::ranges::upper_bound(slabs_, window[0][1], {}, &Slab::top);
        double sum = 0;
        for (auto slab = from; slab != slabs_.end() && slab->bottom < window[2][1]; ++slab)
            for (const Part& part : parts_of(*slab))
                sum += shared_area({{part.left(0), slab->bottom},
                                    {part.right(0), slab->bottom},
                                    {part.right(1), slab->top},
                                    {part.left(1), slab->top}},
                                   window);
        return sum;
    });
}

std::optional<Moments> PolygonDomain::moments() const {
    MixedMoments all({0.5 * (box_.low[0] + box_.high[0]), 0.5 * (box_.low[1] + box_.high[1])});
    for (const Slab& slab : slabs_)
        for (const Part& part : parts_of(slab)) {
            const std::vector<double> low = {part.left_bottom, slab.bottom};
            const std::vector<double> high = {part.right_top, slab.top};
            // Weights are widths at the sides: both triangles are as high.
            all.add((part.right_bottom - part.left_bottom) * slab.height(),
                    triangle_moments({low, {part.right_bottom, slab.bottom}, high}));
            all.add((part.right_top - part.left_top) * slab.height(),
                    triangle_moments({low, {part.left_top, slab.top}, high}));
        }
    return all.moments();
}

void PolygonDomain::from_cube(std::span<const double> cube, std::span<double> image) const {
    for (std::size_t i = 0; i + 1 < cube.size(); i += 2) {
        const auto [x, y] = forward(cube[i], cube[i + 1]);
        image[i] = x;
        image[i + 1] = y;
    }
}

/// From the end of the slab that u is nearer to. Written without branches, since they would be
/// guessed wrong half of the time.
PlanePoint PolygonDomain::forward(double u, double v) const {
    const Slab& slab = slabs_[areas_.at(u * area_)];
    const bool up = u < 0.5;
    const double rest = (up ? u : 1 - u) * area_ - (up ? slab.area_below : slab.area_above);
    const double f = std::max(0.0, std::min(rest / slab.area, 1.0));
    const double near = up ? slab.share_bottom : slab.share_top;
    const double away = up ? slab.share_top : slab.share_bottom;
    const double step = height_share(f, near, away) * slab.height();
    const double row = up ? slab.bottom + step : slab.top - step;
    const double y = std::max(slab.bottom, std::min(row, slab.top));
    const double t = (y - slab.bottom) / slab.height();  // of the row as it is rounded
    return {along_row(slab, t, v * slab.width(t)), y};
}

/// The place in a row, the length `way` from its left end on.
double PolygonDomain::along_row(const Slab& slab, double t, double way) const {
    const auto parts = parts_of(slab);
    double passed = 0;
    for (std::size_t k = 0;; ++k) {
        const double left = parts[k].left(t);
        const double right = parts[k].right(t);
        const double after = passed + (right - left);
        if (way < after || k + 1 == parts.size())
            return std::min(left + std::max(0.0, way - passed), right);
        passed = after;
    }
}

void PolygonDomain::to_cube(std::span<const double> point, std::span<double> cube) const {
    const PlanePoint p{point[0], point[1]};
    const Slab& slab = slab_around(p);
    const double y = std::clamp(p.y, slab.bottom, slab.top);
    const double t = (y - slab.bottom) / slab.height();
    const double from_top = (slab.top - y) / slab.height();
    const double below =
        slab.area_below + mass_share(slab.width_bottom, slab.width_top, t) * slab.area;
    const double above =
        slab.area_above + mass_share(slab.width_top, slab.width_bottom, from_top) * slab.area;
    const double u = below < above ? below / area_ : 1 - above / area_;
    const bool topmost = &slab == &slabs_[last_filled_];
    cube[0] =
        share_within(u, area_, slab.area_below, topmost ? 2 * area_ : slab.area_below + slab.area);
    cube[1] = place_in_row(slab, t, p.x);
}

/// The share of the row's length that is on the left of x, or of the part that is nearest to it.
double PolygonDomain::place_in_row(const Slab& slab, double t, double x) const {
    const double width = slab.width(t);
    if (!(width > 0)) return 0;
    double passed = 0;
    double nearest = std::numeric_limits<double>::infinity();
    double place = 0;
    const auto parts = parts_of(slab);
    for (std::size_t k = 0; k < parts.size() && nearest > 0; ++k) {
        const double left = parts[k].left(t);
        const double right = parts[k].right(t);
        const double after = passed + (right - left);
        const double gap = std::max({left - x, x - right, 0.0});
        if (gap < nearest) {
            nearest = gap;
            place = share_within((passed + std::clamp(x - left, 0.0, right - left)) / width, width,
                                 passed, k + 1 == parts.size() ? 2 * width : after);
        }
        passed = after;
    }
    return place;
}

/// How far the point is from the slab's parts, along its row.
double PolygonDomain::gap(const Slab& slab, PlanePoint p) const {
    const double t = (std::clamp(p.y, slab.bottom, slab.top) - slab.bottom) / slab.height();
    double least = std::numeric_limits<double>::infinity();
    for (const Part& part : parts_of(slab))
        least = std::min(least, std::max({part.left(t) - p.x, p.x - part.right(t), 0.0}));
    return least;
}

/// The slab of the point. Where two meet, or are thinner than rounding, the one that holds it.
const PolygonDomain::Slab& PolygonDomain::slab_around(PlanePoint p) const {
    const auto above = std::ranges::upper_bound(slabs_, p.y, {}, &Slab::bottom);
    const auto home = above == slabs_.begin() ? above : above - 1;
    auto best = home;
    double least = gap(*home, p);
    const auto consider = [&](auto slab) {
        const double distance = gap(*slab, p);
        if (distance < least) {
            least = distance;
            best = slab;
        }
    };
    for (auto slab = home; least > 0 && slab != slabs_.begin() && p.y - slab->bottom <= slack_;)
        consider(--slab);
    for (auto slab = home + 1; least > 0 && slab != slabs_.end() && slab->bottom - p.y <= slack_;)
        consider(slab++);
    return *best;
}

double PolygonDomain::distance_to_rim(PlanePoint p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : rim_) least = std::min(least, distance(p, a, b));
    return least;
}

bool PolygonDomain::contains(std::span<const double> point) const {
    const PlanePoint p{point[0], point[1]};
    const bool near = p.x >= box_.low[0] - slack_ && p.x <= box_.high[0] + slack_ &&
                      p.y >= box_.low[1] - slack_ && p.y <= box_.high[1] + slack_;
    if (!near) return false;
    const bool in_rows = p.y >= box_.low[1] && p.y <= box_.high[1];
    return (in_rows && gap(slab_around(p), p) <= slack_) || distance_to_rim(p) <= slack_;
}

}  // namespace stipple::warps
