// SPDX-License-Identifier: MIT
//
// The points of a disk set as it grows, and the darts that may join them, tile by tile; and what
// there is of them about a place. Two ways of looking: CellTiles goes from cell to cell, which is
// quick in two and three dimensions; FewTiles goes through whole tiles, of which there are fewer
// than there would be cells in more dimensions.
//
// In each phase of a shower a tile is changed by one thread alone, and read by others only in what
// that phase leaves as it is.
#pragma once

#include <bit>
#include <cstring>
#include <vector>

#include "core/large_pages.hpp"
#include "core/parallel.hpp"
#include "generators/disk_bits.hpp"
#include "generators/disk_covers.hpp"
#include "generators/disk_grid.hpp"
#include "generators/disk_window.hpp"
#include "generators/near_disks.hpp"

namespace stipple {

/// A dart that is far enough from all older points.
template <std::size_t D>
struct Candidate {
    std::array<double, D> at;
    std::uint32_t time;   ///< within the shower
    std::uint16_t place;  ///< of its cell in the tile
    std::uint16_t next;   ///< the next one of the same cell in order of time, from 1 on

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
    std::vector<std::uint8_t> fates = {};  ///< of the candidates
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

/// For two and three dimensions: a bit for each cell says whether it has a point, and another
/// whether it has candidates.
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

    explicit CellTiles(const Grid& grid) : Base(grid), taken_(grid), pending_(grid), covers_(grid) {
        for (std::size_t k = 0; k < D; ++k) {
            to_parts_[k] = static_cast<float>(double{cell_parts<D>} / grid.scales[k]);
            plain_ = plain_ && grid.reach[k] == 2 && grid.cells[k] > 4;
        }
        fill_with_zeros(heads_, grid.spots);
        fill_with_zeros(places_, grid.spots);
        for (std::size_t b = 0; b < about_.size(); ++b) look_at(b);
        for (std::size_t part = 0; part < parts_of_cell; ++part)
            for (std::size_t b = 0; b < about_.size(); ++b)
                if (reaches(b, part)) masks_[part][b / layer] |= Word{1} << (b % layer);
        for (std::size_t set = 0; set < unions_.size(); ++set)
            for (std::size_t part = 0; part < parts_of_cell; ++part)
                for (std::size_t z = 0; (set >> half_of(part) & 1) != 0 && z < layers; ++z)
                    unions_[set][z] |= masks_[part][z];
    }

    /// Asks for the cells of a row that is soon reached from this one; always inline, since GCC
    /// takes a call that does nothing but fetch for one that does nothing.
    [[gnu::always_inline]] void fetch_row(const Tile& tile, const Index& row) const {
        constexpr std::uint32_t ahead = 5;
        constexpr std::size_t line = 64;  // bytes
        Index there = row;
        there[1] += ahead;
        if (there[1] >= grid_.cells[1]) return;
        there[0] = tile.first[0];
        const std::size_t length = tile.last[0] - tile.first[0];
        const std::size_t spot = grid_.spot_of(there);
        for (std::size_t i = 0; i < length; i += line / sizeof(PartBits)) covers_.fetch(spot + i);
        for (std::size_t i = 0; i < length; i += line / sizeof(Off))
            __builtin_prefetch(&places_[spot + i]);
        for (std::size_t i = 0; i < length; i += line / 2) __builtin_prefetch(&heads_[spot + i]);
    }

