// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace stipple {

/// Default memory limit of a process, in bytes: four fifths of the machine's memory, or of what
/// Linux's control group allows; nearly 2^60 if the system reports neither.
std::uint64_t default_memory_limit();

}  // namespace stipple
