// SPDX-License-Identifier: MIT
//
// The points of a disk set as it grows, and the darts that may join them, tile by tile; and what
// there is of them about a place. Two ways of looking: CellTiles goes from cell to cell, as is
// quick in two and three dimensions; FewTiles goes through whole tiles, of which there are fewer
// than there would be cells in more dimensions.
//
// In each phase of a shower a tile is changed by one thread alone, and read by others only in what
// that phase leaves as it is.
#pragma once

#include <vector>

#include "core/parallel.hpp"
#include "generators/poisson_disk/dart_fate.hpp"
#include "generators/poisson_disk/disk_covers.hpp"
#include "generators/poisson_disk/disk_grid.hpp"
#include "generators/poisson_disk/disk_window.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple {

/// A dart that is far enough from all older points.
template <std::size_t D>
struct Candidate {
    std::array<double, D> at;
    std::array<float, D> off;  ///< from the corner of its cell, in radii
    std::uint32_t time;        ///< within the shower
    std::uint16_t place;       ///< of its cell in the tile
    std::uint16_t next;        ///< the next one of the same cell in order of time, from 1 on

    [[nodiscard]] bool before(const Candidate& other) const {
        return time < other.time || (time == other.time && at < other.at);
    }
};

template <std::size_t D>
struct DiskTile {
    typename DiskGrid<D>::Index first;  ///< cell
    typename DiskGrid<D>::Index last;   ///< the cell behind the last
    std::vector<Window<D>> windows = {};
    std::vector<Candidate<D>> candidates = {};
    std::vector<SharedFate> fates = {};  ///< of the candidates
    std::vector<double> points = {};
};

/// What one thread needs to work on a tile.
template <std::size_t D>
struct Desk {
    NearDisks<D, float> near;
    NearDisks<D, float> reaching;
    NearDisks<D, double> exactly_near;
    NearDisks<D, double> exactly_reaching;
    std::vector<Candidate<D>> candidates;
    std::vector<Window<D>> windows;
    std::vector<std::array<double, D>> about;  ///< points that reach into the tile, in cells from
                                               ///< its first (FewTiles)
};

template <std::size_t D>
class TilesBase {
  public:
    using Grid = DiskGrid<D>;
    using Point = typename Grid::Point;
    using Index = typename Grid::Index;
    using Tile = DiskTile<D>;

    explicit TilesBase(const Grid& grid) : grid_(grid) {
        for (std::size_t t = 0; t < grid.tile_count; ++t) {
            const auto [first, last] = grid.tile(t);
            tiles_.push_back({.first = first, .last = last});
        }
    }

    [[nodiscard]] std::vector<Tile>& all() { return tiles_; }

    [[nodiscard]] bool too_near(const double* p, const double* q) const {
        return squared_distance<D>(p, q, grid_.sides, grid_.torus) < grid_.radius * grid_.radius;
    }

  protected:
    const Grid& grid_;
    std::vector<Tile> tiles_;
};

/// For two and three dimensions, and grids of few cells or such that a radius leads across more
/// than two.
template <std::size_t D>
class CellTiles : public TilesBase<D> {
    using Base = TilesBase<D>;
    using Base::grid_;
    using Base::tiles_;

  public:
    using typename Base::Grid;
    using typename Base::Index;
    using typename Base::Point;
    using typename Base::Tile;
    using Off = std::array<float, D>;

    static constexpr bool knows_parts = true;

    explicit CellTiles(const Grid& grid) : Base(grid), covers_(grid) {
        heads_.resize(grid.spots);
        places_.resize(grid.spots);
        taken_.resize(grid.spots);
        pending_.resize(grid.spots);
    }

    /// Parts that a point covers alone, of a cell and those behind it along the first direction.
    [[nodiscard]] const PartBits* covered(const Index& cell) const {
        return covers_.row(grid_.spot_of(cell));
    }

    /// Whether a point is known to cover a place of a cell.
    [[nodiscard]] bool covers(const Index& cell, const Point& place) const {
        return covers_.covers(grid_.spot_of(cell), place);
    }

    /// Gets a desk ready for a tile.
    void prepare(const Tile&, Desk<D>&) const {}

    [[nodiscard]] bool taken(const Index& cell) const { return taken_[grid_.spot_of(cell)] != 0; }

    /// Points that reach into a cell, and some more.
    void gather(const Tile&, const Index& cell, const Desk<D>&, NearDisks<D, float>& near) const {
        near.clear();
        grid_.around(cell, [&](const Index& there, const Point& steps) {
            if (!taken(there)) return;
            auto p = places_[grid_.spot_of(there)];
            for (std::size_t k = 0; k < D; ++k)
                p[k] += static_cast<float>(steps[k] * grid_.scales[k]);
            near.add(p);
        });
        near.close();
    }

