// SPDX-License-Identifier: MIT
//
// For code that is compiled once for every width of vectors, where STIPPLE_WIDE cannot be used:
// templates, and products that are added before they are rounded. Such code stands in a file that
// is included under `#pragma GCC target` in one namespace after the other.
#pragma once

// One instruction adds a product without rounding it where there is one, and a slow function else.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <immintrin.h>
#define STIPPLE_PICKS_VECTORS
#endif

#define STIPPLE_INLINE [[gnu::always_inline]] inline

namespace stipple {

/// Instructions that code may be compiled for: vectors of four or of eight doubles.
enum class Vectors { anywhere, fours, eights };

/// The widest that this processor has.
inline Vectors widest_vectors() {
#ifdef STIPPLE_PICKS_VECTORS
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        return Vectors::eights;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Vectors::fours;
#endif
    return Vectors::anywhere;
}

}  // namespace stipple
