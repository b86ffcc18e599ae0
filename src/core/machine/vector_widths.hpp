// SPDX-License-Identifier: MIT
//
// Includes the file STIPPLE_KERNELS three times, in the namespaces anywhere, fours and eights, with
// STIPPLE_VECTOR_BITS = 128, 256 and 512. The last two may use fused multiply-add. They need GCC or
// Clang on x86-64; elsewhere, their names are aliases of the first.
//
//     #define STIPPLE_KERNELS "folder/kernels.hpp"
//     #include "core/machine/vector_widths.hpp"
//     … pick_vectors(&anywhere::sum, &fours::sum, &eights::sum) …
//
// No pragma once: a source may include this file again for other kernels. (Pragmas are used because
// target attributes on functions take effect too late: code inlined into the functions has already
// been split into scalar operations.)

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