    void gather(const Tile&, const Index& cell, const Desk<D>&, NearDisks<D, double>& near) const {
        near.clear();
        grid_.around(cell, [&](const Index& there, const Point& steps) {
            const double* p = point_in(there);
            if (p == nullptr) return;
            Point off;
            for (std::size_t k = 0; k < D; ++k)
                off[k] = ((p[k] - grid_.low[k]) / grid_.widths[k] - there[k] + steps[k]) *
                         grid_.scales[k];
            near.add(off);
        });
        near.close();
    }

    /// Whether a point is too near to p, which is in the cell, to the last digit.
    [[nodiscard]] bool hits(const Tile&, const Index& cell, const double* p) const {
        bool hit = false;
        grid_.around(cell, [&](const Index& there, const Point&) {
            const double* q = point_in(there);
            hit = hit || (q != nullptr && this->too_near(p, q));
        });
        return hit;
    }

    /// Gives back all memory but that of the points.
    void clear_cells() {
        heads_ = {};
        places_ = {};
        taken_ = {};
        pending_ = {};
        covers_.clear();
    }

    /// Forgets the candidates of the shower before, in all tiles; in one.
    void start_over() { std::ranges::fill(pending_, 0); }
    void start_over(Tile& tile) const { tile.candidates.clear(); }

    /// Adds a candidate, for others to find.
    void add(Tile& tile, const Index& cell, Candidate<D> c) {
        const std::size_t number = grid_.spot_of(cell);
        if (pending_[number] == 0) heads_[number] = 0;
        pending_[number] = 1;
        auto& all = tile.candidates;
        std::uint16_t* link = &heads_[number];
        while (*link != 0 && all[*link - 1U].before(c)) link = &all[*link - 1U].next;
        c.next = *link;
        *link = static_cast<std::uint16_t>(all.size() + 1);
        all.push_back(c);
    }

    /// Calls visit(tile, number) for candidates that fell before c and are too near to it, until
    /// that is true; returns whether it ever was.
    template <class Visit>
    [[nodiscard]] bool any_before(const Tile& tile, const Candidate<D>& c, const Visit& visit) {
        bool found = false;
        grid_.around(Grid::cell_at(tile.first, c.place), [&](const Index& there, const Point&) {
            found = found || (pending_[grid_.spot_of(there)] != 0 && any_in(there, c, visit));
        });
        return found;
    }

    /// Makes the candidates that stay points.
    void settle(Tile& tile, bool shared) {
        for (std::size_t i = 0; i < tile.candidates.size(); ++i) {
            if (tile.fates[i].get() != stays) continue;
            const Candidate<D>& c = tile.candidates[i];
            const Index cell = Grid::cell_at(tile.first, c.place);
            const std::size_t number = grid_.spot_of(cell);
            heads_[number] = static_cast<std::uint16_t>(tile.points.size() / D);
            tile.points.insert(tile.points.end(), c.at.begin(), c.at.end());
            places_[number] = c.off;
            taken_[number] = 1;
            covers_.add(cell, c.off, shared);
        }
    }

  private:
    /// The point of a cell, or nullptr.
    [[nodiscard]] const double* point_in(const Index& cell) const {
        if (!taken(cell)) return nullptr;
        return tiles_[grid_.tile_of(cell)].points.data() + heads_[grid_.spot_of(cell)] * D;
    }

    template <class Visit>
    [[nodiscard]] bool any_in(const Index& cell, const Candidate<D>& c, const Visit& visit) {
        Tile& tile = tiles_[grid_.tile_of(cell)];
        const auto& all = tile.candidates;
        for (std::uint16_t i = heads_[grid_.spot_of(cell)]; i != 0; i = all[i - 1U].next) {
            const Candidate<D>& other = all[i - 1U];
            if (!other.before(c)) return false;
            if (this->too_near(other.at.data(), c.at.data()) && visit(tile, i - 1U)) return true;
        }
        return false;
    }

    std::vector<std::uint16_t>
        heads_;                ///< of a cell: its point's number, or that of its first candidate
    std::vector<Off> places_;  ///< of a cell's point, from its corner, in radii
    std::vector<std::uint8_t> taken_;    ///< of a cell: whether it has a point
    std::vector<std::uint8_t> pending_;  ///< of a cell: whether it has candidates
    DiskCovers<D> covers_;
};

/// For many dimensions.
template <std::size_t D>
class FewTiles : public TilesBase<D> {
    using Base = TilesBase<D>;
    using Base::grid_;
    using Base::tiles_;

