// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/cube_windows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/vectors.hpp"
#include "generators/poisson_disk/ball_lines.hpp"

#define STIPPLE_LAMBDA __attribute__((always_inline))

namespace stipple {
namespace {

#define STIPPLE_LANES 4
namespace anywhere {
#include "generators/poisson_disk/cube_lanes.hpp"
}
#undef STIPPLE_LANES
#ifdef STIPPLE_PICKS_VECTORS
#define STIPPLE_LANES 8
#pragma GCC push_options
#pragma GCC target("avx2,bmi")
namespace eights {
#include "generators/poisson_disk/cube_lanes.hpp"
}
#pragma GCC pop_options
#undef STIPPLE_LANES
#define STIPPLE_LANES 16
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl,bmi,prefer-vector-width=512")
namespace sixteens {
#include "generators/poisson_disk/cube_lanes.hpp"
}
#pragma GCC pop_options
#undef STIPPLE_LANES
#endif

struct Kernels {
    decltype(&anywhere::open_cubes) open_cubes = &anywhere::open_cubes;
    decltype(&anywhere::open_parts) open_parts = &anywhere::open_parts;
    decltype(&anywhere::find_hits) find_hits = &anywhere::find_hits;
    decltype(&anywhere::find_near) find_near = &anywhere::find_near;
    decltype(&anywhere::cover_lines) cover_lines = &anywhere::cover_lines;
};

Kernels fastest_here() {
#ifdef STIPPLE_PICKS_VECTORS
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return {&sixteens::open_cubes, &sixteens::open_parts, &sixteens::find_hits,
                &sixteens::find_near, &sixteens::cover_lines};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi"))
        return {&eights::open_cubes, &eights::open_parts, &eights::find_hits, &eights::find_near,
                &eights::cover_lines};
#endif
    return {};
}

const Kernels kernels = fastest_here();

}  // namespace

void open_cubes(const NearBalls& near, const std::array<float, 3>& scales,
                std::span<const CubeWindow> windows, PartBits* out) {
    kernels.open_cubes(near, scales, windows, out);
}

std::size_t open_parts(const NearBalls& near, const std::array<float, 3>& scales, PartBits some,
                       OpenPart* out) {
    return kernels.open_parts(near, scales, some, out);
}

std::size_t find_near(const std::array<const float*, 3>& along, std::size_t first, std::size_t last,
                      const std::array<float, 3>& place, float squared, std::uint16_t* out) {
    return kernels.find_near(along, first, last, place, squared, out);
}

void cover_lines(const std::array<float, 3>& scales, std::span<const PlacedBall> balls,
                 std::uint32_t* lines) {
    kernels.cover_lines(scales, balls, lines);
}

void find_hits(const NearBalls& near, std::span<const std::array<float, 3>> places, Hit* out) {
    kernels.find_hits(near, places, out);
}

}  // namespace stipple
