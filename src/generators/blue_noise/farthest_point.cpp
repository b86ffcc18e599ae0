// SPDX-License-Identifier: MIT
//
// Farthest-point optimisation: one point after the other is removed and put back at the centre of
// the largest empty circle of the others,
//
//     x_i  <-  argmax over x of  min over j != i of |x - x_j|,
//
// which never lowers the minimum distance of the set. It comes close to that of the hexagonal
// lattice, while the points stay irregular.
//
// Empty circles are centred at corners of Voronoi cells: each cell is stored with its farthest
// corner, in a tree that finds the farthest of all. A move recomputes the cells around the old and
// the new position, about 14 of them. With --bounded, the box's walls end the cells. Then many
// centres are on a wall or in a corner of the box, because distances are largest there.
//
// Once points are spread, the largest circle is mostly the one that the removed point has left, and
// all points move only slowly. Then a move overshoots the centre by 0.8 of its length, as in
// successive over-relaxation, unless that brings the point nearer to others than it was. So a
// minimum distance of 0.93 (hexagons: 1) takes 50 iterations, instead of 400.
//
// Shape   d = 2; any rectangle, torus or bounded. No density: we know of no variant for one that we
//         could check against its paper.
// Cost    20 us a move, n moves an iteration; 130 bytes a point.
// Promise the minimum distance never falls. A run ends early if no move of an iteration raises a
//         point's squared distance to its nearest neighbour by more than a part in 10^9.
// Source  T. Schloemer, D. Heck, O. Deussen, "Farthest-point optimized point sets with maximized
//         minimum distance", High Performance Graphics (2011), 135-142,
//         doi:10.1145/2018323.2018345 (its global variant).

#include <algorithm>
#include <bit>
#include <limits>

#include "core/machine/first_touch.hpp"
#include "generators/blue_noise/planar_start.hpp"
#include "generators/generator.hpp"
#include "math/neighbors/periodic_voronoi.hpp"

namespace stipple::generators::farthest_point {
namespace {

constexpr auto iterations = planar::iterations_option(50, "Maximum number of moves of every point");

constexpr Param<Choice> initial{.name = planar::initial.name,
                                .fallback = "random",
                                .choices = planar::initial.choices,
                                .help = "Points to start from; they are moved in this order"};

/// Maximum of n values that change one at a time.
class Tournament {
  public:
    Tournament(std::size_t n, const RunContext& run) : leaves_(std::bit_ceil(n)) {
        grow(best_, 2 * leaves_, run);
    }

    void set(std::size_t i, double value) {
        std::size_t node = leaves_ + i;
        best_[node] = value;
        for (node /= 2; node > 0; node /= 2) {
            const double largest = std::max(best_[2 * node], best_[2 * node + 1]);
            if (best_[node] == largest) break;
            best_[node] = largest;
        }
    }

    /// Index of the largest value; the lowest index among equals.
    [[nodiscard]] std::size_t winner() const {
        std::size_t node = 1;
        while (node < leaves_) node = 2 * node + (best_[2 * node] < best_[node]);
        return node - leaves_;
    }

  private:
    std::size_t leaves_;
    std::vector<double> best_;  ///< maxima of two children each; the root has index 1
};

class FarthestPoint {
  public:
    FarthestPoint(const Planar& planar, const std::vector<double>& rows, const RunContext& run)
        : n_(rows.size() / 2),
          sites_(planar.sides, planar.torus, n_, false, run),
          circles_(n_, run) {
        grow(corners_, n_, run);
        for (std::size_t i = 0; i < n_; ++i) {
            if (i % 1024 == 0) run.check_stop();
            sites_.insert(i, sites_.inside({rows[2 * i], rows[2 * i + 1]}));
        }
        std::vector<std::size_t> crowded;  // points that coincide with another one
        for (std::size_t i = 0; i < n_; ++i) {
            if (i % 1024 == 0) run.check_stop();
            refresh(i);
            if (cell_.empty()) crowded.push_back(i);
        }
        for (const std::size_t i : crowded) sites_.remove(i);
        for (const std::size_t i : crowded) {
            sites_.insert(i, farthest_place().at);
            refresh(i);
            refresh_all(neighbors(i));
        }
    }

