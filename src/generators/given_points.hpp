// SPDX-License-Identifier: MIT
//
// Checks on the points of a file, for generators that start from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/point_set.hpp"
#include "generators/generator.hpp"

namespace stipple {

/// @throws Error(usage) if the request's dimension is not that of the file's points
void require_dimension(const Request& request, std::size_t dimension, const std::string& file);

/// Number of points to choose among the `all` points of a file: `asked` or, if that is 0, `usual`.
/// @throws Error(usage) if the file has fewer points than that
std::uint64_t chosen_count(std::uint64_t asked, std::uint64_t usual, std::uint64_t all,
                           const std::string& file);

/// @throws Error(input) naming the first point outside the unit cube, if any
void require_in_cube(const PointSet& points, const std::string& file, const std::string& hint = {});

}  // namespace stipple
