// SPDX-License-Identifier: MIT
//
// All integrands, by their names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "math/integrands/integrand.hpp"

namespace stipple {

/// All of them, those of a family together.
const std::vector<IntegrandKind>& integrand_kinds();

/// @throws Error(usage) naming the nearest one.
const IntegrandKind& integrand_kind(std::string_view name);

/// The specs of a list "NAME[:OPT=V,...],NAME...": a comma that stands before OPT=V ends no spec.
std::vector<std::string> split_specs(std::string_view list);

}  // namespace stipple
