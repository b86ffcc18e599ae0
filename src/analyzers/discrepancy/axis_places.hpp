// SPDX-License-Identifier: MIT
//
// The coordinates of points on one axis, sorted.
#pragma once

#include <cstdint>
#include <vector>

#include "core/run_context.hpp"
#include "math/functions/radix_sort.hpp"

namespace stipple::analyzers {

/// Sorts items in place and appends what is new of their values to `values`, which may begin with
/// smaller ones; gives the place there of every item, by its own number.
std::vector<std::uint32_t> places_on_axis(std::vector<Placed>& items, std::vector<double>& values,
                                          const RunContext& run);

}  // namespace stipple::analyzers
