// SPDX-License-Identifier: MIT
//
// The largest empty ball of the plane, from cells cut out point by point.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>

#include "analyzers/distances/empty_ball.hpp"
#include "core/parallel.hpp"
#include "math/neighbors/kd_tree.hpp"

namespace stipple::analyzers {
namespace {

struct Vector {
    double x;
    double y;

    [[nodiscard]] double squared() const { return x * x + y * y; }
};

/// The half plane normal . v <= limit.
struct HalfPlane {
    Vector normal;
    double limit;

    [[nodiscard]] double beyond(Vector v) const { return normal.x * v.x + normal.y * v.y - limit; }
};

/// A convex polygon around the origin, which stands for the cell's point.
class Cell {
  public:
    void start(Vector low, Vector high) {
        sides_ = {{{1, 0}, high.x}, {{0, 1}, high.y}, {{-1, 0}, -low.x}, {{0, -1}, -low.y}};
        corners_ = {high, {low.x, high.y}, low, {high.x, low.y}};
        measure();
    }

    [[nodiscard]] const std::vector<Vector>& corners() const { return corners_; }
    [[nodiscard]] double squared_radius() const { return squared_radius_; }

    /// Leaves what is nearer to the origin than to `other`.
    void clip(Vector other) {
        const HalfPlane cut{other, other.squared() / 2};
        const std::size_t size = corners_.size();
        beyond_.resize(size);
        for (std::size_t i = 0; i < size; ++i) beyond_[i] = cut.beyond(corners_[i]);
        std::size_t first = 0;  // corner that goes, after one that stays
        while (first < size && !(beyond_[first] > 0 && beyond_[before(first)] <= 0)) ++first;
        if (first == size) return;
        std::size_t gone = 1;
        while (beyond_[(first + gone) % size] > 0) ++gone;
        replace(first, gone, cut);
        measure();
    }

    /// Corner i anew from its two sides, in more digits than it was cut with.
    [[nodiscard]] Vector refined(std::size_t i) const {
        using Long = long double;
        const HalfPlane& a = sides_[i];
        const HalfPlane& b = sides_[(i + 1) % sides_.size()];
        const auto limit = [](const HalfPlane& side) {
            const Long x = side.normal.x;
            const Long y = side.normal.y;
            const bool wall = side.limit * 2 != side.normal.squared();
            return wall ? Long{side.limit} : (x * x + y * y) / 2;
        };
        const Long determinant = Long{a.normal.x} * b.normal.y - Long{a.normal.y} * b.normal.x;
        const Vector corner{
            static_cast<double>((limit(a) * b.normal.y - limit(b) * a.normal.y) / determinant),
            static_cast<double>((limit(b) * a.normal.x - limit(a) * b.normal.x) / determinant)};
        const Vector change{corner.x - corners_[i].x, corner.y - corners_[i].y};
        // Nearly parallel sides: the corner as it was cut is inside what they leave.
        return change.squared() < 1e-12 * squared_radius_ ? corner : corners_[i];
    }

  private:
    [[nodiscard]] std::size_t before(std::size_t i) const {
        return i > 0 ? i - 1 : corners_.size() - 1;
    }

    [[nodiscard]] Vector between(std::size_t i, std::size_t j) const {
        const double t = beyond_[i] / (beyond_[i] - beyond_[j]);
        return {corners_[i].x + t * (corners_[j].x - corners_[i].x),
                corners_[i].y + t * (corners_[j].y - corners_[i].y)};
    }

    /// Puts the cut's two corners in place of `gone` ones from `first` on. Corner i is where sides
    /// i and i + 1 meet.
    void replace(std::size_t first, std::size_t gone, const HalfPlane& cut) {
        const std::size_t size = corners_.size();
        const std::size_t last = (first + gone - 1) % size;
        const std::size_t after = (last + 1) % size;
        next_corners_.clear();
        next_sides_.clear();
        next_sides_.push_back(sides_[first]);
        next_corners_.push_back(between(before(first), first));
        next_sides_.push_back(cut);
        next_corners_.push_back(between(last, after));
        for (std::size_t i = 0; i < size - gone; ++i) {
            next_sides_.push_back(sides_[(after + i) % size]);
            next_corners_.push_back(corners_[(after + i) % size]);
        }
        corners_.swap(next_corners_);
        sides_.swap(next_sides_);
    }

    void measure() {
        squared_radius_ = 0;
        for (const Vector& v : corners_) squared_radius_ = std::max(squared_radius_, v.squared());
    }

    std::vector<HalfPlane> sides_;
    std::vector<Vector> corners_;
    double squared_radius_ = 0;
    std::vector<double> beyond_;
    std::vector<Vector> next_corners_;
    std::vector<HalfPlane> next_sides_;
};

/// The set with all that its cells are cut from.
class Plane {
  public:
    Plane(const PointSet& points, const Distances& distances, const RunContext& run)
        : box_(*distances.box), tree_(points.flat(), 2, {}, run), shifts_(distances.torus ? 9 : 1) {
        constexpr std::array<int, 9> around = {0, 1, -1, 0, 0, 1, 1, -1, -1};
        constexpr std::array<int, 9> above = {0, 0, 0, 1, -1, 1, -1, 1, -1};
        for (std::size_t i = 0; i < shifts_.size(); ++i)
            shifts_[i] = {around[i] * box_.extent(0), above[i] * box_.extent(1)};
    }

    [[nodiscard]] std::size_t count() const { return tree_.count(); }

