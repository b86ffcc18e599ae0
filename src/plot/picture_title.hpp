// SPDX-License-Identifier: MIT
//
// What a picture of points is called, from where they come.
#pragma once

#include <string>

#include "core/point_set.hpp"

namespace stipple::plot {

/// "halton", "sobol, disk"; the file's name, where no generator is known; else "points".
std::string title_of_points(const PointSet& points, const std::string& source);

/// "1024 points, seed 3, scramble=owen": options that are not what they are by default, and the
/// seed where it matters.
std::string subtitle_of_points(const PointSet& points);

}  // namespace stipple::plot
