// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace stipple {

/// Default memory limit of a process, in bytes: four fifths of the machine's memory, or of what
/// Linux's control group allows; nearly 2^60 if the system reports neither.
std::uint64_t default_memory_limit();

/// Empties a vector and frees its memory, which `vector = {}` would keep.
template <class T>
void release(std::vector<T>& vector) {
    std::vector<T>().swap(vector);
}

}  // namespace stipple