    /// Cuts out the cell of the tree's `place`-th point, until no corner of it is as far away as
    /// `needed`; false: none is.
    bool cut_out(Cell& cell, std::size_t place, double needed) const {
        const Vector p = position(place);
        if (shifts_.size() > 1)
            cell.start({-box_.extent(0) / 2, -box_.extent(1) / 2},
                       {box_.extent(0) / 2, box_.extent(1) / 2});
        else
            cell.start({box_.low[0] - p.x, box_.low[1] - p.y},
                       {box_.high[0] - p.x, box_.high[1] - p.y});
        for (const Vector& shift : shifts_) {
            const double origin[2] = {p.x - shift.x, p.y - shift.y};
            tree_.walk(
                origin,
                [&](const double* box) {
                    return cell.squared_radius() >= needed && reaches(cell, box, origin);
                },
                [&](std::size_t, const double* row) {
                    const Vector other{row[0] - origin[0], row[1] - origin[1]};
                    const double squared = other.squared();
                    if (squared > 0 && squared < 4 * cell.squared_radius()) cell.clip(other);
                });
        }
        return cell.squared_radius() >= needed;
    }

    /// The cell's corner that is farthest from all points, as float64 can write it down.
    [[nodiscard]] EmptyBall best_corner(const Cell& cell, std::size_t place) const {
        EmptyBall best{-1, 0, {}};
        const Vector p = position(place);
        for (std::size_t i = 0; i < cell.corners().size(); ++i) {
            if (cell.corners()[i].squared() < (1 - 1e-6) * cell.squared_radius()) continue;
            const Vector v = cell.refined(i);
            const std::vector<double> center{inside(0, p.x + v.x), inside(1, p.y + v.y)};
            const double radius = std::sqrt(clearance(center));
            if (radius > best.radius) best = {radius, radius, center};
        }
        return best;
    }

  private:
    [[nodiscard]] Vector position(std::size_t place) const {
        return {tree_.row(place)[0], tree_.row(place)[1]};
    }

    /// Whether a point of the box may be nearer than the cell's own to one of its corners.
    static bool reaches(const Cell& cell, const double* box, const double* origin) {
        const double low[2] = {box[0] - origin[0], box[1] - origin[1]};
        const double high[2] = {box[2] - origin[0], box[3] - origin[1]};
        const auto gap = [&](const Vector& v) {
            return Vector{std::max({low[0] - v.x, v.x - high[0], 0.0}),
                          std::max({low[1] - v.y, v.y - high[1], 0.0})}
                .squared();
        };
        if (gap({0, 0}) >= 4 * cell.squared_radius()) return false;
        return std::ranges::any_of(cell.corners(),
                                   [&](const Vector& v) { return gap(v) < v.squared(); });
    }

    /// A coordinate in the box: across its faces on the torus; of a wall's corner, on the wall.
    [[nodiscard]] double inside(std::size_t k, double x) const {
        if (shifts_.size() > 1 && x < box_.low[k]) x += box_.extent(k);
        if (shifts_.size() > 1 && x > box_.high[k]) x -= box_.extent(k);
        return std::clamp(x, box_.low[k], box_.high[k]);
    }

    /// Squared distance to the nearest point.
    [[nodiscard]] double clearance(const std::vector<double>& place) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Vector& shift : shifts_) {
            const double shifted[2] = {place[0] - shift.x, place[1] - shift.y};
            least = std::min(least, tree_.nearest(shifted).squared);
        }
        return least;
    }

    Box box_;
    KdTree tree_;
    std::vector<Vector> shifts_;  ///< of copies of the set; the first is none
};

/// A cell with its farthest corner, which is as good as any was when it was cut out.
struct Record {
    double squared_radius;
    std::size_t place;
};

/// Corners this near to each other are compared in more digits.
constexpr double alike = 1 - 1e-9;

std::vector<Record> best_cells(const Plane& plane, const RunContext& run) {
    constexpr std::uint64_t size = 2048;
    constexpr std::size_t most = 1000;  // more are as good only where a set repeats itself
    std::vector<std::vector<Record>> parts(block_count(plane.count(), size));
    std::atomic<double> best = 0;  // when it is seen changes what is looked at, but no result
    for_each_block(run, plane.count(), size, [&](const Block& b) {
        Cell cell;
        for (std::size_t place = b.first; place < b.last; ++place) {
            double known = best.load(std::memory_order_relaxed);
            if (!plane.cut_out(cell, place, known * alike)) continue;
            parts[b.index].push_back({cell.squared_radius(), place});
            while (known < cell.squared_radius() &&
                   !best.compare_exchange_weak(known, cell.squared_radius())) {
            }
        }
    });
    std::vector<Record> records;
    for (const auto& part : parts)
        std::ranges::copy_if(part, std::back_inserter(records),
                             [&](const Record& r) { return r.squared_radius >= best * alike; });
    std::ranges::sort(records, [](const Record& a, const Record& b) {
        return a.squared_radius > b.squared_radius ||
               (a.squared_radius == b.squared_radius && a.place < b.place);
    });
    records.resize(std::min(records.size(), most));
    return records;
}

}  // namespace

EmptyBall planar_empty_ball(const PointSet& points, const Distances& distances,
                            const RunContext& run) {
    const Plane plane(points, distances, run.stage(0, 0.2));
    EmptyBall best{-1, 0, {}};
    Cell cell;
    for (const Record& record : best_cells(plane, run.stage(0.2, 1))) {
        run.check_stop();
        plane.cut_out(cell, record.place, 0);
        EmptyBall ball = plane.best_corner(cell, record.place);
        if (ball.radius > best.radius) best = std::move(ball);
    }
    run.tick(1, 1);
    return best;
}

}  // namespace stipple::analyzers
