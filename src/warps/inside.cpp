// SPDX-License-Identifier: MIT
#include "warps/inside.hpp"

#include <fmt/ranges.h>

#include "core/error.hpp"

namespace stipple::warps {

void refuse_outside(std::span<const double> point, const Domain& domain) {
    fail(ErrorKind::input, "the point ({}) is outside the domain {}", fmt::join(point, ", "),
         domain.spec());
}

void expect_inside(const Domain& domain, std::span<const double> rows) {
    const std::size_t d = domain.dimension();
    for (std::size_t i = 0; i + d <= rows.size(); i += d)
        if (!domain.contains(rows.subspan(i, d))) refuse_outside(rows.subspan(i, d), domain);
}

}  // namespace stipple::warps
