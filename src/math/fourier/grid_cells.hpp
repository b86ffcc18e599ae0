// SPDX-License-Identifier: MIT
//
// What all users of FFTW share: numbers of a grid, all 0 at first, that stand where it and vectors
// like them, at the beginning of a cache line and in large pages if they are many; its complex
// numbers; and the lock around its planner.
#pragma once

#include <fftw3.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <mutex>

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

inline fftw_complex* as_fftw(double* p) { return reinterpret_cast<fftw_complex*>(p); }

/// FFTW's planner takes one thread at a time.
inline std::mutex& fftw_planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace stipple
