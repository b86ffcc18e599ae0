// SPDX-License-Identifier: MIT
//
// What generators that start from the points of a file ask of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/point_set.hpp"
#include "generators/generator.hpp"

namespace stipple {

/// @throws Error(usage) where another dimension is asked for than the file's points have
void require_dimension(const Request& request, std::size_t dimension, const std::string& file);

/// Number of points to choose among the `all` of a file: `asked`, or if that is 0 the usual number.
/// @throws Error(usage) if there are fewer
std::uint64_t chosen_count(std::uint64_t asked, std::uint64_t usual, std::uint64_t all,
                           const std::string& file);

/// @throws Error(input) naming the first point outside the unit cube
void require_in_cube(const PointSet& points, const std::string& file, const std::string& hint = {});

}  // namespace stipple
