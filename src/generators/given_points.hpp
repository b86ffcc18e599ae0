// SPDX-License-Identifier: MIT
//
// What generators that start from the points of a file ask of them.
#pragma once

#include <string>

#include "core/point_set.hpp"
#include "generators/generator.hpp"

namespace stipple {

/// @throws Error(usage) where another dimension is asked for than the file's points have
void require_dimension(const Request& request, const PointSet& points, const std::string& file);

/// @throws Error(input) naming the first point outside the unit cube
void require_in_cube(const PointSet& points, const std::string& file, const std::string& hint = {});

}  // namespace stipple
