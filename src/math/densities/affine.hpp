// SPDX-License-Identifier: MIT
//
// Formulas that are affine inequalities in their variables, as half-spaces:
//
//     2*length + load < 300    ->    (2, 1) . (length, load) <= 300
//
// Read are + - * / and parentheses, where one factor of a product and each divisor are constant, one
// of < <= > >= between two sums, and several of these joined by &&. Constants are what a formula
// without variables may be: sqrt(2)/3. Whether an inequality is strict makes no difference, but
// between constants.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "math/densities/expression.hpp"
#include "math/polytopes/half_space.hpp"

namespace stipple {

/// Nothing where a formula is another one. Each half-space has the whole text.
/// @param text a formula that Expression takes
std::optional<std::vector<HalfSpace>> affine_inequalities(std::string_view text,
                                                          const VariableNames& variables,
                                                          std::size_t dimension);

}  // namespace stipple
