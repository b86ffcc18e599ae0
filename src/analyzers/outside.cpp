// SPDX-License-Identifier: MIT
#include "analyzers/outside.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::analyzers {

void refuse(const Outside& outside, std::uint64_t total, const Domain& domain, std::string hint) {
    fail_with_hint(ErrorKind::input, std::move(hint),
                   "{} of {} points are outside the domain {}; the first is point {}: ({})",
                   outside.count, total, domain.title(), outside.first, join(outside.point, ", "));
}

void require_finite(const PointSet& points) {
    const auto flat = points.flat();
    const auto bad = std::ranges::find_if_not(flat, [](double x) { return std::isfinite(x); });
    if (bad == flat.end()) return;
    const auto at = static_cast<std::size_t>(bad - flat.begin());
    fail(ErrorKind::input, "x{} of point {} is {}, not a finite number",
         at % points.dimension() + 1, at / points.dimension(), *bad);
}

std::string outside_hint(const Domain& domain) {
    std::string hint = "--domain names the domain of the points";
    if (domain.spec() == "unit-cube")
        hint +=
            ", or --meta on the command that wrote them; --rescale or --bounds lo..hi maps to "
            "the cube";
    if (domain.cube_dimension() < domain.dimension())
        hint += "; float32 or few digits move points off a surface: write them as float64";
    return hint;
}

}  // namespace stipple::analyzers
