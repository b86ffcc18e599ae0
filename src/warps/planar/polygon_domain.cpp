// SPDX-License-Identifier: MIT
#include "warps/planar/polygon_domain.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "math/densities/line_table.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/orientation.hpp"
#include "math/geometry/planar_area.hpp"
#include "warps/planar/area_share.hpp"

namespace stipple::warps {
namespace {

double x_at(const UpwardEdge& edge, double y) {
    if (y == edge.high.y) return edge.high.x;
    return edge.low.x +
           (edge.high.x - edge.low.x) * ((y - edge.low.y) / (edge.high.y - edge.low.y));
}

/// Region between two edges, from one height to another.
struct Trapezoid {
    UpwardEdge left;
    UpwardEdge right;
    std::size_t bottom;  ///< index of its lower height
    std::size_t top;
};

/// Sweeps a row upwards: keeps the edges that it meets, collects the trapezoids between them.
class TrapezoidSweep {
  public:
    TrapezoidSweep(std::span<const UpwardEdge> edges, std::span<const double> heights)
        : edges_(edges), states_(edges.size()), row_(ToRight{edges}) {
        starts_.resize(heights.size());
        ends_.resize(heights.size());
        const auto place = [&](double y) {
            return static_cast<std::size_t>(std::ranges::lower_bound(heights, y) - heights.begin());
        };
        for (std::size_t i = 0; i < edges.size(); ++i) {
            starts_[place(edges[i].low.y)].push_back(i);
            ends_[place(edges[i].high.y)].push_back(i);
        }
    }

    std::vector<Trapezoid> trapezoids(const RunContext& run) {
        for (std::size_t height = 0; height < starts_.size(); ++height) {
            if (height % 1024 == 0) run.check_stop();
            pass(height);
        }
        return std::move(found_);
    }

  private:
    struct ToRight {
        std::span<const UpwardEdge> edges;
        bool operator()(std::size_t i, std::size_t j) const {
            const int side = i == j ? 0 : side_of_edge(edges[j], edges[i]);
            return side != 0 ? side > 0 : i < j;
        }
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    /// State of an edge that the row meets.
    struct State {
        std::set<std::size_t, ToRight>::iterator place = {};
        bool met = false;
        bool left = false;           ///< whether the inside is on the edge's right
        std::size_t partner = none;  ///< the edge on the other side of an open trapezoid
        std::size_t bottom = 0;      ///< index of the height where that trapezoid starts
    };

    /// Ends the edge's open trapezoid at the height with this index.
    void close(std::size_t edge, std::size_t height) {
        const std::size_t other = states_[edge].partner;
        if (other == none) return;
        const std::size_t left = states_[edge].left ? edge : other;
        const std::size_t right = states_[edge].left ? other : edge;
        found_.push_back({edges_[left], edges_[right], states_[left].bottom, height});
        states_[left].partner = states_[right].partner = none;
        loose_.insert(loose_.end(), {left, right});
    }

    void pass(std::size_t height) {
        loose_.clear();
        for (const std::size_t edge : ends_[height]) {
            close(edge, height);
            row_.erase(states_[edge].place);
            states_[edge].met = false;
        }
        std::ranges::sort(starts_[height], ToRight{edges_});
        for (const std::size_t edge : starts_[height]) {
            const auto place = row_.insert(edge).first;
            const bool first = place == row_.begin();
            if (!first) close(*std::prev(place), height);
            states_[edge] = {
                .place = place, .met = true, .left = first || !states_[*std::prev(place)].left};
            loose_.push_back(edge);
        }
        for (const std::size_t edge : loose_) {
            if (!states_[edge].met || states_[edge].partner != none) continue;
            const auto place = states_[edge].place;
            const std::size_t left = states_[edge].left ? edge : *std::prev(place);
            const std::size_t right = states_[edge].left ? *std::next(place) : edge;
            states_[left].partner = right;
            states_[right].partner = left;
            states_[left].bottom = height;
        }
    }

