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

#include "core/parallel.hpp"
#include "generators/disk_grid.hpp"
#include "generators/disk_window.hpp"
#include "generators/near_disks.hpp"

namespace stipple {

/// A dart that is far enough from all older points.
template <std::size_t D>
struct Candidate {
    std::array<double, D> at;
    std::array<float, D> off;  ///< from its cell's corner, in radii
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

    explicit CellTiles(const Grid& grid)
        : Base(grid),
          pitch_((grid.cells[0] + 63) / 64 * 8),
          heads_(grid.cell_count),
          places_(grid.cell_count),
          taken_(grid.cell_count / grid.cells[0] * pitch_ + 8),
          pending_(taken_) {
        for (std::size_t b = 0; b < about_.size(); ++b) look_at(b);
    }

    /// Gets a desk ready for a tile.
    void prepare(const Tile&, Desk<D>&) const {}

    [[nodiscard]] bool taken(const Index& cell) const { return has(taken_, cell); }

    /// Points that reach into a cell, and some more.
    void gather(const Tile&, const Index& cell, const Desk<D>&, NearDisks<D, float>& near) const {
        near.clear();
        if (grid_.interior(cell)) {
            const std::size_t at = grid_.number_of(cell);
            for_bits(taken_, cell, [&](const Neighbour& n) {
                auto p = places_[at + static_cast<std::size_t>(n.cells)];
                for (std::size_t k = 0; k < D; ++k) p[k] += n.off[k];
                near.add(p);
                return true;
            });
        } else {
            grid_.around(cell, [&](const Index& there, const Point& steps) {
                if (!taken(there)) return;
                auto p = places_[grid_.number_of(there)];
                for (std::size_t k = 0; k < D; ++k)
                    p[k] += static_cast<float>(steps[k] * grid_.scales[k]);
                near.add(p);
            });
        }
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

    /// Lets the tile's candidates be found.
    void publish(Tile& tile) {
        auto& all = tile.candidates;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Index cell = Grid::cell_at(tile.first, all[i].place);
            std::uint16_t* link = &heads_[grid_.number_of(cell)];
            if (*link == 0) flip(pending_, cell);
            while (*link != 0 && all[*link - 1U].before(all[i])) link = &all[*link - 1U].next;
            all[i].next = *link;
            *link = static_cast<std::uint16_t>(i + 1);
        }
    }

    /// Calls visit(tile, number) for candidates that fell before c and are too near to it, until
    /// that is true; returns whether it ever was.
    template <class Visit>
    [[nodiscard]] bool any_before(const Tile& tile, const Candidate<D>& c, const Visit& visit) {
        const Index cell = Grid::cell_at(tile.first, c.place);
        bool found = false;
        if (grid_.interior(cell)) {
            for_bits(pending_, cell, [&](const Neighbour& n) {
                Index there;
                for (std::size_t k = 0; k < D; ++k)
                    there[k] = cell[k] + static_cast<std::uint32_t>(n.steps[k]);
                found = any_in(there, c, visit);
                return !found;
            });
        } else {
            grid_.around(cell, [&](const Index& there, const Point&) {
                found = found || (has(pending_, there) && any_in(there, c, visit));
            });
        }
        return found;
    }

    /// Makes the candidates that stay points, and forgets the others.
    void settle(Tile& tile, std::uint8_t stays) {
        for (std::size_t i = 0; i < tile.candidates.size(); ++i) {
            const Candidate<D>& c = tile.candidates[i];
            const Index cell = Grid::cell_at(tile.first, c.place);
            const std::size_t number = grid_.number_of(cell);
            if (has(pending_, cell)) flip(pending_, cell);
            if (tile.fates[i] == stays) {
                heads_[number] = static_cast<std::uint16_t>(settled | (tile.points.size() / D));
                tile.points.insert(tile.points.end(), c.at.begin(), c.at.end());
                places_[number] = c.off;
                flip(taken_, cell);
            } else if ((heads_[number] & settled) == 0) {
                heads_[number] = 0;
            }
        }
    }

  private:
    static constexpr std::uint16_t settled = 0x8000;  ///< in a head: of a point, no candidate
    static constexpr std::size_t rows = power(5, D - 1);

