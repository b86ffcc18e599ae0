// SPDX-License-Identifier: MIT
//
// The families of integrands, each in a source of its name.
#pragma once

#include <vector>

#include "math/integrands/integrand.hpp"

namespace stipple {

/// The six families of A. Genz.
std::vector<IntegrandKind> genz_integrands();

/// Indicators in the unit square: disk, half-plane and the visible part of a light.
std::vector<IntegrandKind> planar_integrands();

/// One formula each: constant, Gaussian, zone plate, Owen, Sobol' g, sky.
std::vector<IntegrandKind> smooth_integrands();

}  // namespace stipple
