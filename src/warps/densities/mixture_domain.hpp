// SPDX-License-Identifier: MIT
//
// What a mixture lives on: see mixture.cpp for its cells. Their probabilities are sums over the
// components of weight times probability: of a box, the exact share of the area for shapes of the
// plane and by the distribution functions for distributions of each coordinate; of a zone of the
// sphere, by quadrature cut at the component's rim (math/geometry/zone_integral.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/domain.hpp"

namespace stipple::warps {

/// Parts that give directions, or fill the same number of dimensions; weights that sum to 1.
DomainPtr mixture_domain(std::vector<DomainPtr> parts, std::vector<double> weights,
                         std::string spec);

}  // namespace stipple::warps
