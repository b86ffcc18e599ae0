// SPDX-License-Identifier: MIT
//
// Common parts of the samplers that work tile by tile: rounds of darts, and the exchange of points
// between tiles.
//
// Only one thread at a time changes a tile. In each round the tile first takes over the accepted
// darts of the last round, its own and those near its faces; then darts are thrown at the tile, and
// those that no point excludes are pending. After all tiles are done, pending darts are decided: a
// dart is kept unless an earlier one that is too near is kept, which is decided recursively, across
// tiles. The result does not depend on the order of decisions, and so not on threads.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/machine/memory.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "generators/poisson_disk/near_disks.hpp"
#include "generators/poisson_disk/pending_darts.hpp"
#include "generators/poisson_disk/poisson_counts.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// Accepted point that is added to a tile: its own, or a nearby one of another tile.
template <std::size_t D>
struct Addition {
    std::array<double, D> at;
    TileCell<D> cell;  ///< offset from the tile's first cell
    bool own;          ///< whether the point belongs to the tile's points()
};

/// Common part of all tiles: cells, neighbours, pending darts and points. The tile of a sampler
/// derives from it and has
///
///     take(additions)         adds accepted points, its own ones in the order of points();
///     drop()                  releases its memory, except for the points;
///     for_about(cell, visit)  calls visit(point, its cell) for points that may reach into a cell,
///                             until a call returns false.
template <std::size_t D, unsigned side_bits, unsigned block_bits>
class Tile {
  public:
    static constexpr std::size_t dimension = D;
    using Cell = TileCell<D>;
    using Index = typename Grid<D>::Index;
    using Point = typename Grid<D>::Point;
    using Pending = PendingDarts<D, side_bits, block_bits>;

    static constexpr int side = Pending::side;

    Tile() = default;
    Tile(const Grid<D>& grid, std::size_t number) {
        const auto [first, last] = grid.tile(number);
        first_ = first;
        for (std::size_t k = 0; k < D; ++k) size_[k] = static_cast<int>(last[k] - first[k]);
    }

    static std::uint16_t place_of(const Cell& cell) { return Pending::place_of(cell); }
    static Cell cell_at(std::uint16_t place) { return Pending::cell_at(place); }

    [[nodiscard]] const Index& first() const { return first_; }
    [[nodiscard]] int size(std::size_t k) const { return size_[k]; }
    [[nodiscard]] std::vector<double>& points() { return points_; }

    /// Sets `at` to the point `place` of a cell, given in cell sides from the cell's corner; false
    /// if a coordinate is rounded up to a face of the box.
    [[nodiscard]] bool locate(const Grid<D>& grid, const Cell& cell, const Point& place,
                              Point& at) const {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k) {
            at[k] = grid.low[k] + (first_[k] + (cell[k] + place[k])) * grid.widths[k];
            inside = inside && at[k] < grid.high[k];
        }
        return inside;
    }

    /// Position of a point in its cell, in cell sides from the cell's corner.
    /// @param cell offset of p's cell from the tile's first cell; on a torus maybe beyond the box
    [[nodiscard]] Point in_cell(const Grid<D>& grid, const Point& p, const Cell& cell) const {
        Point place;
        for (std::size_t k = 0; k < D; ++k) {
            const auto cells = std::int64_t{grid.cells[k]};
            std::int64_t in_box = std::int64_t{first_[k]} + cell[k];
            while (in_box < 0) in_box += cells;
            while (in_box >= cells) in_box -= cells;
            place[k] = (p[k] - grid.low[k]) / grid.widths[k] - static_cast<double>(in_box);
        }
        return place;
    }

    /// Slightly more points than are typical for the tile with `more` cells beyond each face.
    [[nodiscard]] std::size_t typical_points(const Grid<D>& grid, int more = 0) const {
        double mean = saturated_density[D];
        for (std::size_t k = 0; k < D; ++k) mean *= (size_[k] + 2 * more) * grid.scales[k];
        return static_cast<std::size_t>(mean + std::sqrt(mean) / 2 + 1);
    }

    /// A tile within a radius of this one, and the offset from this tile's first cell to the
    /// neighbour's. On a small torus, several neighbours may be images of one tile, or of this one.
    struct Neighbour {
        std::uint32_t number;
        Cell steps;
        unsigned faces = 0;  ///< faces of this tile on the neighbour's side: bit 2 k or 2 k + 1
    };
    std::vector<Neighbour> neighbours;
    std::array<Pending, 2> pending;  ///< darts of even and odd rounds
    std::vector<Gap<D>> gaps;        ///< possibly uncovered regions, once known

  protected:
    Index first_{};  ///< grid index of the first cell
    Cell size_{};
    std::vector<double> points_;
};

