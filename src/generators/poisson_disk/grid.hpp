// SPDX-License-Identifier: MIT
//
// The cells in which maximal disk sets are kept: boxes with a diagonal of at most a radius, so that
// one holds one point at most, in tiles that are worked on as a whole.
//
// "In radii" below means: in units of the radius, from the corner of a cell. Such numbers are
// small, so that floats hold them well.
//
// Shape   D directions, m_k cells along each, fewer than 2^32 in all.
#pragma once

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

/// A cell of a tile, counted from the tile's first one on; beyond its faces, too.
template <std::size_t D>
using TileCell = std::array<int, D>;

template <std::size_t D>
struct Grid {
    using Point = std::array<double, D>;
    using Index = std::array<std::uint32_t, D>;

    /// Cells for `cell_radius`, which is at most `radius`: a grid may serve several radii.
    /// @param tile_side largest number of cells along a tile
    Grid(const BoxSpace& space, double disk_radius, double cell_radius, std::uint32_t tile_side)
        : torus(space.torus), radius(disk_radius) {
        const std::vector<double> along = cells_along(space.box, cell_radius);
        for (std::size_t k = 0; k < D; ++k) {
            low[k] = space.box.low[k];
            high[k] = space.box.high[k];
            sides[k] = space.box.extent(k);
            cells[k] = static_cast<std::uint32_t>(along[k]);
            widths[k] = sides[k] / cells[k];
            scales[k] = widths[k] / radius;
            const double across = radius / widths[k] * (1 + 1e-6);
            reach[k] = static_cast<int>(across < cells[k] ? across + 1 : cells[k]);
            tiles[k] = (cells[k] + tile_side - 1) / tile_side;
            tile_count *= tiles[k];
            cell_count *= cells[k];
        }
    }

    /// The first cell of a tile along direction k. Tiles are of about the same size.
    [[nodiscard]] std::uint32_t first_cell(std::size_t k, std::uint64_t tile) const {
        return static_cast<std::uint32_t>(tile * cells[k] / tiles[k]);
    }

    /// The first cell of a tile, and the one behind its last.
    [[nodiscard]] std::pair<Index, Index> tile(std::size_t number) const {
        Index first{};
        Index last{};
        for (std::size_t k = 0; k < D; number /= tiles[k], ++k) {
            first[k] = first_cell(k, number % tiles[k]);
            last[k] = first_cell(k, number % tiles[k] + 1);
        }
        return {first, last};
    }

    /// In the numbers as they are stored.
    [[nodiscard]] bool too_near(const Point& p, const Point& q) const {
        return squared_distance<D>(p.data(), q.data(), sides, torus) < radius * radius;
    }

    bool torus;
    double radius;
    Point low{};
    Point high{};
    Point sides{};
    Point widths{};  ///< of a cell
    Point scales{};  ///< of a cell, in radii
    Index cells{};
    TileCell<D> reach{};  ///< cells that a distance of the radius can lead across
    Index tiles{};
    std::size_t tile_count = 1;
    std::size_t cell_count = 1;
};

// The samplers that maximal_disks (generators/poisson_disk/maximal_disks.hpp) chooses from.

/// What all samplers work with.
template <std::size_t D>
struct Task {
    const Grid<D>& grid;
    double slack;            ///< of distances that doubles hold, in radii
    std::uint64_t expected;  ///< number of points
    std::uint64_t seed;
};

/// Largest number of cells along a tile's side, as a power of two.
template <std::size_t D>
inline constexpr unsigned box_tile_bits = D == 2   ? 4
                                          : D <= 4 ? 3
                                                   : 2;
inline constexpr unsigned plane_tile_bits = 6;
inline constexpr unsigned space_tile_bits = 5;

/// The points, in any box. @throws Error(cancelled)
template <std::size_t D>
Rows box_sample(const Task<D>& task, const RunContext& run);

/// The same where a radius leads across two cells, and there are five or more, along each
/// direction.
Rows plane_sample(const Task<2>& task, const RunContext& run);
Rows space_sample(const Task<3>& task, const RunContext& run);

/// Bytes that a tile takes at most, without points.
extern const double plane_tile_bytes;
extern const double space_tile_bytes;

}  // namespace stipple::poisson_disk
