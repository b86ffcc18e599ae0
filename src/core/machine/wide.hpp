// SPDX-License-Identifier: MIT
//
// With GCC on x86-64, STIPPLE_WIDE before a function compiles it once per vector width, including
// what it inlines; an ELF indirect function selects a version at run time. Results do not change,
// since operations are neither fused nor reordered. Programs built with a sanitizer get the plain
// function, because sanitizers call the function before a version is selected.
//
// In optimised builds, GCC compiles these functions at -O3, whatever level applies to the rest of
// their file. It inlines other functions of the file into them only if those are small, or if the
// marked function also has [[gnu::flatten]]. STIPPLE_LOOPS gives this alone, without versions, which
// would make the program larger: it is for loops that wider vectors would not make twice as fast.
#pragma once

#if !defined(__GNUC__) || defined(__clang__) || !defined(__OPTIMIZE__) || \
    defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STIPPLE_LOOPS
#define STIPPLE_WIDE
#else
#define STIPPLE_LOOPS [[gnu::optimize("O3")]]
#if defined(__x86_64__) && defined(__ELF__)
#define STIPPLE_WIDE STIPPLE_LOOPS [[gnu::target_clones("arch=x86-64-v4", "avx2", "default")]]
#else
#define STIPPLE_WIDE STIPPLE_LOOPS
#endif
#endif
