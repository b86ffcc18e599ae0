// SPDX-License-Identifier: MIT
//
// STIPPLE_WIDE in front of a function compiles it twice, for AVX2 and for the plain machine; the
// loader picks. Results must not depend on the choice, and don't as long as sums keep their order.
#pragma once

// The thread sanitizer is not ready yet when the loader asks which version to take.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define STIPPLE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define STIPPLE_WIDE
#endif
