// SPDX-License-Identifier: MIT
//
// Numbers of a grid, initially 0, aligned to cache lines for transforms and vectors; in large pages
// if there are many.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace stipple {

class GridCells {
  public:
    GridCells() = default;
    explicit GridCells(std::size_t count);
    [[nodiscard]] double* get() const { return begin_; }
    [[nodiscard]] double& operator[](std::size_t i) const { return begin_[i]; }
    void reset() { *this = GridCells(); }

  private:
    struct Free {
        void operator()(void* room) const { std::free(room); }
    };

    std::unique_ptr<void, Free> room_;
    double* begin_ = nullptr;
};

}  // namespace stipple
