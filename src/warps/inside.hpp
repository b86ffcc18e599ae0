// SPDX-License-Identifier: MIT
//
// What a way back asks of its points.
#pragma once

#include <span>

#include "core/domain.hpp"

namespace stipple::warps {

/// @throws Error(input) naming the point.
[[noreturn]] void refuse_outside(std::span<const double> point, const Domain& domain);

/// @throws Error(input) naming the first point of `rows` that the domain does not contain.
void expect_inside(const Domain& domain, std::span<const double> rows);

}  // namespace stipple::warps
