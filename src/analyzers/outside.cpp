// SPDX-License-Identifier: MIT
#include "analyzers/outside.hpp"

#include <fmt/ranges.h>

#include "core/error.hpp"

namespace stipple::analyzers {

void refuse(const Outside& outside, const PointSet& points, std::string hint) {
    fail_with_hint(ErrorKind::input, std::move(hint),
                   "{} of {} points are outside the domain {}; the first is point {}: ({})",
                   outside.count, points.count(), points.domain->spec(), outside.first,
                   fmt::join(points[outside.first], ", "));
}

}  // namespace stipple::analyzers
