// SPDX-License-Identifier: MIT
//
// Points outside the domain to which they should belong.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/bytes/packed.hpp"
#include "core/point_set.hpp"

namespace stipple::analyzers {

struct Outside {
    std::uint64_t count = 0;
    /// Lowest index of a point outside.
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
    std::vector<double> point = {};  ///< the point with that index

    /// Adds point `i`; indices must ascend.
    void add(std::uint64_t i, std::span<const double> at) {
        if (count++ > 0) return;
        first = i;
        point.assign(at.begin(), at.end());
    }
    void add(const Outside& other) {
        count += other.count;
        if (other.first >= first) return;
        first = other.first;
        point = other.point;
    }

    void pack(Packer& to) const { to.put(count).put(first).put_all(point); }
    static Outside unpacked(Unpacker& from) {
        Outside outside{.count = from.take<std::uint64_t>(), .first = from.take<std::uint64_t>()};
        outside.point = from.take_all<double>();
        return outside;
    }
};

/// Reports how many of `total` points are outside, and the first such point. @throws Error(input)
[[noreturn]] void refuse(const Outside& outside, std::uint64_t total, const Domain& domain,
                         std::string hint);

/// @throws Error(input) naming the first coordinate that is not finite
void require_finite(const PointSet& points);

/// Hint for the message about points outside the domain.
std::string outside_hint(const Domain& domain);

}  // namespace stipple::analyzers
