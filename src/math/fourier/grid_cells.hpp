// SPDX-License-Identifier: MIT
//
// Numbers of a grid, all 0 at first, that stand where transforms and vectors like them: at the
// beginning of a cache line, and in large pages if they are many.
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
