// SPDX-License-Identifier: MIT
//
// Point sets with the domains that they are on.
#pragma once

#include "core/domain.hpp"     // IWYU pragma: export
#include "core/options.hpp"    // IWYU pragma: export
#include "stipple/points.hpp"  // IWYU pragma: export
