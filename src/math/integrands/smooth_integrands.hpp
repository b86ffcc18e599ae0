// SPDX-License-Identifier: MIT
//
// Integrands with one formula each: constant, Gaussian, zone plate, Owen, Sobol' g, sky.
#pragma once

#include <vector>

#include "math/integrands/integrand.hpp"

namespace stipple {

std::vector<IntegrandKind> smooth_integrands();

}  // namespace stipple
