// SPDX-License-Identifier: MIT
//
// The order of doubles in [0, inf), by counting their bits 11 at a time: such doubles sort as their
// bit patterns do.
//
// Cost    6 passes of O(n), fewer where digits are all the same; 32 bytes a number.
// Promise stable; asks for a stop every few milliseconds.
#pragma once

#include <cstdint>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// A number with where it stood. The number is never -0.
struct Placed {
    double value;
    std::uint32_t place;
};

/// Sorts in place by value.
void radix_sort(std::vector<Placed>& items, const RunContext& run);

}  // namespace stipple
