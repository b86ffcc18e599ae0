// SPDX-License-Identifier: MIT
#include "math/fourier/window_spreading.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

// The ABI of vectors does not matter here: they are passed only between inlined functions.

namespace stipple {
namespace {

/// Number of points that are processed together, step by step. The processor can overlap the short
/// steps of several points, but not the whole computations.
constexpr std::size_t chunk = 16;

#define STIPPLE_KERNELS "math/fourier/window_lanes.hpp"
#include "core/machine/vector_widths.hpp"

}  // namespace

void find_places(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                 std::uint32_t* tile_of, double* places, Vectors widest) {
    pick_vectors(&anywhere::find, &fours::find, &eights::find, widest)(rows, dimension, common,
                                                                       tile_of, places);
}

void spread_points(std::span<const double> places, std::size_t dimension, const SpreadTile& tile,
                   double* buffer, Vectors widest) {
    pick_vectors(&anywhere::add_points, &fours::add_points, &eights::add_points, widest)(
        places, dimension, tile, buffer);
}

}  // namespace stipple
