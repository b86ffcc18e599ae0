// SPDX-License-Identifier: MIT
#include "core/large_memory.hpp"

#include <sys/mman.h>

#include <bit>
#include <cstdint>

namespace stipple {
namespace {

#ifdef MADV_HUGEPAGE
constexpr std::uintptr_t page = std::uintptr_t{1} << 12;

/// Below it, an allocator keeps memory for the next time rather than ask the system.
constexpr std::size_t large = std::size_t{1} << 22;

/// A wish for pages not touched yet; what comes of it changes no result.
void prefer_large_pages(const double* data, std::size_t bytes) {
    if (bytes < large) return;
    const auto begin = (std::bit_cast<std::uintptr_t>(data) + page - 1) & ~(page - 1);
    const auto end = (std::bit_cast<std::uintptr_t>(data) + bytes) & ~(page - 1);
    ::madvise(std::bit_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}
#else
void prefer_large_pages(const double*, std::size_t) {}
#endif

}  // namespace

std::vector<double> zeros(std::size_t count) {
    std::vector<double> numbers;
    numbers.reserve(count);
    prefer_large_pages(numbers.data(), count * sizeof(double));
    numbers.resize(count);
    return numbers;
}

}  // namespace stipple
