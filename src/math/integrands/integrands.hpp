// SPDX-License-Identifier: MIT
//
// All integrands, by their names.
#pragma once

#include <string_view>
#include <vector>

#include "math/integrands/integrand.hpp"

namespace stipple {

/// All of them, those of a family together.
const std::vector<IntegrandKind>& integrand_kinds();

/// @throws Error(usage) naming the nearest one.
const IntegrandKind& integrand_kind(std::string_view name);

}  // namespace stipple
