// SPDX-License-Identifier: MIT
//
// Support for code that is compiled once per vector width where STIPPLE_WIDE cannot be used:
// templates, and code with fused multiply-add. core/machine/vector_widths.hpp includes such code
// once per width; pick_vectors() selects the version to run.
#pragma once

#include <algorithm>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define STIPPLE_PICKS_VECTORS
#endif

#define STIPPLE_INLINE [[gnu::always_inline]] inline

namespace stipple {

/// Instruction sets that code is compiled for: the base set, or vectors of four or eight doubles.
enum class Vectors { anywhere, fours, eights };

/// The widest vectors that this processor supports.
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

/// Returns the argument for the widest vectors of this processor, but not wider than `widest`.
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
