// SPDX-License-Identifier: MIT
//
// Tiles of cells of the plane, each with all that is needed to throw darts at it one after the
// other: its own points and what they cover, and those of two rows of cells about it.
//
// Within a tile darts come in the order of time, and one that keeps its distance is a point at
// once. Those within two cells of the tile's edge, which a dart of another tile may come before,
// and those too near to such a one, are left undecided until all tiles have got so far. Then each
// stays unless an earlier undecided one that is too near to it stays, which is asked from dart to
// dart, across tiles; and what stayed near an edge goes into the halo of the tiles beyond.
//
// Shape   cells that hold one point at most, a radius leading across two of them; five along each
//         direction, or more. A tile may be its own neighbour on a torus.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/fetch.hpp"
#include "generators/poisson_disk/dart_fate.hpp"
#include "generators/poisson_disk/disk_covers.hpp"
#include "generators/poisson_disk/disk_grid.hpp"
#include "generators/poisson_disk/disk_spots.hpp"
#include "generators/poisson_disk/disk_window.hpp"

namespace stipple {

/// A dart on a tile: its place in cells from the tile's first, times 2^26.
struct Dart {
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t time;    ///< within its shower
    std::uint32_t detail;  ///< index of the exact place, for those that have one
};

/// A dart that other tiles have a say in.
struct Undecided {
    std::array<double, 2> at;
    std::uint32_t x;  ///< as in Dart
    std::uint32_t y;
    std::uint32_t time;
    SharedFate fate = {};

    /// Within the cell.
    [[nodiscard]] std::array<std::uint32_t, 2> digits() const { return {x << 6, y << 6}; }
    [[nodiscard]] int column() const { return static_cast<int>(x >> 26); }
    [[nodiscard]] int row() const { return static_cast<int>(y >> 26); }
    [[nodiscard]] bool before(const Undecided& other) const {
        return time < other.time || (time == other.time && at < other.at);
    }
};

/// The undecided darts of a shower on a tile, sorted into squares of 4 x 4 cells.
class UndecidedDarts {
  public:
    /// @param shower its number
    void renew(std::uint64_t shower, const std::vector<Undecided>& darts) {
        shower_ = shower;
        first_.fill(0);
        for (const Undecided& u : darts) ++first_[square_of(u) + 1];
        for (std::size_t i = 0; i < squares; ++i) first_[i + 1] += first_[i];
        auto next = first_;
        all_.assign(darts.size(), {});
        for (const Undecided& u : darts) all_[next[square_of(u)]++] = u;
    }

    [[nodiscard]] std::vector<Undecided>& all() { return all_; }
    /// Whether they are those of that shower.
    [[nodiscard]] bool of(std::uint64_t shower) const { return shower_ == shower; }

    /// Calls visit(dart) for those in the squares of cells within [low, high] of a direction each,
    /// as long as that is true.
    template <class Visit>
    void for_some(std::array<int, 2> low, std::array<int, 2> high, const Visit& visit) {
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::max(low[k], 0);
            high[k] = std::min(high[k], 63);
            if (low[k] > high[k]) return;
        }
        for (int y = low[1] / 4; y <= high[1] / 4; ++y) {
            const std::uint32_t last = first_[static_cast<std::size_t>(16 * y + high[0] / 4 + 1)];
            for (auto i = first_[static_cast<std::size_t>(16 * y + low[0] / 4)]; i < last; ++i)
                if (!visit(all_[i])) return;
        }
    }

  private:
    static constexpr std::size_t squares = 256;
    static std::size_t square_of(const Undecided& u) {
        return static_cast<std::size_t>(u.row() / 4 * 16 + u.column() / 4);
    }

    std::uint64_t shower_ = 0;
    std::vector<Undecided> all_;
    std::array<std::uint32_t, squares + 1> first_{};
};

/// The first cell of a tile and the one behind its last. Tiles are of about the same size, so that
/// from none a radius leads across another.
inline std::pair<DiskGrid<2>::Index, DiskGrid<2>::Index> plane_tile(const DiskGrid<2>& grid,
                                                                    std::size_t number) {
    DiskGrid<2>::Index first{};
    DiskGrid<2>::Index last{};
    for (std::size_t k = 0; k < 2; ++k, number /= grid.tiles[0]) {
        const std::uint64_t t = number % grid.tiles[k];
        first[k] = static_cast<std::uint32_t>(t * grid.cells[k] / grid.tiles[k]);
        last[k] = static_cast<std::uint32_t>((t + 1) * grid.cells[k] / grid.tiles[k]);
    }
    return {first, last};
}

/// What tiles keep of their cells.
struct CellRoom {
    Spot* spots;
    PartBits* covered;
    std::uint16_t* indices;
};

class PlaneTile {
  public:
    using Grid = DiskGrid<2>;
    using Index = Grid::Index;
    using Point = Grid::Point;

