// SPDX-License-Identifier: MIT
//
// Memory comes fastest when it is asked for in order, which the processor then goes on with by
// itself. What is to be looked at in no order, and all fits into a cache, is better fetched first.
#pragma once

#include <cstddef>
#include <span>

namespace stipple {

/// Reads some of every 64 bytes, first to last.
template <class T>
void fetch(std::span<const T> room) {
    static_assert(64 % sizeof(T) == 0);
    for (std::size_t i = 0; i < room.size(); i += 64 / sizeof(T)) {
        [[maybe_unused]] const std::byte read =
            reinterpret_cast<const volatile std::byte&>(room[i]);
    }
}

}  // namespace stipple
