// SPDX-License-Identifier: MIT
//
// Formulas that are affine inequalities in their variables, as half-spaces:
//
//     2*length + load < 300    ->    (2, 1) . (length, load) <= 300
//
// Supported are + - * / and parentheses if one factor of each product and all divisors are
// constant, one of < <= > >= between two sums, and several such inequalities joined by &&.
// Constants may be any formula without variables: sqrt(2)/3. The operators < and <= differ only if
// both sides are constant.
#pragma once

#include <optional>
#include <vector>

#include "math/densities/expression.hpp"
#include "math/polytopes/half_space.hpp"

namespace stipple {

/// Half-spaces whose intersection a formula describes, each with the formula's whole text; nullopt
/// if the formula has another form.
std::optional<std::vector<HalfSpace>> affine_inequalities(const Expression& formula);

}  // namespace stipple
