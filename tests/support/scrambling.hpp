// SPDX-License-Identifier: MIT
//
// Shorthands for scrambling point sets.
#pragma once

#include <numeric>
#include <string_view>

#include "core/spec.hpp"
#include "support/units.hpp"

namespace stipple::testing {

/// Scrambles points by a spec such as "owen:base=3"; the first has index `start`.
inline PointSet scrambled(PointSet points, std::string_view spec, std::uint64_t seed = 1,
                          std::uint64_t start = 0) {
    const Spec parsed = parse_spec(spec);
    const Scramble& unit = *scramble_named(parsed.name);
    ScrambleRequest request{.seed = seed, .count = start + points.count()};
    request.coordinates.resize(points.dimension());
    std::iota(request.coordinates.begin(), request.coordinates.end(), std::size_t{0});
    unit.make(parsed.values(unit.options), request)(start, points.flat());
    return points;
}

}  // namespace stipple::testing
