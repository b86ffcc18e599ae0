// SPDX-License-Identifier: MIT
#include "core/machine/memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace stipple {

std::uint64_t default_memory_limit() {
    double bytes = 0x1p60;
#ifdef _SC_PHYS_PAGES
    const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
    if (pages > 0) bytes = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
    for (const char* file :
         {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        std::ifstream in(file);
        double limit = 0;
        if (in >> limit && limit > 0) bytes = std::min(bytes, limit);
    }
    return static_cast<std::uint64_t>(0.8 * bytes);
}

}  // namespace stipple
