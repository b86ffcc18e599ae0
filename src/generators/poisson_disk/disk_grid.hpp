// SPDX-License-Identifier: MIT
//
// The cells in which maximal disk sets are kept: boxes with a diagonal of at most a radius, so that
// one holds one point at most, in tiles that are worked on as a whole.
//
// Lengths are in radii, from the corner of a cell on, and so small numbers that floats hold well.
//
// Shape   D directions, m_k cells along each, fewer than 2^32 in all; tiles of up to 2^15 cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "generators/box_space.hpp"
#include "math/neighbors/spaced_points.hpp"

namespace stipple {

/// Whether a radius leads across two of the cells along a direction, and there are five or more.
inline bool fine_cells(double cells, double extent, double radius) {
    const double across = radius / (extent / cells) * (1 + 1e-6);
    return cells > 4 && across >= 1 && across < 2;
}

template <std::size_t D>
struct DiskGrid {
    using Point = std::array<double, D>;
    using Index = std::array<std::uint32_t, D>;

    static constexpr unsigned tile_bits = D == 2 ? 6 : D == 3 ? 5 : D == 4 ? 3 : 2;
    static constexpr std::uint32_t tile_side = 1U << tile_bits;

    /// Cells for `cell_radius`, which is at most `radius`: a grid may serve several radii.
    DiskGrid(const BoxSpace& space, double disk_radius, double cell_radius)
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
            reach[k] = across < cells[k] ? static_cast<std::uint32_t>(across) + 1 : cells[k];
            inner[k] = fine_cells(along[k], sides[k], radius) ? cells[k] - 4 : 0;
            tiles[k] = (cells[k] + tile_side - 1) >> tile_bits;
            strides[k] = spots;
            spots *= cells[k] + 4;
            cell_count *= cells[k];
            tile_count *= tiles[k];
        }
    }

    /// Whether there are fine_cells along every direction.
    [[nodiscard]] bool fine() const {
        return std::ranges::all_of(inner, [](auto count) { return count > 0; });
    }

    /// A cell's number, where two more are counted before the first and behind the last.
    [[nodiscard]] std::size_t spot_of(const Index& cell) const {
        std::size_t spot = 0;
        for (std::size_t k = 0; k < D; ++k) spot += (cell[k] + 2) * strides[k];
        return spot;
    }

    [[nodiscard]] std::size_t tile_of(const Index& cell) const {
        std::size_t number = 0;
        for (std::size_t k = D; k-- > 0;) number = number * tiles[k] + (cell[k] >> tile_bits);
        return number;
    }

    /// The first cell of a tile, and the one behind its last.
    [[nodiscard]] std::pair<Index, Index> tile(std::size_t number) const {
        Index first{};
        Index last{};
        for (std::size_t k = 0; k < D; ++k, number /= tiles[k - 1]) {
            first[k] = static_cast<std::uint32_t>(number % tiles[k]) << tile_bits;
            last[k] = std::min(first[k] + tile_side, cells[k]);
        }
        return {first, last};
    }

    /// A cell's number within its tile.
    [[nodiscard]] static std::uint16_t place_of(const Index& cell) {
        std::uint32_t place = 0;
        for (std::size_t k = 0; k < D; ++k) place |= (cell[k] & (tile_side - 1)) << (tile_bits * k);
        return static_cast<std::uint16_t>(place);
    }

    [[nodiscard]] static Index cell_at(const Index& first, std::uint16_t place) {
        Index cell;
        for (std::size_t k = 0; k < D; ++k)
            cell[k] = first[k] + ((place >> (tile_bits * k)) & (tile_side - 1));
        return cell;
    }

    /// Whether a distance of the radius leads from the cell across no more than two cells, and
    /// across no face.
    [[nodiscard]] bool interior(const Index& cell) const {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k)
            inside &= cell[k] - 2 < inner[k];  // wraps around below 2
        return inside;
    }

    /// Calls visit(there, steps) for every cell that a distance of the radius leads to, and the
    /// steps to it; where a distance goes around a small torus, once for every way.
    template <class Visit>
    void around(const Index& cell, const Visit& visit) const {
        Index there{};
        Point steps{};
        around<D>(cell, there, steps, visit);
    }

    bool torus;
    double radius;
    Point low{};
    Point high{};
    Point sides{};
    Point widths{};  ///< of a cell
    Point scales{};  ///< of a cell, in radii
    Index cells{};
    Index reach{};  ///< cells that a distance of the radius can lead across
    Index inner{};  ///< cells from the third to the last but two, if these are what it cannot leave
    Index tiles{};
    std::array<std::size_t, D> strides{};
    std::size_t spots = 1;  ///< numbers of cells
    std::size_t cell_count = 1;
    std::size_t tile_count = 1;

  private:
    template <std::size_t K, class Visit>
    void around(const Index& cell, Index& there, Point& steps, const Visit& visit) const {
        if constexpr (K == 0) {
            visit(there, steps);
        } else {
            const std::int64_t all = cells[K - 1];
            const std::int64_t far = reach[K - 1];
            for (std::int64_t step = -far; step <= far; ++step) {
                const std::int64_t at = cell[K - 1] + step;
                if (!torus && (at < 0 || at >= all)) continue;
                there[K - 1] = static_cast<std::uint32_t>(at < 0      ? at + all
                                                          : at >= all ? at - all
                                                                      : at);
                steps[K - 1] = static_cast<double>(step);
                around<K - 1>(cell, there, steps, visit);
            }
        }
    }
};

}  // namespace stipple