/// Buffers for the work on the gaps of a tile, one set per thread.
template <std::size_t D>
struct GapWorkspace {
    std::vector<PendingDart<D>> pending;
    std::vector<Gap<D>> gaps;  ///< remaining gaps of the tile
    NearDisks<D, float> near;
    NearDisks<D, float> reaching;
    NearDisks<D, double> exactly_near;
    NearDisks<D, double> exactly_reaching;
};

/// Whether the dart at `at` in a cell is too near to a point.
template <class T, std::size_t D>
bool hits_point(const T& tile, const Grid<D>& grid, const TileCell<D>& cell,
                const std::array<double, D>& at) {
    bool hit = false;
    tile.for_about(cell, [&](const std::array<double, D>& p, const TileCell<D>&) {
        hit = grid.too_near(p, at);
        return !hit;
    });
    return hit;
}

/// Makes a dart pending, unless it hit a point or is rounded up to a face of the box.
template <class T, std::size_t D>
void add_pending(const T& tile, const Grid<D>& grid, const TileCell<D>& cell,
                 const std::array<double, D>& place, Hit hit, std::uint64_t random,
                 std::vector<PendingDart<D>>& pending) {
    if (hit == Hit::yes) return;
    PendingDart<D> dart{{}, static_cast<std::uint32_t>(random >> 32), T::place_of(cell)};
    if (!tile.locate(grid, cell, place, dart.at)) return;
    if (hit == Hit::no || !hits_point(tile, grid, cell, dart.at)) pending.push_back(dart);
}

/// Draws darts on the open sub-cells of a gap, and calls draw(position in the cell) for each. Adds
/// gaps around the open sub-cells to `left`, for the next round.
template <std::size_t D, class Draw>
void throw_at_gap(const Gap<D>& gap, SubcellBits open, const PoissonCounts& counts,
                  SplitMix64& mixer, std::vector<Gap<D>>& left, const Draw& draw) {
    constexpr double enough = 2;  // mean number of darts from which on a gap is split
    const auto count = static_cast<std::size_t>(std::popcount(open));
    for (std::uint64_t darts = counts.draw(count, mixer); darts > 0; --darts)
        draw(place_in(gap, open, count, mixer));
    narrow(gap, open, counts.mean(count) >= enough, left);
}

/// @tparam T tile of a sampler @tparam Workspace GapWorkspace or derived from it
template <class T, class Workspace>
class TileRounds {
  public:
    static constexpr std::size_t D = T::dimension;
    using Cell = typename T::Cell;
    using Dart = PendingDart<D>;

    /// Number of levels of gaps.
    static constexpr std::size_t levels = 56;

    TileRounds(const Task<D>& task, const RunContext& run)
        : task_(task), run_(run), keys_(task.seed), tiles_(task.grid.tile_count) {
        open_.resize(tiles_.size());
        std::iota(open_.begin(), open_.end(), 0U);
    }

    template <class Make>
    void make_tiles(const Make& make) {
        for_open([&](T& tile, std::uint32_t number) {
            tile = make(number);
            find_neighbours(tile, number);
        });
    }

    /// One round: draw(tile, key, workspace) makes the pending darts of a tile.
    template <class Draw>
    void round(const Draw& draw) {
        const std::uint64_t key = keys_.bits(++round_);
        for_open([&](T& tile, std::uint32_t number) {
            Workspace& work = workspace();
            take_over(tile);
            work.pending.clear();
            draw(tile, SplitMix64(key + number).next(), work);
            of_round(tile, round_).renew(round_, work.pending);
        });
        for_open([&](T& tile, std::uint32_t) {
            for (const Dart& d : of_round(tile, round_).all())
                if (decide(tile, d) == Status::accepted)
                    tile.points().insert(tile.points().end(), d.at.begin(), d.at.end());
        });
        std::uint64_t count = 0;
        for (T& tile : tiles_) count += tile.points().size() / D;
        run_.tick(std::min(count, task_.expected), task_.expected);
    }

