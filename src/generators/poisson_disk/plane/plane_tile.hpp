// SPDX-License-Identifier: MIT
//
// Tiles of cells of the plane, each with all that is needed to throw darts at it one after the
// other: its own points and what they cover, and those of two rows of cells about it.
//
// Shape   cells that hold one point at most, a radius leading across two of them; five along each
//         direction, or more. A tile may be its own neighbour on a torus.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "generators/poisson_disk/plane/coverage_table.hpp"
#include "generators/poisson_disk/plane/fixed_positions.hpp"
#include "generators/poisson_disk/tile_rounds.hpp"

namespace stipple::poisson_disk {

/// Cells along each side of a tile.
inline constexpr int plane_side = 1 << plane_tile_bits;

/// Units of a dart's place to a cell.
inline constexpr double cell_unit = 0x1p26;

/// What all tiles share.
struct PlaneRules {
    PlaneRules(const Grid<2>& box_grid, double slack);

    const Grid<2>& grid;
    CoverageTable table;
    std::int32_t sure;      ///< squared distance of positions that is below the radius for certain
    std::int32_t possible;  ///< and from which on it is not
};

/// What tiles keep of their cells.
struct CellRoom {
    FixedPosition* positions;
    SubcellBits* covered;
    std::uint16_t* indices;
};

class PlaneTile : public Tile<2, plane_tile_bits, 2> {
  public:
    PlaneTile() = default;
    /// @param room for FixedPositions::needed(rows of the tile) of each
    PlaneTile(const PlaneRules& rules, std::size_t number, const CellRoom& room)
        : Tile(rules.grid, number), rules_(&rules), covered_(room.covered), index_(room.indices) {
        Point origin;
        Point cell;
        for (std::size_t k = 0; k < 2; ++k) {
            cell[k] = rules.grid.scales[k] * units_per_radius;
            origin[k] = cell[k] * first_[k];
        }
        const auto rows = static_cast<std::size_t>(size_[1]);
        positions_ = FixedPositions(origin, cell, rows, room.positions);
        std::fill_n(covered_, FixedPositions::needed(rows), SubcellBits{0});
        std::fill_n(index_, FixedPositions::needed(rows), none);
        points_.reserve(2 * typical_points(rules.grid));
        for (int y = 0; y < size_[1]; ++y)  // nothing is open beyond the last column
            for (int x = size_[0]; x < plane_side; ++x)
                covered_[number_of({x, y})] = ~SubcellBits{0};
    }

    /// Number of a cell in what follows.
    static std::size_t number_of(const Cell& cell) {
        return FixedPositions::number(static_cast<std::size_t>(cell[0] + int{halo}),
                                      static_cast<std::size_t>(cell[1] + int{halo}));
    }

    /// Sub-cells covered by one disk, of a cell and those behind it in the row.
    [[nodiscard]] const SubcellBits* covered(std::size_t number) const { return covered_ + number; }

    [[nodiscard]] bool taken(std::size_t number) const { return index_[number] != none; }

    [[nodiscard]] const FixedPositions& positions() const { return positions_; }

    /// Calls visit(point, cell) for the points of the 25 cells about one, as long as that is true.
    template <class Visit>
    void for_about(const Cell& cell, const Visit& visit) const {
        for (int y = cell[1] - halo; y <= cell[1] + halo; ++y)
            for (int x = cell[0] - halo; x <= cell[0] + halo; ++x) {
                const std::size_t number = number_of({x, y});
                if (taken(number) && !visit(point(number), Cell{x, y})) return;
            }
    }

    /// Adds a point of this tile's own.
    /// @param mask what it covers
    void add(const Cell& cell, FixedPosition position, const Point& at,
             const CoverageTable::Row* mask) {
        const std::size_t number = number_of(cell);
        positions_.put(number, position);
        index_[number] = static_cast<std::uint16_t>(own_++);
        points_.insert(points_.end(), at.begin(), at.end());
        cover_about(number, mask);
    }

    void take(std::span<const Addition<2>> additions) {
        for (const Addition<2>& a : additions) take(a);
    }

    /// Gives back its own memory, but that of the points.
    void drop() {
        halo_ = {};
        pending = {};
    }

  private:
    static constexpr int halo = FixedPositions::halo;
    static constexpr std::uint16_t none = 0xffff;
    static constexpr std::size_t most_own = 0x4000;  ///< more than a tile has points of its own

    /// The point of a cell that is taken, of the halo's too.
    [[nodiscard]] Point point(std::size_t number) const {
        const std::size_t i = index_[number];
        const double* p = i < most_own ? &points_[2 * i] : &halo_[2 * (i - most_own)];
        return {p[0], p[1]};
    }

    void cover_about(std::size_t number, const CoverageTable::Row* mask) {
        SubcellBits* to = &covered_[number - 2 * FixedPositions::stride - 2];
        for (std::size_t y = 0; y < 5; ++y, to += FixedPositions::stride)
            for (std::size_t x = 0; x < 5; ++x) to[x] |= mask[y][x];
    }

    void take(const Addition<2>& a) {
        constexpr double below_one = 1 - 0x1p-32;
        Point place = in_cell(rules_->grid, a.at, a.cell);
        std::array<std::uint32_t, 2> digits;
        for (std::size_t k = 0; k < 2; ++k) {
            const double kept = std::clamp(place[k], 0.0, below_one);
            place[k] = a.cell[k] + kept;
            digits[k] = static_cast<std::uint32_t>(kept * 0x1p32);
        }
        const std::size_t number = number_of(a.cell);
        const CoverageTable::Row* mask = rules_->table.about(digits);
        positions_.put(number, positions_.position_of(place[0], place[1]));
        if (a.own) {
            index_[number] = static_cast<std::uint16_t>(own_++);
            return cover_about(number, mask);
        }
        index_[number] = static_cast<std::uint16_t>(most_own + halo_.size() / 2);
        halo_.insert(halo_.end(), a.at.begin(), a.at.end());
        const auto [column, row] = a.cell;
        for (int y = std::max(row - halo, 0); y <= std::min(row + halo, size_[1] - 1); ++y)
            for (int x = std::max(column - halo, 0); x <= std::min(column + halo, size_[0] - 1);
                 ++x)
                covered_[number_of({x, y})] |=
                    mask[y - row + halo][static_cast<std::size_t>(x - column + halo)];
    }

    const PlaneRules* rules_ = nullptr;
    FixedPositions positions_;
    SubcellBits* covered_ = nullptr;
    std::uint16_t* index_ = nullptr;  ///< of a cell's point; most_own or more for one of the halo
    std::size_t own_ = 0;             ///< points of the tile that its cells know
    std::vector<double> halo_;        ///< points of other tiles
};

}  // namespace stipple::poisson_disk