    PlaneTile() = default;
    /// @param room for DiskSpots::needed(rows of the tile) of each
    PlaneTile(const Grid& grid, std::size_t number, const CellRoom& room)
        : grid_(&grid), covered_(room.covered), index_(room.indices) {
        const auto [first, last] = plane_tile(grid, number);
        first_ = first;
        for (std::size_t k = 0; k < 2; ++k) size_[k] = static_cast<int>(last[k] - first[k]);
        Point origin;
        Point cell;
        for (std::size_t k = 0; k < 2; ++k) {
            cell[k] = grid.scales[k] * spots_to_radius;
            origin[k] = cell[k] * first[k];
        }
        const auto rows = static_cast<std::size_t>(size_[1]);
        spots_ = DiskSpots(origin, cell, rows, room.spots);
        std::fill_n(covered_, DiskSpots::needed(rows), PartBits{0});
        std::fill_n(index_, DiskSpots::needed(rows), none);
        points_.reserve(2 * typical_points());
        for (std::size_t y = 0; y < rows; ++y)  // nothing is open beyond the last column
            for (auto x = static_cast<std::size_t>(size_[0]); x < Grid::tile_side; ++x)
                covered_[spot_number(static_cast<int>(x), static_cast<int>(y))] = ~PartBits{0};
    }

    [[nodiscard]] const Index& first() const { return first_; }
    [[nodiscard]] int size(std::size_t k) const { return size_[k]; }
    [[nodiscard]] std::vector<double>& points() { return points_; }

    /// Number of a cell in what follows.
    static std::size_t spot_number(int column, int row) {
        return DiskSpots::number(static_cast<std::size_t>(column + int{DiskSpots::halo}),
                                 static_cast<std::size_t>(row + int{DiskSpots::halo}));
    }

    /// Parts covered by one disk, of a cell and those behind it in the row.
    [[nodiscard]] const PartBits* covered(std::size_t number) const { return covered_ + number; }

    [[nodiscard]] bool taken(std::size_t number) const { return index_[number] != none; }

    [[nodiscard]] const DiskSpots& spots() const { return spots_; }

    /// The point of a cell that is taken, of the halo's too.
    [[nodiscard]] const double* point(std::size_t number) const {
        const std::size_t i = index_[number];
        return i < own ? &points_[2 * i] : &halo_[2 * (i - own)];
    }

    /// Whether a place in the middle of 25 cells is nearer than the radius to one of their points.
    [[nodiscard]] bool hits(int column, int row, const double* p) const {
        for (int y = row - 2; y <= row + 2; ++y)
            for (int x = column - 2; x <= column + 2; ++x) {
                const std::size_t number = spot_number(x, y);
                if (taken(number) && too_near(p, point(number))) return true;
            }
        return false;
    }

    [[nodiscard]] bool too_near(const double* p, const double* q) const {
        return squared_distance<2>(p, q, grid_->sides, grid_->torus) <
               grid_->radius * grid_->radius;
    }

    /// Adds a point of this tile.
    /// @param stamp what it covers
    void add(int column, int row, Spot spot, const std::array<double, 2>& at,
             const DiskStamps<2>::Row* stamp) {
        const std::size_t number = spot_number(column, row);
        spots_.put(number, spot);
        index_[number] = static_cast<std::uint16_t>(points_.size() / 2);
        points_.push_back(at[0]);
        points_.push_back(at[1]);
        PartBits* to = &covered_[number - 2 * DiskSpots::stride - 2];
        for (std::size_t y = 0; y < 5; ++y, to += DiskSpots::stride)
            for (std::size_t x = 0; x < 5; ++x) to[x] |= stamp[y][x];
    }

    /// Adds a point of another tile, where it is near enough.
    void add_beyond(int column, int row, Spot spot, const std::array<double, 2>& at,
                    const DiskStamps<2>::Row* stamp) {
        constexpr int far = DiskSpots::halo;
        if (column < -far || row < -far) return;
        if (column >= size_[0] + far || row >= size_[1] + far) return;
        const std::size_t number = spot_number(column, row);
        spots_.put(number, spot);
        index_[number] = static_cast<std::uint16_t>(own + halo_.size() / 2);
        halo_.insert(halo_.end(), at.begin(), at.end());
        for (int y = std::max(row - far, 0); y <= std::min(row + far, size_[1] - 1); ++y)
            for (int x = std::max(column - far, 0); x <= std::min(column + far, size_[0] - 1); ++x)
                covered_[spot_number(x, y)] |=
                    stamp[y - row + far][static_cast<std::size_t>(x - column + far)];
    }

    /// Fetches what is looked at in no order when darts fall.
    void fetch() const {
        const std::size_t cells = DiskSpots::needed(static_cast<std::size_t>(size_[1]));
        stipple::fetch(std::span<const PartBits>(covered_, cells));
        stipple::fetch(std::span<const Spot>(spots_.from(0), cells));
        stipple::fetch(std::span<const std::uint16_t>(index_, cells));
    }

    /// Gives back its own memory, but that of the points.
    void drop() {
        halo_ = {};
        for (UndecidedDarts& darts : undecided) darts = {};
    }

    std::vector<Window<2>> windows;
    std::array<UndecidedDarts, 2> undecided;  ///< of even and odd showers

  private:
    static constexpr std::uint16_t none = 0xffff;
    static constexpr std::size_t own = 0x4000;  ///< more than a tile has points of its own

    /// A little more points than there mostly are.
    [[nodiscard]] std::size_t typical_points() const {
        const double places = 0.70 * size_[0] * grid_->scales[0] * size_[1] * grid_->scales[1];
        return static_cast<std::size_t>(places + std::sqrt(places) / 2 + 1);
    }

    const Grid* grid_ = nullptr;
    Index first_{};
    std::array<int, 2> size_{};
    DiskSpots spots_;
    PartBits* covered_ = nullptr;
    std::uint16_t* index_ = nullptr;  ///< of a cell's point; own or more for one of the halo
    std::vector<double> points_;
    std::vector<double> halo_;  ///< points of other tiles
};

}  // namespace stipple