    /// The same for candidates, which lie in order of their rows, as the i-th is reached.
    [[gnu::always_inline]] void fetch_about(const Tile& tile, std::size_t i) const {
        const auto row = [&](std::size_t j) { return tile.candidates[j].place >> Grid::tile_bits; };
        if (i == 0 || row(i) == row(i - 1)) return;
        fetch_row(tile, Grid::cell_at(tile.first, tile.candidates[i].place));
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

    [[nodiscard]] bool taken(const Index& cell) const { return taken_.has(cell); }

    /// Points that reach into these halves of a cell (halves_of), and some more.
    void gather(const Index& cell, Halves halves, NearDisks<D, float>& near) const {
        near.clear();
        if (plain_) {
            const std::size_t at = grid_.spot_of(cell);
            for_bits(taken_, cell, unions_[halves], [&](const Neighbour& n) {
                auto p = places_[at + static_cast<std::size_t>(n.cells)];
                for (std::size_t k = 0; k < D; ++k) p[k] += n.off[k];
                near.add(p);
                return true;
            });
        } else {
            grid_.around(cell, [&](const Index& there, const Point& steps) {
                if (!taken(there)) return;
                auto p = places_[grid_.spot_of(there)];
                for (std::size_t k = 0; k < D; ++k)
                    p[k] += static_cast<float>(steps[k] * grid_.scales[k]);
                near.add(p);
            });
        }
        near.close();
    }

    /// Whether a point covers the place at `off` from a cell's corner.
    [[nodiscard]] Hit hit_at(const Index& cell, const Off& off, Desk<D>& desk) const {
        if (!plain_) {
            gather(cell, all_halves<D>, desk.near);
            return stipple::hits<D, float>(desk.near, off, float_slack);
        }
        const std::size_t at = grid_.spot_of(cell);
        Hit hit = Hit::no;
        for_bits(taken_, cell, masks_[part_of(off)], [&](const Neighbour& n) {
            const float squared = squared_from(at, n, off);
            if (squared < 1 + float_slack) hit = squared < 1 - float_slack ? Hit::yes : Hit::unsure;
            return hit != Hit::yes;
        });
        return hit;
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
        taken_.drop();
        pending_.drop();
        covers_.clear();
    }

    /// Forgets the candidates of the shower before, in all tiles; in one.
    void start_over() { pending_.clear(); }
    void start_over(Tile& tile) const { tile.candidates.clear(); }

    /// Adds a candidate, for others to find.
    void add(Tile& tile, const Index& cell, const Off& off, Candidate<D> c, bool shared) {
        const std::size_t number = grid_.spot_of(cell);
        if (!pending_.has_meanwhile(cell)) {
            mark(pending_, cell, number, off, shared);
            heads_[number] = 0;
        } else {
            mark(pending_, cell, number, {not_one}, shared);
        }
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
        const Index cell = Grid::cell_at(tile.first, c.place);
        bool found = false;
        if (plain_) {
            const std::size_t at = grid_.spot_of(cell);
            const Off off = off_of(cell, at, c);
            const bool alone = !std::isnan(places_[at][0]);
            for_bits(pending_, cell, masks_[part_of(off)], [&](const Neighbour& n) {
                if (squared_from(at, n, off) > 1 + float_slack) return true;
                if (n.cells == 0 && alone) return true;
                found = any_in(stepped(cell, n), c, visit);
                return !found;
            });
        } else {
            grid_.around(cell, [&](const Index& there, const Point&) {
                found = found || (pending_.has(there) && any_in(there, c, visit));
            });
        }
        return found;
    }

    /// Makes the candidates that stay points.
    void settle(Tile& tile, std::uint8_t stays, bool shared) {
        for (std::size_t i = 0; i < tile.candidates.size(); ++i) {
            fetch_about(tile, i);
            if (tile.fates[i] != stays) continue;
            const Candidate<D>& c = tile.candidates[i];
            const Index cell = Grid::cell_at(tile.first, c.place);
            const std::size_t number = grid_.spot_of(cell);
            heads_[number] = static_cast<std::uint16_t>(tile.points.size() / D);
            tile.points.insert(tile.points.end(), c.at.begin(), c.at.end());
            const Off off = off_of(cell, number, c);
            mark(taken_, cell, number, off, shared);
            covers_.add(cell, off, shared && !inside(tile, cell));
        }
    }

  private:
    using Word = typename CellBits<D>::Word;
    static constexpr std::size_t layers = CellBits<D>::layers;
    static constexpr std::size_t layer = CellBits<D>::layer_bits;
    using Masks = std::array<Word, layers>;                      ///< bits of cells
    static constexpr std::array<std::size_t, 5> nearest_first =  ///< layers
        D == 2 ? std::array<std::size_t, 5>{} : std::array<std::size_t, 5>{2, 1, 3, 0, 4};
    static constexpr float not_one = std::numeric_limits<float>::quiet_NaN();  ///< place of several

    /// One of the 5^D cells about another.
    struct Neighbour {
        std::array<int, D> steps;
        std::array<float, D> off;  ///< of its corner, in radii
        std::ptrdiff_t cells = 0;  ///< the same as a difference of spots
    };

    void look_at(std::size_t b) {
        Neighbour& n = about_[b];
        const std::array<std::size_t, 3> along{b % 8, b % layer / 8, b / layer};
        for (std::size_t k = 0; k < D; ++k) {
            n.steps[k] = static_cast<int>(along[k]) - 2;
            n.off[k] = static_cast<float>(n.steps[k] * grid_.scales[k]);
            n.cells += n.steps[k] * static_cast<std::ptrdiff_t>(grid_.strides[k]);
        }
    }

    /// Whether a disk in a neighbour can reach into a part of a cell.
    [[nodiscard]] bool reaches(std::size_t b, std::size_t part) const {
        constexpr std::size_t p = cell_parts<D>;
        double gap = 0;
        for (std::size_t k = 0; k < D; ++k, part /= p) {
            const double low = static_cast<double>(part % p) / double{p};
            const double step = about_[b].steps[k];
            const double apart = std::max({step - low - 1 / double{p}, low - step - 1, 0.0});
            gap += apart * apart * grid_.scales[k] * grid_.scales[k];
        }
        return gap < 1 + float_slack;
    }

    /// The half of a cell along every direction that a part is in, as halves_of counts them.
    [[nodiscard]] static std::size_t half_of(std::size_t part) {
        constexpr std::size_t p = cell_parts<D>;
        std::size_t half = 0;
        for (std::size_t k = 0; k < D; ++k, part /= p) half |= part % p / (p / 2) << k;
        return half;
    }

    /// The part of a cell that a place is in.
    [[nodiscard]] std::size_t part_of(const Off& off) const {
        std::size_t part = 0;
        for (std::size_t k = D; k-- > 0;) {
            const auto along = static_cast<std::size_t>(off[k] * to_parts_[k]);
            part = part * cell_parts<D> + std::min(along, cell_parts<D> - 1);
        }
        return part;
    }

    /// Where a step leads, around the torus.
    [[nodiscard]] Index stepped(const Index& cell, const Neighbour& n) const {
        Index there;
        for (std::size_t k = 0; k < D; ++k) {
            there[k] = cell[k] + static_cast<std::uint32_t>(n.steps[k]);
            if (there[k] >= grid_.cells[k])
                there[k] += n.steps[k] < 0 ? grid_.cells[k] : -grid_.cells[k];
        }
        return there;
    }

    /// Keeps the place of a cell's point or candidate, and sets its bit.
    void mark(CellBits<D>& bits, const Index& cell, std::size_t spot, const Off& off, bool shared) {
        Index counted;
        for (std::size_t k = 0; k < D; ++k) counted[k] = cell[k] + 2;
        places_[spot] = off;
        bits.set(counted, shared);
        if (!grid_.interior(cell))
            for_images(counted, [&](const Index& image, std::size_t at) {
                places_[at] = off;
                bits.set(image, shared);
            });
    }

    /// Calls visit(counted, spot) where a cell appears again beyond the faces of a torus.
    template <class Visit>
    [[gnu::noinline]] void for_images(const Index& counted, const Visit& visit) const {
        if (plain_ && grid_.torus) images<D>(counted, false, visit);
    }
    template <std::size_t K, class Visit>
    void images(const Index& counted, bool moved, const Visit& visit) const {
        if constexpr (K == 0) {
            std::size_t spot = 0;
            for (std::size_t k = 0; k < D; ++k) spot += counted[k] * grid_.strides[k];
            if (moved) visit(counted, spot);
        } else {
            images<K - 1>(counted, moved, visit);
            const std::uint32_t all = grid_.cells[K - 1];
            if (counted[K - 1] >= 4 && counted[K - 1] < all) return;
            Index other = counted;
            other[K - 1] += other[K - 1] < 4 ? all : -all;
            images<K - 1>(other, true, visit);
        }
    }

    /// Calls visit(neighbour) where the bit is set, as long as that is true.
    template <class Visit>
    void for_bits(const CellBits<D>& bits, const Index& cell, const Masks& masks,
                  const Visit& visit) const {
        const auto around = bits.about(cell);
        for (std::size_t i = 0; i < layers; ++i) {
            const std::size_t z = nearest_first[i];
            Word found = bits.layer(around, z) & masks[z];
            for (; found != 0; found &= found - 1) {
                const auto bit = static_cast<std::size_t>(std::countr_zero(found));
                if (!visit(about_[layer * z + bit])) return;
            }
        }
    }

    /// Where in its cell a candidate is.
    [[nodiscard]] Off off_of(const Index& cell, std::size_t number, const Candidate<D>& c) const {
        Off off = places_[number];
        if (!std::isnan(off[0])) return off;
        for (std::size_t k = 0; k < D; ++k)
            off[k] = static_cast<float>(((c.at[k] - grid_.low[k]) / grid_.widths[k] - cell[k]) *
                                        grid_.scales[k]);
        return off;
    }

    /// Squared distance of a place from what places_ has of the neighbour.
    [[nodiscard]] float squared_from(std::size_t at, const Neighbour& n, const Off& off) const {
        const Off& p = places_[at + static_cast<std::size_t>(n.cells)];
        float squared = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const float along = p[k] + n.off[k] - off[k];
            squared += along * along;
        }
        return squared;
    }

