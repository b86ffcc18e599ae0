// SPDX-License-Identifier: MIT
//
// What all users of FFTW share: its complex numbers, and the lock around its planner.
#pragma once

#include <fftw3.h>

#include <mutex>

namespace stipple {

inline fftw_complex* as_fftw(double* p) { return reinterpret_cast<fftw_complex*>(p); }

/// FFTW's planner takes one thread at a time.
inline std::mutex& fftw_planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace stipple
