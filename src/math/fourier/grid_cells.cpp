// SPDX-License-Identifier: MIT
#include "math/fourier/grid_cells.hpp"

#include <cstdint>
#include <new>

#include "core/machine/large_pages.hpp"

namespace stipple {

GridCells::GridCells(std::size_t count) {
    constexpr std::size_t line = 64;
    // For large sizes calloc returns fresh pages, known to be 0, without touching them.
    room_.reset(std::calloc(count + line / sizeof(double), sizeof(double)));
    if (!room_) throw std::bad_alloc();
    ask_for_large_pages(room_.get(), count * sizeof(double));
    const auto address = reinterpret_cast<std::uintptr_t>(room_.get());
    begin_ = static_cast<double*>(room_.get()) + (line - address % line) % line / sizeof(double);
}

}  // namespace stipple
