// SPDX-License-Identifier: MIT
//
// Short ways for tests to scramble point sets.
#pragma once

#include <numeric>
#include <string_view>

#include "core/spec.hpp"
#include "support/units.hpp"

namespace stipple::testing {

/// Points of a set from `start` on, scrambled as a spec says: "owen:base=3".
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
