// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// The points of a file in any format that is read, for generators that begin with given ones.
/// Densities and weights of a table are no coordinates.
/// @throws Error(input), Error(io) naming the file, also where it holds several sets; Error(usage)
/// for standard input, which could not be read again
PointSet points_from(const std::string& path, const RunContext& run);

}  // namespace stipple
