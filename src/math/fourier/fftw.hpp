// SPDX-License-Identifier: MIT
//
// What all users of FFTW share: aligned memory, and the lock around its planner.
#pragma once

#include <fftw3.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>

namespace stipple {
namespace detail {
struct FreeFftw {
    void operator()(void* p) const { fftw_free(p); }
};
}  // namespace detail

using FftwReals = std::unique_ptr<double[], detail::FreeFftw>;

/// Uninitialised numbers, aligned as FFTW likes them.
inline FftwReals fftw_reals(std::size_t count) {
    FftwReals numbers(fftw_alloc_real(count));
    if (!numbers) throw std::bad_alloc();
    return numbers;
}

inline fftw_complex* as_fftw(double* p) { return reinterpret_cast<fftw_complex*>(p); }

/// FFTW's planner takes one thread at a time.
inline std::mutex& fftw_planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace stipple
