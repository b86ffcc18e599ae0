// SPDX-License-Identifier: MIT
//
// The samplers that maximal_disks (generators/poisson_disk/maximal_disks.hpp) chooses from.
#pragma once

#include <cstdint>

#include "generators/poisson_disk/grid.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

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