    /// Runs rounds until no tile has gaps. draw(tile, counts, key, workspace, first) throws the
    /// darts of a round and puts the remaining gaps into the workspace. `counts` has an entry for
    /// each level of gaps; `first` is true in the first round, when gaps are not known yet.
    /// @param density darts per r^D in the first round, multiplied by `growth` in each further one
    template <class Draw>
    void close_gaps(double density, double growth, const Draw& draw) {
        for (bool first = true; !open_.empty(); first = false, density *= growth) {
            std::vector<PoissonCounts> counts;
            double mean = to_a_subcell(density);
            for (std::size_t level = 0; level < levels;
                 ++level, mean /= static_cast<double>(power(2, D)))
                counts.emplace_back(mean, all_subcells<D>);
            round([&](T& tile, std::uint64_t key, Workspace& work) {
                work.gaps.clear();
                draw(tile, counts, key, work, first);
                tile.gaps = std::vector(work.gaps.begin(), work.gaps.end());
            });
            std::erase_if(open_, [&](std::uint32_t t) { return tiles_[t].gaps.empty(); });
        }
    }

    /// Mean number of darts on a sub-cell of a cell of maximum size, for `density` darts per r^D.
    static double to_a_subcell(double density) {
        return density / std::sqrt(static_cast<double>(power(D, D))) /
               static_cast<double>(all_subcells<D>);
    }

    /// Sub-cells of a gap that no single disk covers, to the accuracy of doubles.
    [[nodiscard]] SubcellBits exactly_open(const T& tile, const Gap<D>& gap,
                                           Workspace& work) const {
        const Grid<D>& grid = task_.grid;
        const Cell own = T::cell_at(gap.place);
        work.exactly_near.clear();
        tile.for_about(own, [&](const std::array<double, D>& p, const Cell& cell) {
            std::array<double, D> off = tile.in_cell(grid, p, cell);
            for (std::size_t k = 0; k < D; ++k)
                off[k] = (off[k] + cell[k] - own[k]) * grid.scales[k];
            work.exactly_near.add(off);
            return true;
        });
        work.exactly_near.close();
        return uncovered<D, double>(work.exactly_near, {gap, grid.scales}, grid.slack,
                                    work.exactly_reaching);
    }

    /// Whether a gap is too small for the arithmetic to resolve.
    [[nodiscard]] bool too_small(const Gap<D>& gap) const {
        bool small = gap.level + 1U >= levels;
        for (const double scale : task_.grid.scales)
            small = small || gap.side() * scale < 2 * task_.grid.slack;
        return small;
    }

    /// Points of all tiles, one tile after the other. Releases all other memory of the tiles first.
    Rows collect() {
        for (T& tile : tiles_) tile.drop();
        std::size_t numbers = 0;
        for (T& tile : tiles_) numbers += tile.points().size();
        Rows rows = Rows::unwritten(numbers, 1);
        auto out = rows.numbers().begin();
        for (T& tile : tiles_) {
            run_.check_stop();
            out = std::ranges::copy(tile.points(), out).out;
            release(tile.points());
        }
        return rows;
    }

  private:
    [[gnu::noinline]] static Workspace& workspace() {
        thread_local Workspace work;
        return work;
    }

    static auto& of_round(T& tile, std::uint64_t round) { return tile.pending[round % 2]; }

    /// Calls work(tile, number) for the tiles that may have gaps, on several threads.
    template <class Work>
    void for_open(const Work& work) {
        for_each_block(silent(run_), open_.size(), 1,
                       [&](const Block& b) { work(tiles_[open_[b.first]], open_[b.first]); });
    }

