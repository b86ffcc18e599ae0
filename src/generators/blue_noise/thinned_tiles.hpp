// SPDX-License-Identifier: MIT
//
// Tiles of ranked points, thinned to a density by rank. A point of rank r (0, 1, ...) at x in tile
// c has the score
//
//     (r + u_c) / rho(x),    u_c = frac(column / p + row / p^2 + seed's offset),  p^3 = p + 1,
//
// and the n points with the lowest scores are kept: about rho(x) s per tile, where s is the n-th
// score. As the u_c are spread evenly over the tiles, the number of points is rounded up in some
// tiles and down in others; so large regions get their share even if rho is too low for a point in
// every tile.
//
// Shape   if several points have the n-th score, those of lower tile, then of lower rank, are kept.
// Cost    3 visits to each candidate: points with a rank below s times the largest density in their
//         tile; 2 to 3 ns a visit and core. 16 bytes a tile.
// Promise no point is kept where the density is 0.
// Source  J. Kopf, D. Cohen-Or, O. Deussen, D. Lischinski, "Recursive Wang tiles for real-time blue
//         noise", ACM Trans. Graph. 25(3) (2006) 509-518, doi:10.1145/1141911.1141916: ranks as
//         thresholds. Their tiles are of many kinds and are subdivided.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "generators/generator.hpp"
#include "math/neighbors/periodic_voronoi.hpp"
#include "media/density_map.hpp"

namespace stipple {

/// Repetitions of a tile along the sides of the unit square.
struct Tiling {
    std::uint64_t columns = 1;
    std::uint64_t rows = 1;
    [[nodiscard]] std::uint64_t tiles() const { return columns * rows; }
};

/// Sequence of the kept points, tile by tile in rows from y = 0 on, and by rank within a tile.
/// @param tile points of [0, 1)^2 by rank
/// @return nullptr if fewer than `count` points have a density above 0
/// @throws Error(limit)
std::unique_ptr<Sequence> thinned_tiles(const std::vector<Vec2>& tile, const Tiling& tiling,
                                        std::shared_ptr<const DensityMap> density,
                                        std::uint64_t count, std::uint64_t seed,
                                        const RunContext& run);

}  // namespace stipple
