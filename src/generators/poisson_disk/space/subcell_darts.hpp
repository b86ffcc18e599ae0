// SPDX-License-Identifier: MIT
//
// Darts thrown at the sub-cells of a tile in space that no ball covers alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "generators/poisson_disk/poisson_counts.hpp"
#include "generators/poisson_disk/space/space_tile.hpp"

namespace stipple::poisson_disk {

/// A dart as it is drawn.
struct DrawnDart {
    std::array<double, 3> place;  ///< in the cell: the lowest corner of a cube
    double grain;                 ///< side of that, in which the dart may be anywhere
    std::uint64_t detail;         ///< what else is drawn for it
};

/// Makes a dart pending, unless it hit a ball.
void insert(const SpaceRules& rules, const SpaceTile& tile, const TileCell<3>& cell,
            const DrawnDart& drawn, Hit hit, std::vector<PendingDart<3>>& darts);

/// Of sub-cells, 64 each, that share a Poisson number. One sub-cell more or less changes all their
/// darts, so that they are few: sets for radii that hardly differ are to be nearly the same.
inline constexpr std::size_t words_together = 4;

/// A dart on a sub-cell, as it is drawn.
struct SubcellDart {
    using Digits [[gnu::vector_size(16)]] = std::int32_t;
    Digits digits;         ///< in the cell, 2^-23 of its sides
    std::uint64_t detail;  ///< what else is drawn for it
    std::uint16_t place;   ///< of the cell
    std::uint8_t subcell;
};

/// Throws darts at the sub-cells that no ball covers alone.
/// @param drawn room for some
void throw_at_subcells(const SpaceRules& rules, const SpaceTile& tile, const PoissonCounts& counts,
                       std::uint64_t key, std::vector<SubcellDart>& drawn,
                       std::vector<PendingDart<3>>& darts);

}  // namespace stipple::poisson_disk
