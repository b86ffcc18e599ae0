// SPDX-License-Identifier: MIT
//
// Bytes that the program has allocated and not freed, libraries' included; 0 where the system's
// allocator does not tell.
#pragma once

#include <cstdint>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace stipple {

inline std::uint64_t allocated_bytes() {
#ifdef __GLIBC__
    const auto heap = ::mallinfo2();
    return heap.uordblks + heap.hblkhd;  // small blocks of all arenas, and large ones
#else
    return 0;
#endif
}

}  // namespace stipple
