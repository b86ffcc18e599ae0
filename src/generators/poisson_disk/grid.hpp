// SPDX-License-Identifier: MIT
//
// Grid of the cells that hold a maximal disk set: boxes with a diagonal of at most a radius, so
// that each holds at most one point. Cells are grouped into tiles, which are processed as a whole.
//
// "In radii" below means: relative to the corner of a cell, in units of the radius. Such
// coordinates are small, so that floats are accurate enough.
//
// Shape   D directions, m_k cells along each, fewer than 2^32 in all.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "generators/box_space.hpp"
#include "math/neighbors/spaced_points.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

constexpr std::size_t power(std::size_t base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Bound on rounding errors of distances in doubles, and on those of coordinates as stored, in
/// radii. In boxes far from the origin it may exceed the rounding errors of floats.
inline double distance_slack(const BoxSpace& space, double radius) {
    return 0x1p-49 * (space.largest_coordinate() / radius + 8);
}

/// Factor of a radius in searches for cells that its disk may reach, in spite of rounding.
inline double reach_factor(double slack) { return 1 + std::max(1e-6, slack); }

/// Cell by its offset from the first cell of a tile; possibly outside the tile.
template <std::size_t D>
using TileCell = std::array<int, D>;

template <std::size_t D>
struct Grid {
    using Point = std::array<double, D>;
    using Index = std::array<std::uint32_t, D>;

    /// Grid for disks of `disk_radius`. Cells are sized for `cell_radius` <= `disk_radius`, so that
    /// sets of several radii can share the same cells.
    /// @param tile_side maximum number of cells along a tile
    Grid(const BoxSpace& space, double disk_radius, double cell_radius, std::uint32_t tile_side)
        : torus(space.torus), radius(disk_radius), slack(distance_slack(space, disk_radius)) {
        const std::vector<double> along = cells_along(space.box, cell_radius);
        for (std::size_t k = 0; k < D; ++k) {
            low[k] = space.box.low[k];
            high[k] = space.box.high[k];
            sides[k] = space.box.extent(k);
            cells[k] = static_cast<std::uint32_t>(along[k]);
            widths[k] = sides[k] / cells[k];
            scales[k] = widths[k] / radius;
            const double across = radius / widths[k] * reach_factor(slack);
            reach[k] = static_cast<int>(across < cells[k] ? across + 1 : cells[k]);
            tiles[k] = (cells[k] + tile_side - 1) / tile_side;
            tile_count *= tiles[k];
            cell_count *= cells[k];
        }
    }

    /// First cell of a tile along direction k. Tiles have about the same size.
    [[nodiscard]] std::uint32_t first_cell(std::size_t k, std::uint64_t tile) const {
        return static_cast<std::uint32_t>(tile * cells[k] / tiles[k]);
    }

    /// First cell of a tile, and the first one after it, along each direction.
    [[nodiscard]] std::pair<Index, Index> tile(std::size_t number) const {
        Index first{};
        Index last{};
        for (std::size_t k = 0; k < D; number /= tiles[k], ++k) {
            first[k] = first_cell(k, number % tiles[k]);
            last[k] = first_cell(k, number % tiles[k] + 1);
        }
        return {first, last};
    }

    /// Whether two points are too near, by their coordinates as stored.
    [[nodiscard]] bool too_near(const Point& p, const Point& q) const {
        return squared_distance<D>(p.data(), q.data(), sides, torus) < radius * radius;
    }

    bool torus;
    double radius;
    double slack;  ///< distance_slack()
    Point low{};
    Point high{};
    Point sides{};
    Point widths{};  ///< sides of a cell
    Point scales{};  ///< sides of a cell, in radii
    Index cells{};
    TileCell<D> reach{};  ///< largest number of cells that a radius spans
    Index tiles{};
    std::size_t tile_count = 1;
    std::size_t cell_count = 1;
};

// The samplers that maximal_disks (generators/poisson_disk/maximal_disks.hpp) chooses from.

/// Input of all samplers.
template <std::size_t D>
struct Task {
    const Grid<D>& grid;
    std::uint64_t expected;  ///< approximate number of points
    std::uint64_t seed;
};

/// Binary logarithm of the maximum number of cells along a tile's side.
template <std::size_t D>
inline constexpr unsigned box_tile_bits = D == 2   ? 4
                                          : D <= 4 ? 3
                                                   : 2;
inline constexpr unsigned plane_tile_bits = 6;
inline constexpr unsigned space_tile_bits = 5;

/// Makes the points, in any box. @throws Error(cancelled)
template <std::size_t D>
Rows box_sample(const Task<D>& task, const RunContext& run);

/// Samplers for five or more cells along each direction, if a radius spans two cells.
Rows plane_sample(const Task<2>& task, const RunContext& run);
Rows space_sample(const Task<3>& task, const RunContext& run);

/// Maximum number of bytes for a tile, without its points.
extern const double plane_tile_bytes;
extern const double space_tile_bytes;

}  // namespace stipple::poisson_disk