    std::span<const UpwardEdge> edges_;
    std::vector<State> states_;
    std::set<std::size_t, ToRight> row_;
    std::vector<std::vector<std::size_t>> starts_;  ///< edges that start at each height
    std::vector<std::vector<std::size_t>> ends_;
    std::vector<std::size_t> loose_;  ///< edges that may need a new partner
    std::vector<Trapezoid> found_;
};

/// Relative height, measured from the end whose row has length w0, of the row that cuts off the
/// fraction f of a slab's area at that end. The longer of the lengths w0 and w1 must be 1.
double height_share(double f, double w0, double w1) {
    const double root = std::sqrt((1 - f) * w0 * w0 + f * w1 * w1);
    const double null = f == 0;  // avoids 0 / 0 if f and w0 are 0
    return f * (w0 + w1) / (w0 + root + null);
}

/// The number x in [0, 1] nearest to `share` for which x * whole is in [low, high), so that
/// forward() finds the same slab even if `share` is on its edge.
double share_within(double share, double whole, double low, double high) {
    double x = std::clamp(share, 0.0, 1.0);
    while (x < 1 && x * whole < low) x = std::nextafter(x, 1);
    while (x > 0 && x * whole >= high) x = std::nextafter(x, 0);
    return x;
}

double distance(PlanePoint p, PlanePoint a, PlanePoint b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double longest = std::max(std::abs(dx), std::abs(dy));  // avoids overflow of squares
    const double ex = dx / longest;
    const double ey = dy / longest;
    const double along = ((p.x - a.x) * ex + (p.y - a.y) * ey) / (ex * ex + ey * ey);
    const double t = std::clamp(along / longest, 0.0, 1.0);
    const double x = (p.x - a.x) / longest - t * ex;
    const double y = (p.y - a.y) / longest - t * ey;
    return longest * std::sqrt(x * x + y * y);
}

}  // namespace

PolygonDomain::PolygonDomain(std::string spec, const std::vector<RingSegment>& edges,
                             const RunContext& run)
    : NamedDomain(std::move(spec), 2, 2) {
    measure_rim(edges);
    cut_bands(run);
    measure_slabs();
}

void PolygonDomain::measure_rim(const std::vector<RingSegment>& edges) {
    std::vector<double> rows;
    for (const RingSegment& edge : edges) {
        rim_.emplace_back(edge.a, edge.b);
        rows.insert(rows.end(), {edge.a.x, edge.a.y});
    }
    box_ = stipple::bounding_box(rows, 2);
    double size = 0;
    for (const double x : rows) size = std::max(size, std::abs(x));
    slack_ = 16 * std::numeric_limits<double>::epsilon() * size;
}

/// Makes a slab between each two consecutive heights of vertices. Stores the trapezoids in a
/// segment tree with the slabs as leaves.
void PolygonDomain::cut_bands(const RunContext& run) {
    std::vector<UpwardEdge> edges;
    std::vector<double> heights;
    for (const auto& [p, q] : rim_) {
        heights.push_back(p.y);
        if (p.y != q.y) edges.push_back(upward(p, q));
    }
    std::ranges::sort(heights);
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    const auto trapezoids = TrapezoidSweep(edges, heights).trapezoids(run);

    struct Piece {
        std::size_t node;
        Part part;
    };
    std::vector<Piece> pieces;
    const std::size_t slabs = heights.size() - 1;
    const std::size_t leaves = std::bit_ceil(slabs);
    const auto span_of = [&](std::size_t node) {
        const std::size_t width = leaves / std::bit_floor(node);
        const std::size_t first = (node - std::bit_floor(node)) * width;
        return std::pair{heights[first], heights[first + width]};
    };
    const auto add = [&](std::size_t node, const Trapezoid& whole) {
        const auto [bottom, top] = span_of(node);
        pieces.push_back({node,
                          {x_at(whole.left, bottom), x_at(whole.left, top),
                           x_at(whole.right, bottom), x_at(whole.right, top)}});
    };
    for (const Trapezoid& whole : trapezoids) {
        run.need_memory(static_cast<double>(pieces.size()) * 2.5 * sizeof(Piece),
                        "the rows of the polygon");
        std::size_t low = whole.bottom + leaves;
        for (std::size_t high = whole.top + leaves; low < high; low /= 2, high /= 2) {
            if (low % 2 == 1) add(low++, whole);
            if (high % 2 == 1) add(--high, whole);
        }
    }
    std::ranges::sort(pieces, [](const Piece& a, const Piece& b) {
        const auto sum = [](const Part& p) {  // larger for parts further right
            return 0.5 * (p.left_bottom + p.left_top) + 0.5 * (p.right_bottom + p.right_top);
        };
        return a.node != b.node ? a.node < b.node : sum(a.part) < sum(b.part);
    });

    std::vector<std::size_t> lowest(2 * leaves, none);  // band at the node or its nearest ancestor
    auto piece = pieces.begin();
    for (std::size_t node = 1; node < 2 * leaves; ++node) {
        lowest[node] = lowest[node / 2];
        if (piece == pieces.end() || piece->node != node) continue;
        const auto [bottom, top] = span_of(node);
        const std::size_t first = parts_.size();
        for (; piece != pieces.end() && piece->node == node; ++piece) {
            if (parts_.size() > first) {
                piece->part.before_bottom = parts_.back().through(0);
                piece->part.before_top = parts_.back().through(1);
            }
            parts_.push_back(piece->part);
        }
        bands_.push_back({bottom, top, first, parts_.size(), lowest[node]});
        lowest[node] = bands_.size() - 1;
    }
    for (std::size_t j = 0; j < slabs; ++j)
        slabs_.push_back({.bottom = heights[j], .top = heights[j + 1], .band = lowest[leaves + j]});
}

void PolygonDomain::measure_slabs() {
    std::vector<double> sums;
    for (std::size_t j = 0; j < slabs_.size(); ++j) {
        Slab& slab = slabs_[j];
        slab.width_bottom = row_at(slab, slab.bottom).length();
        slab.width_top = row_at(slab, slab.top).length();
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

/// The region of a part within a band is a quadrilateral.
std::optional<Estimate> PolygonDomain::box_mass(const Box& box) const {
    return area_share(box, *this, [&](const Polygon& window) {
        double sum = 0;
        for (const Band& band : bands_) {
            if (band.bottom >= window[2][1] || band.top <= window[0][1]) continue;
            for (const Part& part : parts_of(band))
                sum += shared_area({{part.left(0), band.bottom},
                                    {part.right(0), band.bottom},
                                    {part.right(1), band.top},
                                    {part.left(1), band.top}},
                                   window);
        }
        return sum;
    });
}

std::optional<Moments> PolygonDomain::moments() const {
    MixedMoments all(box_);
    for (const Band& band : bands_)
        for (const Part& part : parts_of(band)) {
            const std::vector<double> low = {part.left_bottom, band.bottom};
            const std::vector<double> high = {part.right_top, band.top};
            const double height = band.top - band.bottom;
            // Weights are twice the areas of the two triangles.
            all.add((part.right_bottom - part.left_bottom) * height,
                    triangle_moments({low, {part.right_bottom, band.bottom}, high}));
            all.add((part.right_top - part.left_top) * height,
                    triangle_moments({low, {part.left_top, band.top}, high}));
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

/// Measures areas from the bottom of the polygon if u < 1/2, else from its top. Avoids branches,
/// which would be mispredicted half of the time.
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
    const Row cuts = row_at(slab, y);
    return {along_row(cuts, v * cuts.length()), y};
}

PolygonDomain::Row PolygonDomain::row_at(const Slab& slab, double y) const {
    Row row;
    for (std::size_t b = slab.band; b != none; b = bands_[b].above) {
        const Band& band = bands_[b];
        row.cuts[row.count++] = {&parts_[band.first], band.last - band.first,
                                 (y - band.bottom) / (band.top - band.bottom)};
    }
    return row;
}

double PolygonDomain::Row::length() const {
    double sum = 0;
    for (const Cut& cut : all()) sum += cut.before(cut.count);
    return sum;
}

std::size_t PolygonDomain::Cut::left_of(double x, std::size_t low, std::size_t high) const {
    const auto from = parts + low;
    const auto past =
        std::partition_point(from, parts + high, [&](const Part& p) { return p.left(t) < x; });
    return static_cast<std::size_t>(past - parts);
}

/// The x where the parts of a row, from the left, have the length `way`. Searches the last part
/// with at most `way` to its left; each step halves the list with the most remaining parts.
double PolygonDomain::along_row(const Row& row, double way) {
    std::array<std::size_t, most_bands> low;
    std::array<std::size_t, most_bands> high;
    std::array<std::size_t, most_bands> middle;
    for (std::size_t i = 0; i < row.count; ++i) {
        low[i] = 0;
        high[i] = row.cuts[i].count;
    }
    double left = -std::numeric_limits<double>::infinity();
    double right = left;
    double passed = 0;
    while (true) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < row.count; ++i)
            if (high[i] - low[i] > high[longest] - low[longest]) longest = i;
        if (high[longest] == low[longest]) break;
        const Cut& cut = row.cuts[longest];
        const Part& part = cut.parts[low[longest] + (high[longest] - low[longest]) / 2];
        const double x = part.left(cut.t);
        double before = 0;
        for (std::size_t i = 0; i < row.count; ++i) {
            middle[i] = row.cuts[i].left_of(x, low[i], high[i]);
            before += row.cuts[i].before(middle[i]);
        }
        if (before > way) {
            high = middle;
            continue;
        }
        low = middle;
        ++low[longest];
        const double end = part.right(cut.t);
        if (!(x > left || end > right)) continue;  // keeps the longer of two parts that begin at x
        left = x;
        right = end;
        passed = before;
    }
    return std::min(left + std::max(0.0, way - passed), right);
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
    cube[1] = place_in_row(row_at(slab, y), p.x);
}

/// Part of a row that is nearest to x; the leftmost one if several parts are equally near.
PolygonDomain::Nearest PolygonDomain::nearest_part(const Row& row, double x) {
    Nearest nearest;
    for (const Cut& cut : row.all()) {
        const std::size_t begun = cut.left_of(x, 0, cut.count);
        const std::size_t end = std::min(begun + 1, cut.count);
        for (std::size_t k = begun - std::min<std::size_t>(begun, 2); k < end; ++k) {
            const double left = cut.parts[k].left(cut.t);
            const double right = cut.parts[k].right(cut.t);
            const double gap = std::max({left - x, x - right, 0.0});
            if (gap < nearest.gap || (gap == nearest.gap && left < nearest.left))
                nearest = {left, right, gap};
        }
    }
    return nearest;
}

/// Fraction of the row's length to the left of x, or of the nearest part if x is outside.
double PolygonDomain::place_in_row(const Row& row, double x) {
    const double width = row.length();
    if (!(width > 0)) return 0;
    const Nearest part = nearest_part(row, x);
    double before = 0;
    for (const Cut& cut : row.all()) before += cut.before(cut.left_of(part.left, 0, cut.count));
    const double length = part.right - part.left;
    const double after = before + length;
    return share_within((before + std::clamp(x - part.left, 0.0, length)) / width, width, before,
                        after >= width ? 2 * width : after);
}

/// Horizontal distance of the point from the nearest part of the slab; 0 inside.
double PolygonDomain::gap(const Slab& slab, PlanePoint p) const {
    return nearest_part(row_at(slab, std::clamp(p.y, slab.bottom, slab.top)), p.x).gap;
}

/// Of the slabs within slack_ of the point's height, the one with the smallest gap() from it.
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