    /// One of the 5^D cells about another.
    struct Neighbour {
        std::array<int, D> steps;
        std::array<float, D> off;  ///< of its corner, in radii
        std::ptrdiff_t cells;      ///< the same as a difference of numbers
    };

    void look_at(std::size_t b) {
        Neighbour& n = about_[b];
        std::size_t rest = b;
        std::ptrdiff_t row = 0;
        std::ptrdiff_t stride = 1;
        double gap = 0;
        for (std::size_t k = 0; k < D; ++k, rest /= 5) {
            const int step = static_cast<int>(rest % 5) - 2;
            n.steps[k] = step;
            n.off[k] = static_cast<float>(step * grid_.scales[k]);
            if (k > 0) {
                row += step * stride;
                stride *= grid_.cells[k];
            }
            const double apart = std::max(std::abs(step) - 1, 0) * grid_.scales[k];
            gap += apart * apart;
        }
        n.cells = row * static_cast<std::ptrdiff_t>(grid_.cells[0]) + n.steps[0];
        rows_[b / 5] = row;
        if (gap < 1) masks_[b / 5] |= 1U << (b % 5);
    }

    [[nodiscard]] std::size_t byte_of(const Index& cell) const {
        std::size_t row = 0;
        for (std::size_t k = D; k-- > 1;) row = row * grid_.cells[k] + cell[k];
        return row * pitch_ + cell[0] / 8;
    }
    [[nodiscard]] bool has(const std::vector<std::uint8_t>& bits, const Index& cell) const {
        return (bits[byte_of(cell)] >> (cell[0] % 8) & 1) != 0;
    }
    void flip(std::vector<std::uint8_t>& bits, const Index& cell) {
        bits[byte_of(cell)] ^= static_cast<std::uint8_t>(1U << (cell[0] % 8));
    }

    /// Calls visit(neighbour) where the bit is set, about an interior cell, as long as that is
    /// true.
    template <class Visit>
    void for_bits(const std::vector<std::uint8_t>& bits, const Index& cell,
                  const Visit& visit) const {
        Index start = cell;
        start[0] -= 2;
        const std::size_t from = byte_of(start);
        const unsigned shift = start[0] % 8;
        for (std::size_t group = 0; group < rows; group += 5) {
            std::uint32_t found = 0;
            for (std::size_t r = 0; r < 5; ++r) {
                std::uint16_t word;
                const std::ptrdiff_t off = rows_[group + r] * static_cast<std::ptrdiff_t>(pitch_);
                std::memcpy(&word, bits.data() + from + static_cast<std::size_t>(off), sizeof word);
                found |= (word >> shift & masks_[group + r]) << (5 * r);
            }
            for (; found != 0; found &= found - 1) {
                const auto bit = static_cast<std::size_t>(std::countr_zero(found));
                if (!visit(about_[5 * group + bit])) return;
            }
        }
    }

    /// The point of a cell, or nullptr.
    [[nodiscard]] const double* point_in(const Index& cell) const {
        const std::uint16_t head = heads_[grid_.number_of(cell)];
        if ((head & settled) == 0) return nullptr;
        const std::size_t number = head & (settled - 1U);
        return tiles_[grid_.tile_of(cell)].points.data() + number * D;
    }

    template <class Visit>
    [[nodiscard]] bool any_in(const Index& cell, const Candidate<D>& c, const Visit& visit) {
        Tile& tile = tiles_[grid_.tile_of(cell)];
        const auto& all = tile.candidates;
        for (std::uint16_t i = heads_[grid_.number_of(cell)]; i != 0; i = all[i - 1U].next) {
            const Candidate<D>& other = all[i - 1U];
            if (!other.before(c)) return false;
            if (this->too_near(other.at.data(), c.at.data()) && visit(tile, i - 1U)) return true;
        }
        return false;
    }

    std::size_t pitch_;  ///< bytes of bits to a row of cells; tiles never share a byte
    std::vector<std::uint16_t> heads_;
    std::vector<std::array<float, D>> places_;  ///< of a cell's point, from its corner, in radii
    std::vector<std::uint8_t> taken_;
    std::vector<std::uint8_t> pending_;
    std::array<Neighbour, rows * 5> about_{};
    std::array<std::ptrdiff_t, rows> rows_{};
    std::array<std::uint32_t, rows> masks_{};
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

    void publish(Tile&) {}

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

    void settle(Tile& tile, std::uint8_t stays) {
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