    /// Tiles along direction k within a radius of tile `own`, and their offsets from that tile.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, int>> neighbours_along(
        std::size_t k, std::uint32_t own) const {
        const Grid<D>& grid = task_.grid;
        const auto first = static_cast<std::int64_t>(grid.first_cell(k, own));
        const std::int64_t size = grid.first_cell(k, own + 1) - first;
        std::vector<std::pair<std::uint32_t, int>> found{{own, 0}};
        for (const int direction : {-1, 1}) {
            std::int64_t there = own;
            std::int64_t turns = 0;  // number of turns around the torus
            while (true) {
                there += direction;
                if (there < 0 || there >= grid.tiles[k]) {
                    if (!grid.torus) break;
                    turns += direction;
                    there -= direction * std::int64_t{grid.tiles[k]};
                }
                const auto t = static_cast<std::uint32_t>(there);
                const std::int64_t steps = turns * grid.cells[k] + grid.first_cell(k, t) - first;
                const std::int64_t end = turns * grid.cells[k] + grid.first_cell(k, t + 1) - first;
                if (steps >= size + grid.reach[k] || end <= -grid.reach[k]) break;
                found.emplace_back(t, static_cast<int>(steps));
            }
        }
        return found;
    }

    void find_neighbours(T& tile, std::size_t number) const {
        tile.neighbours = {{0, {}}};
        std::size_t stride = 1;
        for (std::size_t k = 0; k < D; ++k) {
            const auto own = static_cast<std::uint32_t>(number % task_.grid.tiles[k]);
            number /= task_.grid.tiles[k];
            std::vector<typename T::Neighbour> more;
            for (const auto& n : tile.neighbours)
                for (const auto& [there, steps] : neighbours_along(k, own)) {
                    more.push_back(n);
                    more.back().number += static_cast<std::uint32_t>(there * stride);
                    more.back().steps[k] = steps;
                    more.back().faces |= (steps < 0 ? 1U : steps > 0 ? 2U : 0U) << 2 * k;
                }
            tile.neighbours = std::move(more);
            stride *= task_.grid.tiles[k];
        }
    }

    /// Calls visit(other, steps) for a tile itself and its neighbours, `steps` cells away.
    template <class Visit>
    void for_neighbours(const T& tile, const Visit& visit) {
        for (const auto& n : tile.neighbours) visit(tiles_[n.number], n.steps);
    }

    /// Adds the darts accepted in the last round, in the tile itself and near it in other tiles.
    void take_over(T& tile) {
        thread_local std::vector<Addition<D>> additions;
        additions.clear();
        const std::uint64_t last = round_ - 1;
        for_neighbours(tile, [&](T& other, const Cell& steps) {
            if (!of_round(other, last).of(last)) return;
            const bool own = &tile == &other && steps == Cell{};
            Cell low;
            Cell high;
            for (std::size_t k = 0; k < D; ++k) {
                low[k] = -task_.grid.reach[k] - steps[k];
                high[k] = tile.size(k) + task_.grid.reach[k] - 1 - steps[k];
            }
            of_round(other, last).any(low, high, [&](const Dart& d) {
                if (d.status() != Status::accepted) return false;
                Addition<D> added{d.at, T::cell_at(d.place), own};
                bool in = true;
                for (std::size_t k = 0; k < D; ++k) {
                    in = in && added.cell[k] >= low[k] && added.cell[k] <= high[k];
                    added.cell[k] += steps[k];
                }
                if (in) additions.push_back(added);
                return false;
            });
        });
        tile.take(std::span<const Addition<D>>(additions));
    }

    /// Decides a dart: it is kept unless an earlier one that is too near is kept. A dart that is
    /// kept rejects the later ones near it, which then need no search of their own.
    Status decide(T& tile, const Dart& d) {
        if (const Status known = d.status(); known != Status::pending) return known;
        std::array<const Dart*, 32> later;  // more than 32 are rare, and decided separately
        std::size_t later_count = 0;
        const bool ruled_out = any_near(tile, d, [&](T& there, const Dart& other) {
            if (&other == &d || other.status() == Status::rejected) return false;
            if (!task_.grid.too_near(other.at, d.at)) return false;
            if (other.before(d)) return decide(there, other) == Status::accepted;
            if (later_count < later.size()) later[later_count++] = &other;
            return false;
        });
        d.set(ruled_out ? Status::rejected : Status::accepted);
        for (std::size_t i = 0; i < later_count && !ruled_out; ++i) later[i]->set(Status::rejected);
        return d.status();
    }

    /// Whether is(tile, dart) is true for any dart of the round that may be too near to d.
    template <class Is>
    bool any_near(T& tile, const Dart& d, const Is& is) {
        const Cell own = T::cell_at(d.place);
        const auto& reach = task_.grid.reach;
        unsigned faces = 0;  // faces of the tile within a radius of d
        for (std::size_t k = 0; k < D; ++k) {
            if (own[k] < reach[k]) faces |= 1U << 2 * k;
            if (own[k] >= tile.size(k) - reach[k]) faces |= 2U << 2 * k;
        }
        for (const auto& [number, steps, beyond] : tile.neighbours) {
            T& there = tiles_[number];
            auto& darts = of_round(there, round_);
            if ((beyond & ~faces) != 0 || !darts.of(round_)) continue;
            Cell low;
            Cell high;
            for (std::size_t k = 0; k < D; ++k) {
                low[k] = own[k] - steps[k] - reach[k];
                high[k] = own[k] - steps[k] + reach[k];
            }
            if (darts.any(low, high, [&](const Dart& other) { return is(there, other); }))
                return true;
        }
        return false;
    }

    Task<D> task_;
    RunContext run_;
    Rng keys_;
    std::vector<T> tiles_;
    std::vector<std::uint32_t> open_;  ///< indices of tiles that may have gaps
    std::uint64_t round_ = 0;
};

}  // namespace stipple::poisson_disk
