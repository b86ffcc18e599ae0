// SPDX-License-Identifier: MIT
//
// The six families of A. Genz, in genz_integrands.cpp.
#pragma once

#include <vector>

#include "math/integrands/integrand.hpp"

namespace stipple {

std::vector<IntegrandKind> genz_integrands();

}  // namespace stipple
