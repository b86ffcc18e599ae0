// SPDX-License-Identifier: MIT
#include "warps/row_mapping.hpp"

#include <fmt/ranges.h>

namespace stipple::warps {

void refuse_outside(std::span<const double> point, const Domain& domain) {
    fail(ErrorKind::input, "the point ({}) is outside the {}", fmt::join(point, ", "),
         domain.spec());
}

}  // namespace stipple::warps
