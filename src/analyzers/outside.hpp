// SPDX-License-Identifier: MIT
//
// Points that the domain which they are said to live on does not contain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "core/point_set.hpp"

namespace stipple::analyzers {

struct Outside {
    std::uint64_t count = 0;
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max();  ///< the lowest index

    void add(const Outside& other) {
        count += other.count;
        first = std::min(first, other.first);
    }
};

/// Counts them and names the first. @throws Error(input)
[[noreturn]] void refuse(const Outside& outside, const PointSet& points, std::string hint);

}  // namespace stipple::analyzers
