// SPDX-License-Identifier: MIT
//
// Tiles of cells of the plane, with all that is needed to throw darts at them one after the other:
// a tile's points and their coverage, and those of two rows of cells around it.
//
// Shape   cells hold at most one point, and a radius spans two cells; at least five cells along
//         each direction. A tile may be its own neighbour on a torus.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/machine/memory.hpp"
#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "generators/poisson_disk/near_disks.hpp"
#include "generators/poisson_disk/tile_rounds.hpp"

namespace stipple::poisson_disk {

// Positions of the points of a tile, in 16 bits along each direction, so that the 25 cells around a
// position take ten loads of four cells each.
//
// Coordinates are in units of 1/8192 of the radius, modulo 8 radii. Positions that are compared are
// within three cells, at most 2.2 radii, so that differences modulo 2^16 are right. A cell without
// a point holds a position 4 radii beside its middle, which is farther than a radius from any
// position it is compared with.
//
// Shape   rows of up to 64 cells, with two more at each end.
// Promise distances are off by less than `position_slack` units.

struct FixedPosition {
    std::int16_t x;
    std::int16_t y;
};

inline constexpr double units_per_radius = 8192;
inline constexpr double position_slack = 2;

using FourNumbers [[gnu::vector_size(16)]] = std::int32_t;

/// Squared distances from one position to four consecutive ones.
[[gnu::always_inline]] inline FourNumbers four_squares(const FixedPosition* four,
                                                       FixedPosition from) {
    using Halves [[gnu::vector_size(16)]] = std::uint16_t;
    Halves off;
    std::memcpy(&off, four, sizeof off);
    off -= (Halves)(FourNumbers{} + std::bit_cast<std::int32_t>(from));
    const FourNumbers x = (FourNumbers)off << 16 >> 16;
    const FourNumbers y = (FourNumbers)off >> 16;
    return x * x + y * y;  // below 2^31: |x| <= 2^15, |y| <= 2.2 radii < 2^15
}

/// Positions of the points in a tile's cells.
class FixedPositions {
  public:
    FixedPositions() = default;

    static constexpr std::size_t halo = 2;  ///< width of the border of other tiles' cells
    static constexpr std::size_t stride = 64 + 2 * halo;

    /// Number of positions for a tile with `rows` rows of cells.
    static constexpr std::size_t needed(std::size_t rows) { return (rows + 2 * halo) * stride; }

    /// @param origin position of the tile's first cell, in units of 1/8192 radius
    /// @param cell sides of a cell, in the same units
    /// @param rows number of rows of cells
    /// @param room memory for needed(rows) positions
    FixedPositions(const std::array<double, 2>& origin, const std::array<double, 2>& cell,
                   std::size_t rows, FixedPosition* room)
        : origin_(origin), cell_(cell), positions_(room) {
        for (std::size_t y = 0; y < rows + 2 * halo; ++y)
            for (std::size_t x = 0; x < stride; ++x) {
                const double to_middle = 0.5 - double{halo};
                positions_[y * stride + x] = {
                    wrapped(origin[0] + cell[0] * to_middle + cell[0] * static_cast<double>(x) +
                            half_turn),
                    wrapped(origin[1] + cell[1] * to_middle + cell[1] * static_cast<double>(y))};
            }
    }

    /// Position of the point (x, y), which is given in cells from the tile's first cell.
    [[nodiscard]] FixedPosition position_of(double x, double y) const {
        return {wrapped(origin_[0] + cell_[0] * x), wrapped(origin_[1] + cell_[1] * y)};
    }

    /// Pointer to a cell's position; the positions of the next cells follow it.
    [[nodiscard]] const FixedPosition* from(std::size_t number) const {
        return positions_ + number;
    }

    void put(std::size_t number, FixedPosition position) { positions_[number] = position; }

    /// Index of a cell in the array of positions, counted from the first one of the halo.
    static constexpr std::size_t number(std::size_t x, std::size_t y) { return y * stride + x; }

