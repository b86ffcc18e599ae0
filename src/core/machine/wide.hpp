// SPDX-License-Identifier: MIT
//
// STIPPLE_WIDE before a function compiles it once per vector width, including what it inlines; an
// ELF indirect function selects a version at run time. Results do not change, since operations are
// neither fused nor reordered. Sanitized programs get the plain function, because sanitizers call
// it before a version is selected.
#pragma once

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define STIPPLE_WIDE [[gnu::target_clones("arch=x86-64-v4", "avx2", "default")]]
#else
#define STIPPLE_WIDE
#endif
