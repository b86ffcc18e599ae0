// SPDX-License-Identifier: MIT
#include "generators/cube_windows.hpp"

#include <cstring>

#include "core/wide.hpp"
#include "generators/disk_lanes.hpp"

namespace stipple {
namespace {

/// |x - from| + more, eight times.
[[gnu::always_inline]] inline void set_far(Lanes& x, float from, float more) {
    constexpr std::int32_t all_but_the_sign = 0x7fffffff;
    x = Lanes(LaneBits(x - from) & all_but_the_sign) + more;
}

/// Bits of the eight places from which a disk may cover a part: the square of the distance to the
/// farthest corner of the nearest part is at least this, which is exact beyond its middle.
[[gnu::always_inline]] inline unsigned may_cover(const NearDisks<3, float>& near, std::size_t first,
                                                 const Raster<3, float>& window) {
    Lanes least{};
    for (std::size_t k = 0; k < 3; ++k) {
        const float part = window.part[k];
        Lanes off;
        std::memcpy(&off, near.along(k) + first, sizeof off);
        set_far(off, window.corner[k] + 2 * part, -part);
        off = off < part / 2 ? part / 2 - Lanes{} : off;
        least += off * off;
    }
    constexpr LaneBits weights{1, 2, 4, 8, 16, 32, 64, 128};
    const LaneBits found = (least < 1) & weights;
    std::int32_t bits = 0;
    for (std::size_t lane = 0; lane < 8; ++lane) bits |= found[lane];
    return static_cast<unsigned>(bits);
}

}  // namespace

STIPPLE_WIDE PartBits open_cube(const NearDisks<3, float>& near, const Raster<3, float>& window) {
    const auto& part = window.part;
    const Lanes along_x = Lanes{1, 3, 5, 7, 1, 3, 5, 7} * (part[0] / 2) + window.corner[0];
    const Lanes low_y = Lanes{1, 1, 1, 1, 3, 3, 3, 3} * (part[1] / 2) + window.corner[1];
    const Lanes along_z = Lanes{1, 3, 5, 7, 1, 3, 5, 7} * (part[2] / 2) + window.corner[2];
    std::array<LaneBits, 8> covered{};
    for (std::size_t i = 0; i < near.size(); i += 8)
        for (unsigned chosen = may_cover(near, i, window); chosen != 0; chosen &= chosen - 1) {
            const std::size_t j = i + static_cast<std::size_t>(std::countr_zero(chosen));
            Lanes x = along_x;
            Lanes y = low_y;
            Lanes upper_y = low_y;
            Lanes z = along_z;
            set_far(x, near.along(0)[j], part[0] / 2);
            set_far(y, near.along(1)[j], part[1] / 2);
            set_far(upper_y, near.along(1)[j] - 2 * part[1], part[1] / 2);
            set_far(z, near.along(2)[j], part[2] / 2);
            const Lanes left = (1 - float_slack) - z * z;
            const Lanes lower = x * x + y * y;
            const Lanes upper = x * x + upper_y * upper_y;
            for (std::size_t layer = 0; layer < 4; ++layer) {
                covered[2 * layer] |= lower < left[layer];
                covered[2 * layer + 1] |= upper < left[layer];
            }
        }
    return unset(covered);
}

}  // namespace stipple