    /// Whether a point of the 25 cells from `first` on covers `place`, which is in the middle cell.
    /// @param sure squared distance below which a point is a hit
    /// @param possible squared distance from which on a point is not a hit
    [[nodiscard, gnu::always_inline]] Hit hit(std::size_t first, FixedPosition place,
                                              std::int32_t sure, std::int32_t possible) const {
        const FixedPosition* row = positions_ + first;
        FourNumbers least = FourNumbers{} + possible;
        for (std::size_t y = 0; y < 5; ++y, row += stride)
            for (std::size_t x = 0; x < 2; ++x) {
                const FourNumbers squares = four_squares(row + x, place);
                least = squares < least ? squares : least;
            }
        const std::int32_t nearest =
            std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
        return nearest < sure ? Hit::yes : nearest < possible ? Hit::unsure : Hit::no;
    }

    /// Calls visit(position) for the points of the 25 cells from `first` on whose squared distance
    /// from `place` is below `squared`.
    template <class Visit>
    [[gnu::always_inline]] void for_near(std::size_t first, FixedPosition place,
                                         std::int32_t squared, const Visit& visit) const {
        for (std::size_t y = 0; y < 5; ++y, first += stride)
            for (std::size_t x = 0; x < 5; ++x) {
                const FixedPosition& p = positions_[first + x];
                const int across = static_cast<std::int16_t>(p.x - place.x);
                const int up = static_cast<std::int16_t>(p.y - place.y);
                if (across * across + up * up < squared) visit(p);
            }
    }

  private:
    static constexpr double half_turn = 32768;

    /// Position modulo 2^16; `units` is above -2^16, as the halo is narrow.
    static std::int16_t wrapped(double units) {
        return static_cast<std::int16_t>(
            static_cast<std::uint16_t>(static_cast<std::int64_t>(units + 2 * half_turn)));
    }

    std::array<double, 2> origin_{};
    std::array<double, 2> cell_{};
    FixedPosition* positions_ = nullptr;
};

// Coverage of the 5 x 5 cells around a disk's centre, with a bit for each of 8 x 8 sub-cells. The
// centre's cell is divided into Q x Q squares, the places of the table: a bit is set if the
// sub-cell is covered for every centre in the place. So one bit mostly decides whether a dart can
// be kept, and one word whether a cell is covered.
//
// Shape   grids in which a radius spans two cells along both directions.
// Cost    25 words a disk; 200 kB for a table.
// Promise a sub-cell whose bit is set is covered by a single disk, and not within float_slack of
//         its rim.

class CoverageTable {
  public:
    using Place = std::array<float, 2>;
    using Row = std::array<SubcellBits, 5>;

    explicit CoverageTable(const Grid<2>& grid) : grid_(grid) {
        for (std::size_t k = 0; k < 2; ++k)
            sides_[k] = static_cast<float>(grid.scales[k] / double{subcells<2>});
        while (places_ * 2 <= most_places && places_ * places_ * worth < grid.cell_count)
            places_ *= 2, ++place_bits_;
        rows_.reserve(places_ * places_ * 5);
        for (std::size_t place = 0; place < places_ * places_; ++place)
            for (std::size_t row = 0; row < 5; ++row) rows_.push_back(row_of(place, row));
    }

    /// Coverage of five rows of five cells, whose middle cell contains the centre.
    /// @param digits 32 binary digits of the centre's position in its cell, along each direction
    [[nodiscard]] const Row* about(const std::array<std::uint32_t, 2>& digits) const {
        const unsigned drop = 31 - place_bits_;
        const std::size_t place =
            std::size_t{digits[1] >> 1 >> drop} << place_bits_ | digits[0] >> 1 >> drop;
        return rows_.data() + 5 * place;
    }

  private:
    /// The table is refined while the grid has more than this number of cells for each of the Q x Q
    /// places; with fewer cells, building the finer table costs more time than it saves.
    static constexpr std::size_t worth = 128;
    static constexpr std::size_t most_places = 32;

    /// Coverage of a row of five cells, for a centre anywhere in this place of the table.
    [[nodiscard]] Row row_of(std::size_t place, std::size_t row) const {
        const std::array<std::size_t, 2> at{place % places_, place / places_};
        const std::array<double, 2> there{-2, static_cast<double>(row) - 2};
        Place center;
        Place play;
        for (std::size_t k = 0; k < 2; ++k) {
            const double size = grid_.scales[k] / static_cast<double>(places_);
            center[k] = static_cast<float>((static_cast<double>(at[k]) + 0.5) * size -
                                           there[k] * grid_.scales[k]);
            play[k] = static_cast<float>(size / 2);
        }
        Row out;
        for (SubcellBits& bits : out) {
            bits = covered(center, play);
            center[0] -= static_cast<float>(grid_.scales[0]);
        }
        return out;
    }

