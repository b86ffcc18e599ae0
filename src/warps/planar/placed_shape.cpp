// SPDX-License-Identifier: MIT
#include "warps/planar/placed_shape.hpp"

#include "core/error.hpp"

namespace stipple::warps {
namespace {

/// Converts degrees to turns in [0, 1).
double turn_of_degrees(double degrees) {
    const double turns = degrees / 360;
    const double rest = turns - std::floor(turns);
    return rest < 1 ? rest : 0;  // just below an integer, the difference rounds to 1
}

}  // namespace

Placement place(const std::vector<double>& center, double size, double degrees, double finest,
                std::string_view what) {
    if (center.size() != 2)
        fail(ErrorKind::usage, "--center: expected 2 numbers, x,y; {} given", center.size());
    for (const double x : center) require_resolved("--", "center", x, what, finest);
    const double turn = turn_of_degrees(degrees);
    const auto [c, s] = cos_sin_turns(turn);
    return {.center = {center[0] + 0.0, center[1] + 0.0},  // + 0.0 avoids -0 in the points
            .size = size,
            .turn = turn,
            .cos = c,
            .sin = s};
}

}  // namespace stipple::warps
