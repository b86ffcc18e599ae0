// SPDX-License-Identifier: MIT
//
// Memory for many numbers. A system that gives it page by page, at the first touch of each 4 KiB,
// takes longer for that than a fast generator for the numbers.
#pragma once

#include <cstddef>
#include <vector>

namespace stipple {

/// So many zeros, on large pages where the system has them to give.
std::vector<double> zeros(std::size_t count);

}  // namespace stipple
