// SPDX-License-Identifier: MIT
//
// Indicators in the unit square: disk, half-plane and the visible part of a light.
#pragma once

#include <vector>

#include "math/integrands/integrand.hpp"

namespace stipple {

std::vector<IntegrandKind> planar_integrands();

}  // namespace stipple
