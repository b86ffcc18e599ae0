// SPDX-License-Identifier: MIT
//
// The grid of cells that multi-jittered sets have: of a given shape, or as square as the count lets
// it be.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/options.hpp"
#include "generators/generator.hpp"

namespace stipple::generators {

inline constexpr Param<Extents> shape_option{
    {.name = "shape",
     .unit = "cells",
     .help = "Columns x rows, such as 40x25; gives the count. Without it: as square as the count "
             "allows"}};

/// Number of columns for `count` points: the shape's; or the divisor of the count nearest to its
/// root from below, if not less than sqrt(1/2) of it; or the root, rounded down.
std::uint64_t jitter_columns(std::uint64_t count, const Values& options);

/// The plan for the product of the sides as count, and their number as dimension.
/// @param cells what messages call them. @throws Error(usage) when the request contradicts it
Plan plan_of_shape(const Request& request, const std::vector<std::int64_t>& sides,
                   std::string_view cells);

/// The plan that count and shape imply. @throws Error(usage) when they contradict each other.
Plan plan_jitter_grid(const Request& request, const Values& options);

}  // namespace stipple::generators
