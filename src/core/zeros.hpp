// SPDX-License-Identifier: MIT
//
// Room for many numbers. Large rooms ask for large pages, where the system has them: the first
// touch of every page costs as much as making some thousand coordinates, and with pages of 4 KiB
// that was most of the time that a large set took.
#pragma once

#include <cstddef>
#include <vector>

namespace stipple {

std::vector<double> zeros(std::size_t count);

}  // namespace stipple
