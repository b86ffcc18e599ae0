// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/ball_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/machine/vectors.hpp"
#include "generators/poisson_disk/space/ball_lines.hpp"

#define STIPPLE_LAMBDA __attribute__((always_inline))

namespace stipple::poisson_disk {
namespace {

#define STIPPLE_KERNELS "generators/poisson_disk/space/ball_lanes.hpp"
#include "core/machine/vector_widths.hpp"

}  // namespace

void open_gaps(const NearBalls& near, const std::array<float, 3>& scales,
               std::span<const Gap<3>> gaps, SubcellBits* out) {
    pick_vectors(&anywhere::open_gaps, &fours::open_gaps, &eights::open_gaps)(near, scales, gaps,
                                                                              out);
}

void open_subcells(const NearBalls& near, const std::array<float, 3>& scales, SubcellBits some,
                   SubcellBits* out) {
    pick_vectors(&anywhere::open_subcells, &fours::open_subcells, &eights::open_subcells)(
        near, scales, some, out);
}

Hit find_hit(const NearBalls& near, const std::array<float, 3>& place) {
    return pick_vectors(&anywhere::find_hit, &fours::find_hit, &eights::find_hit)(near, place);
}

void cover_lines(const std::array<float, 3>& scales, std::span<const PlacedBall> balls,
                 std::uint32_t* lines) {
    pick_vectors(&anywhere::cover_lines, &fours::cover_lines, &eights::cover_lines)(scales, balls,
                                                                                    lines);
}

}  // namespace stipple::poisson_disk