  public:
    using typename Base::Grid;
    using typename Base::Index;
    using typename Base::Point;
    using typename Base::Tile;

    using Base::Base;

    static constexpr bool knows_parts = false;

    void prepare(const Tile& tile, Desk<D>& desk) const {
        desk.about.clear();
        for_near(tile, [&](std::size_t other, const Point& shift) {
            const auto& points = tiles_[other].points;
            for (std::size_t i = 0; i < points.size(); i += D) {
                Point p;
                double gap = 0;
                for (std::size_t k = 0; k < D; ++k) {
                    p[k] =
                        (points[i + k] - grid_.low[k]) / grid_.widths[k] - tile.first[k] + shift[k];
                    const double size = tile.last[k] - tile.first[k];
                    const double out = std::max({-p[k], p[k] - size, 0.0}) * grid_.scales[k];
                    gap += out * out;
                }
                if (gap < reaching) desk.about.push_back(p);
            }
        });
    }

    /// Whether a cell is known to have a point; nothing is known here.
    [[nodiscard]] bool taken(const Index&) const { return false; }

    template <class Real>
    void gather(const Tile& tile, const Index& cell, const Desk<D>& desk,
                NearDisks<D, Real>& near) const {
        near.clear();
        for (const Point& p : desk.about) {
            std::array<Real, D> off;
            double gap = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const double x = (p[k] - (cell[k] - tile.first[k])) * grid_.scales[k];
                const double out = std::max({-x, x - grid_.scales[k], 0.0});
                gap += out * out;
                off[k] = static_cast<Real>(x);
            }
            if (gap < reaching) near.add(off);
        }
        near.close();
    }

    [[nodiscard]] bool hits(const Tile& tile, const Index&, const double* p) const {
        bool hit = false;
        for_near(tile, [&](std::size_t other, const Point&) {
            const auto& points = tiles_[other].points;
            for (std::size_t i = 0; i < points.size() && !hit; i += D)
                hit = this->too_near(p, points.data() + i);
        });
        return hit;
    }

    void clear_cells() const {}
    void start_over() const {}
    void start_over(Tile& tile) const { tile.candidates.clear(); }

    void add(Tile& tile, const Index&, const Candidate<D>& c) const {
        tile.candidates.push_back(c);
    }

    template <class Visit>
    [[nodiscard]] bool any_before(const Tile& tile, const Candidate<D>& c, const Visit& visit) {
        bool found = false;
        for_near(tile, [&](std::size_t other, const Point&) {
            Tile& there = tiles_[other];
            for (std::size_t i = 0; i < there.candidates.size() && !found; ++i) {
                const Candidate<D>& q = there.candidates[i];
                found = q.before(c) && this->too_near(q.at.data(), c.at.data()) && visit(there, i);
            }
        });
        return found;
    }

    void settle(Tile& tile, bool) {
        for (std::size_t i = 0; i < tile.candidates.size(); ++i)
            if (tile.fates[i].get() == stays)
                tile.points.insert(tile.points.end(), tile.candidates[i].at.begin(),
                                   tile.candidates[i].at.end());
    }

  private:
    static constexpr double reaching = 1 + 1e-9;  ///< squared, with room for rounding

    /// Calls visit(number, shift) for the tiles from which a radius leads into this one; on a small
    /// torus more than once for the same, with different shifts (in cells).
    template <class Visit>
    void for_near(const Tile& tile, const Visit& visit) const {
        Point shift{};
        for_near<D>(tile, 0, shift, visit);
    }
    template <std::size_t K, class Visit>
    void for_near(const Tile& tile, std::size_t number, Point& shift, const Visit& visit) const {
        if constexpr (K == 0) {
            visit(number, shift);
        } else {
            const std::int64_t all = grid_.cells[K - 1];
            const std::int64_t far = grid_.reach[K - 1];
            const std::int64_t images = grid_.torus ? 1 : 0;
            for (std::int64_t image = -images; image <= images; ++image)
                for (std::uint32_t t = 0; t < grid_.tiles[K - 1]; ++t) {
                    const std::int64_t first = std::int64_t{t} * Grid::tile_side;
                    const std::int64_t last = std::min<std::int64_t>(first + Grid::tile_side, all);
                    const std::int64_t by = image * all;
                    if (last + by + far <= tile.first[K - 1]) continue;
                    if (first + by - far >= tile.last[K - 1]) continue;
                    shift[K - 1] = static_cast<double>(by);
                    for_near<K - 1>(tile, number * grid_.tiles[K - 1] + t, shift, visit);
                }
        }
    }
};

}  // namespace stipple
