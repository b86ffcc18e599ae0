// SPDX-License-Identifier: MIT
#include "math/fourier/window_spreading.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

// The vectors never leave a function that is not inlined.

namespace stipple {
namespace {

/// Points that go through the steps together: each step is short enough for the processor to work
/// on several points at once, which it could not from one end to the other.
constexpr std::size_t chunk = 16;

#define STIPPLE_LANES 4
namespace anywhere {
#include "math/fourier/window_lanes.hpp"
}
#ifdef STIPPLE_PICKS_VECTORS
#define STIPPLE_FUSES
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace fours {
#include "math/fourier/window_lanes.hpp"
}
#pragma GCC pop_options
#undef STIPPLE_LANES
#define STIPPLE_LANES 8
#pragma GCC push_options
#pragma GCC target("fma,avx512f,avx512dq,avx512vl,prefer-vector-width=512")
namespace eights {
#include "math/fourier/window_lanes.hpp"
}
#pragma GCC pop_options
#undef STIPPLE_FUSES
#endif
#undef STIPPLE_LANES

/// What is done with vectors of some width: the same operations in the same order, so that the
/// result has the same bits.
struct Work {
    void (*add_points)(std::span<const double>, std::size_t, const SpreadTile&, double*);
    void (*find)(std::span<const double>, std::size_t, const SpreadTile&, std::uint32_t*, double*);
};

Work work_of([[maybe_unused]] Vectors widest) {
#ifdef STIPPLE_PICKS_VECTORS
    static const Vectors here = widest_vectors();
    if (std::min(widest, here) == Vectors::eights) return {eights::add_points, eights::find};
    if (std::min(widest, here) == Vectors::fours) return {fours::add_points, fours::find};
#endif
    return {anywhere::add_points, anywhere::find};
}

}  // namespace

void find_places(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                 std::uint32_t* tile_of, double* places, Vectors widest) {
    work_of(widest).find(rows, dimension, common, tile_of, places);
}

void spread_points(std::span<const double> places, std::size_t dimension, const SpreadTile& tile,
                   double* buffer, Vectors widest) {
    work_of(widest).add_points(places, dimension, tile, buffer);
}

}  // namespace stipple
