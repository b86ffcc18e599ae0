// SPDX-License-Identifier: MIT
#include "core/rows.hpp"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace stipple {
namespace {

constexpr std::size_t large = std::size_t{1} << 22;  // bytes; two large pages of x86-64

/// Advice only: where it is refused, nothing changes.
void ask_for_large_pages([[maybe_unused]] double* room, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(room);
    const std::uintptr_t first = (begin + page - 1) / page * page;
    const std::uintptr_t last = (begin + bytes) / page * page;
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace

Rows Rows::unwritten(std::size_t count) {
    Rows rows;
    rows.fresh_ = std::make_unique_for_overwrite<double[]>(count);
    rows.view_ = {rows.fresh_.get(), count};
    if (count * sizeof(double) >= large)
        ask_for_large_pages(rows.fresh_.get(), count * sizeof(double));
    return rows;
}

}  // namespace stipple
