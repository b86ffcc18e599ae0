// SPDX-License-Identifier: MIT
//
// Includes point sets, domains and options.
#pragma once

#include "core/domain.hpp"     // IWYU pragma: export
#include "core/options.hpp"    // IWYU pragma: export
#include "stipple/points.hpp"  // IWYU pragma: export
