// SPDX-License-Identifier: MIT
//
// Radix sort of doubles in [0, inf), which have the order of their bit patterns; 11 bits at a time.
//
// Cost    6 passes of O(n), skipping digits that all numbers share; 32 bytes a number.
// Promise stable; checks for a stop every few milliseconds.
#pragma once

#include <cstdint>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// A number and its original index. The number must not be -0.
struct Placed {
    double value;
    std::uint32_t place;
};

/// Sorts in place by value.
void radix_sort(std::vector<Placed>& items, const RunContext& run);

}  // namespace stipple
