// SPDX-License-Identifier: MIT
//
// Random points with many ties.
#pragma once

#include "core/point_set.hpp"
#include "core/rng.hpp"

namespace stipple::testing {

/// Coordinates are multiples of 1/steps from 0 to 1: ties, duplicates, points on both bounds.
inline PointSet on_lattice(std::size_t n, std::size_t d, std::uint64_t steps, std::uint64_t seed) {
    const Rng rng(seed, 17);
    PointSet p(n, d);
    for (std::size_t i = 0; i < n * d; ++i)
        p.flat()[i] = static_cast<double>(rng.below(i, steps + 1)) / static_cast<double>(steps);
    return p;
}

}  // namespace stipple::testing
