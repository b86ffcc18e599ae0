// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/domain.hpp"

namespace stipple {

/// The factors of a product of domains; for another domain, one factor: itself on all coordinates.
std::vector<Factor> factors_of(const DomainPtr& domain);

}  // namespace stipple
