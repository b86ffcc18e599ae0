// SPDX-License-Identifier: MIT
#include "analyzers/outside.hpp"

#include <fmt/ranges.h>

#include "core/error.hpp"

namespace stipple::analyzers {

void refuse(const Outside& outside, std::uint64_t total, const Domain& domain, std::string hint) {
    fail_with_hint(ErrorKind::input, std::move(hint),
                   "{} of {} points are outside the domain {}; the first is point {}: ({})",
                   outside.count, total, domain.title(), outside.first,
                   fmt::join(outside.point, ", "));
}

std::string outside_hint(const Domain& domain) {
    std::string hint = "--domain names the domain of the points";
    if (domain.spec() == "unit-cube")
        hint += ", or --meta on the first command; --rescale or --bounds lo..hi maps to the cube";
    if (domain.cube_dimension() < domain.dimension())
        hint += "; float32 or few digits move points off a surface: write them as float64";
    return hint;
}

}  // namespace stipple::analyzers