    /// Moves the point to the centre of the largest gap; returns whether the gap's centre is
    /// farther from other points than the old position.
    bool improve(std::size_t i) {
        const Vec2 was = sites_[i];
        sites_.cut_cell(i, cell_);
        const double nearest = squared_nearest();
        const auto around = neighbors(i);
        sites_.remove(i);
        circles_.set(i, 0);
        refresh_all(around);
        const Place found = farthest_place();
        if (!overshoot(i, was, found.at, nearest)) sites_.insert(i, found.at);
        refresh(i);
        refresh_all(neighbors(i));
        return found.squared > nearest * (1 + 1e-9);
    }

    [[nodiscard]] const PeriodicVoronoi& sites() const { return sites_; }

  private:
    void refresh(std::size_t i) {
        sites_.cut_cell(i, cell_);
        circles_.set(i, cell_.squared_reach());
        if (!cell_.empty()) corners_[i] = cell_.farthest_corner();
    }

    void refresh_all(const std::vector<std::uint32_t>& around) {
        for (const std::uint32_t j : around) refresh(j);
    }

    /// Neighbours of site i, whose cell was cut last.
    std::vector<std::uint32_t> neighbors(std::size_t i) const {
        std::vector<std::uint32_t> around;
        for (const CellCorner& edge : cell_.corners())
            if (edge.site != i && edge.site != CellCorner::wall) around.push_back(edge.site);
        std::ranges::sort(around);
        around.erase(std::unique(around.begin(), around.end()), around.end());
        return around;
    }

    /// Squared distance from the last cut cell's site to its nearest site; infinite if there is
    /// none.
    [[nodiscard]] double squared_nearest() const {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [at, neighbor, site] : cell_.corners())
            if (site != CellCorner::wall)
                least = std::min(least, neighbor.x * neighbor.x + neighbor.y * neighbor.y);
        return least;
    }

    struct Place {
        Vec2 at;
        double squared;  ///< squared distance to the nearest site
    };
    [[nodiscard]] Place farthest_place() const {
        const std::size_t i = circles_.winner();
        const auto [x, y] = corners_[i];
        return {sites_.inside({sites_[i].x + x, sites_[i].y + y}), x * x + y * y};
    }

    /// If the largest gap is the one that point i has left, inserts the point beyond the gap's
    /// centre, unless it would be nearer to others than at `was`. Returns whether it was inserted.
    bool overshoot(std::size_t i, Vec2 was, Vec2 to, double nearest) {
        constexpr double beyond = 0.8;  // fraction of `step`; with 0, 8 times as many iterations
        const Vec2 step = sites_.shortest(was, to);
        if (step.x * step.x + step.y * step.y > nearest / 16) return false;
        sites_.insert(i, sites_.inside({to.x + beyond * step.x, to.y + beyond * step.y}));
        sites_.cut_cell(i, cell_);
        if (squared_nearest() >= nearest) return true;
        sites_.remove(i);
        return false;
    }

    std::size_t n_;
    PeriodicVoronoi sites_;
    std::vector<Vec2> corners_;  ///< farthest corner of each cell, relative to its site
    Tournament circles_;         ///< squared distance of each cell's farthest corner
    VoronoiCell cell_;
};

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    auto [planar, density, rows] =
        planar_start(plan, options, 130, "the farthest-point optimisation", run);
    const std::size_t n = rows.size() / 2;
    const auto sweeps = static_cast<std::uint64_t>(options[iterations]);
    run.tick(0, 1);
    FarthestPoint set(planar, rows, run);
    bool moved = n > 1;
    for (std::uint64_t sweep = 0; sweep < sweeps && moved; ++sweep) {
        moved = false;
        for (std::size_t i = 0; i < n; ++i) {
            if (i % 64 == 0) run.tick(sweep * n + i, sweeps * n);
            moved |= set.improve(i);
        }
    }
    run.tick(1, 1);
    return planar_points(plan, planar, set.sites());
}

}  // namespace

Generator unit() {
    return {.name = "farthest-point",
            .summary =
                "Points moved to the largest gap, one by one: minimum distance near its upper "
                "bound (blue noise)",
            .source = "Schloemer, Heck, Deussen 2011, doi:10.1145/2018323.2018345",
            .related = {"maximin"},
            .traits = planar_traits,
            .options = Schema(iterations, initial, planar::from, torus_option, bounded_option),
            .aliases = {"fpo", "farthest-point-optimization"},
            .plan = planar_plan,
            .set = make,
            .uses_seed = [](const Values& options) { return !options.given(planar::from); }};
}

}  // namespace stipple::generators::farthest_point
