// SPDX-License-Identifier: MIT
//
// STIPPLE_WIDE in front of a function compiles it once for every width of vectors and picks at run
// time, by an indirect function of ELF. What it inlines is widened with it; results do not change,
// since nothing is contracted or reordered. Sanitizers run before the picking can, so they get the
// plain function.
#pragma once

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define STIPPLE_WIDE [[gnu::target_clones("arch=x86-64-v4", "avx2", "default")]]
#else
#define STIPPLE_WIDE
#endif
