// SPDX-License-Identifier: MIT
//
// Points from a text file, for generators that start from given ones: a point a line, coordinates
// by commas or blanks, `#` comments, and a line of names on top or none.
//
//     PointSet points = read_points("start.csv", run);
//
// Shape    as many points and coordinates as there are, at least one of each.
// Promise  every complaint names the file, the line and the column (both from 1, columns in bytes).
#pragma once

#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "media/token_file.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// @throws Error(io) as TokenFile; Error(input): words, NaN and infinities, ragged rows, no points.
PointSet read_points(const std::string& path, const RunContext& run);

/// The same from a file that is open already.
PointSet read_points(TokenFile& file, const RunContext& run);

/// Points in groups: a blank line, or one of a comment alone, begins another. At least one group,
/// none of them empty.
std::vector<PointSet> read_point_groups(TokenFile& file, const RunContext& run);

}  // namespace stipple
