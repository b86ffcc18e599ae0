// SPDX-License-Identifier: MIT
//
// For code that is compiled once for every width of vectors where STIPPLE_WIDE cannot be used:
// templates, and products that are added before they are rounded. core/machine/vector_widths.hpp includes
// such code once for every width; pick_vectors() chooses between the results.
#pragma once

#include <algorithm>

#if defined(__x86_64__) && defined(__GNUC__)
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
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return Vectors::eights;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi"))
        return Vectors::fours;
#endif
    return Vectors::anywhere;
}

/// Of one thing for each width, that of the widest vectors here, or of narrower ones.
template <class T>
const T& pick_vectors(const T& anywhere, const T& fours, const T& eights,
                      Vectors widest = Vectors::eights) {
    static const Vectors here = widest_vectors();
    switch (std::min(widest, here)) {
        case Vectors::eights:
            return eights;
        case Vectors::fours:
            return fours;
        default:
            return anywhere;
    }
}

}  // namespace stipple