    /// Whether no other tile's points reach the cells that a point of this cell reaches.
    [[nodiscard]] static bool inside(const Tile& tile, const Index& cell) {
        bool in = true;
        for (std::size_t k = 0; k < D; ++k)
            in &= cell[k] >= tile.first[k] + 4 && cell[k] + 4 < tile.last[k];
        return in;
    }

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

    bool plain_ = true;  ///< a radius leads across two cells, along all directions
    std::vector<std::uint16_t>
        heads_;                ///< of a cell: its point's number, or that of its first candidate
    std::vector<Off> places_;  ///< of a cell's point or only candidate, from its corner, in radii
    CellBits<D> taken_;
    CellBits<D> pending_;
    DiskCovers<D> covers_;
    std::array<Neighbour, layers * layer> about_{};
    Off to_parts_{};  ///< from radii
    /// For each part of a cell from which neighbours a disk reaches into it.
    std::array<Masks, parts_of_cell> masks_{};
    std::array<Masks, all_halves<D> + 1> unions_{};  ///< the same for sets of halves
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

    void fetch_row(const Tile&, const Index&) const {}
    void fetch_about(const Tile&, std::size_t) const {}

    void add(Tile& tile, const Index&, const std::array<float, D>&, const Candidate<D>& c,
             bool) const {
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

    void settle(Tile& tile, std::uint8_t stays, bool) {
        for (std::size_t i = 0; i < tile.candidates.size(); ++i)
            if (tile.fates[i] == stays)
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