    /// Sub-cells that a disk covers for every centre within `play` of `center` in each direction.
    [[nodiscard]] SubcellBits covered(const Place& center, const Place& play) const {
        constexpr std::size_t p = subcells<2>;
        SubcellBits bits = 0;
        for (std::size_t line = 0; line < p; ++line) {
            const float middle = (static_cast<float>(line) + 0.5F) * sides_[1];
            const float y = std::abs(center[1] - middle) + sides_[1] / 2 + play[1];
            const float left = 1 - float_slack - y * y;
            if (left <= 0) continue;
            const float half = std::sqrt(left) - play[0];
            const float begin = std::ceil((center[0] - half) / sides_[0]);
            const float end = std::floor((center[0] + half) / sides_[0]);
            const auto b = static_cast<unsigned>(std::clamp(begin, 0.0F, float{p}));
            const auto e = static_cast<unsigned>(std::clamp(end, 0.0F, float{p}));
            if (b < e) bits |= SubcellBits{(1U << e) - (1U << b)} << (line * p);
        }
        return bits;
    }

    const Grid<2>& grid_;
    Place sides_{};            ///< sides of a sub-cell, in radii
    std::size_t places_ = 4;   ///< Q, the number of places along each direction
    unsigned place_bits_ = 2;  ///< binary logarithm of places_
    std::vector<Row> rows_;    ///< five rows of coverage for each place
};

/// Maximum number of cells along each side of a tile.
inline constexpr int plane_side = 1 << plane_tile_bits;

/// A dart's coordinates are in units of 1 / cell_unit of a cell.
inline constexpr double cell_unit = 0x1p26;

/// Data that all tiles share.
struct PlaneRules {
    explicit PlaneRules(const Grid<2>& box_grid);

    const Grid<2>& grid;
    CoverageTable table;
    std::int32_t sure;      ///< squared distance of positions below which points are too near
    std::int32_t possible;  ///< squared distance from which on points are not too near
};

/// Memory for the cells of a tile.
struct CellRoom {
    FixedPosition* positions;
    SubcellBits* covered;
    std::uint16_t* indices;
};

class PlaneTile : public Tile<2, plane_tile_bits, 2> {
  public:
    PlaneTile() = default;
    /// @param room memory for FixedPositions::needed(rows of the tile) elements of each kind
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
        for (int y = 0; y < size_[1]; ++y)  // cells beyond the last column count as covered
            for (int x = size_[0]; x < plane_side; ++x)
                covered_[number_of({x, y})] = ~SubcellBits{0};
    }

    /// Index of a cell in the arrays of positions, coverage and points.
    static std::size_t number_of(const Cell& cell) {
        return FixedPositions::number(static_cast<std::size_t>(cell[0] + int{halo}),
                                      static_cast<std::size_t>(cell[1] + int{halo}));
    }

    /// Pointer to a cell's coverage by single disks; that of the next cells of the row follows.
    [[nodiscard]] const SubcellBits* covered(std::size_t number) const { return covered_ + number; }

    [[nodiscard]] bool taken(std::size_t number) const { return index_[number] != none; }

    [[nodiscard]] const FixedPositions& positions() const { return positions_; }

    /// Calls visit(point, cell) for points of 5 x 5 cells around `cell` until a call returns false.
    template <class Visit>
    void for_about(const Cell& cell, const Visit& visit) const {
        for (int y = cell[1] - halo; y <= cell[1] + halo; ++y)
            for (int x = cell[0] - halo; x <= cell[0] + halo; ++x) {
                const std::size_t number = number_of({x, y});
                if (taken(number) && !visit(point(number), Cell{x, y})) return;
            }
    }

    /// @param mask sub-cells that the point's disk covers
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

    void drop() {
        release(halo_);
        pending = {};
    }

  private:
    static constexpr int halo = FixedPositions::halo;
    static constexpr std::uint16_t none = 0xffff;
    static constexpr std::size_t most_own = 0x4000;  ///< larger than the number of points in a tile

    /// Point of a taken cell, in the tile or its halo.
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
    std::uint16_t* index_ = nullptr;  ///< index of a cell's point; from most_own on, in halo_
    std::size_t own_ = 0;             ///< number of the tile's own points in index_ so far
    std::vector<double> halo_;        ///< points of other tiles
};

}  // namespace stipple::poisson_disk
