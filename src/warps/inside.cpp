// SPDX-License-Identifier: MIT
#include "warps/inside.hpp"

#include <fmt/ranges.h>

#include "core/error.hpp"

namespace stipple::warps {

void expect_inside(const Domain& domain, std::span<const double> rows) {
    const std::size_t d = domain.dimension();
    for (std::size_t i = 0; i + d <= rows.size(); i += d) {
        const auto point = rows.subspan(i, d);
        if (!domain.contains(point))
            fail(ErrorKind::input, "the point ({}) is outside the {}", fmt::join(point, ", "),
                 domain.spec());
    }
}

}  // namespace stipple::warps
