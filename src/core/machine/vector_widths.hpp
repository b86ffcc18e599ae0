// SPDX-License-Identifier: MIT
//
// Includes the file STIPPLE_KERNELS in the namespaces anywhere, fours and eights, for vectors of
// STIPPLE_VECTOR_BITS bits: 128, 256 and 512. Wide ones have the instruction for a b + c with one
// rounding. Where the compiler cannot do that, all three are the first.
//
//     #define STIPPLE_KERNELS "folder/kernels.hpp"
//     #include "core/machine/vector_widths.hpp"
//     … pick_vectors(&anywhere::sum, &fours::sum, &eights::sum) …
//
// No pragma once: a source may do so again for other kernels. (What is inlined into functions that
// have instructions of their own was taken apart into single numbers before, hence pragmas.)

#define STIPPLE_VECTOR_BITS 128
namespace anywhere {
#include STIPPLE_KERNELS
}
#undef STIPPLE_VECTOR_BITS

#ifdef STIPPLE_PICKS_VECTORS
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma,bmi")
#endif
#define STIPPLE_VECTOR_BITS 256
namespace fours {
#include STIPPLE_KERNELS
}
#undef STIPPLE_VECTOR_BITS
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#ifdef __clang__
#pragma clang attribute push( \
    __attribute__((target("avx512f,avx512dq,avx512bw,avx512vl,fma,bmi"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl,fma,bmi,prefer-vector-width=512")
#endif
#define STIPPLE_VECTOR_BITS 512
namespace eights {
#include STIPPLE_KERNELS
}
#undef STIPPLE_VECTOR_BITS
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#else
namespace fours = anywhere;
namespace eights = anywhere;
#endif

#undef STIPPLE_KERNELS
