// SPDX-License-Identifier: MIT
//
// Darts that fall on a tile of cells in space (generators/poisson_disk/space_tiles.hpp), and what becomes
// covered between showers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "generators/poisson_disk/disk_shower.hpp"
#include "generators/poisson_disk/space_tiles.hpp"

namespace stipple {

/// A dart as it is drawn.
struct Throw {
    std::array<double, 3> place;  ///< in the cell: the lowest corner of a cube
    double grain;                 ///< side of that, in which the dart may be anywhere
    std::uint64_t detail;         ///< what else is drawn for it
};

/// Makes a dart one that may stay, unless it hit a ball.
void land(const SpaceRules& rules, const SpaceTile& tile, const SpaceCell& cell, const Throw& dart,
          Hit hit, std::vector<SpaceDart>& darts);

inline constexpr int cells_together = 8;  ///< that share a Poisson number

/// Darts everywhere.
/// @param any whether there is a point to hit
void fall_at_large(const SpaceRules& rules, const SpaceTile& tile, const Shower& shower,
                   std::uint64_t key, bool any, std::vector<SpaceDart>& darts);

/// Of parts of cells, 64 each, that share a Poisson number. One part more or less changes all their
/// darts, so that they are few: sets for radii that hardly differ are to be nearly the same.
inline constexpr std::size_t words_together = 4;

/// A dart on a part of a cell, as it is drawn.
struct PartThrow {
    using Digits [[gnu::vector_size(16)]] = std::int32_t;
    Digits digits;         ///< in the cell, 2^-23 of its sides
    std::uint64_t detail;  ///< what else is drawn for it
    std::uint16_t place;   ///< of the cell
    std::uint8_t part;
};

/// Darts on the parts of cells that no ball covers alone.
/// @param throws room for some
void fall_on_parts(const SpaceRules& rules, const SpaceTile& tile, const Shower& shower,
                   std::uint64_t key, std::vector<PartThrow>& throws,
                   std::vector<SpaceDart>& darts);

}  // namespace stipple
