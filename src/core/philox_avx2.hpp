// SPDX-License-Identifier: MIT
//
// Philox 4x32-10 for machines with AVX2: the numbers that Rng::fill gives, eight blocks at a time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stipple {

/// Numbers that are made together: two for each of eight blocks.
inline constexpr std::size_t philox_avx2_step = 16;

/// Whether this machine can.
bool has_philox_avx2();

/// out[k] = Rng(seed, stream).uniform(2 * pair + k) for k < count, a multiple of philox_avx2_step.
void fill_philox_avx2(std::uint64_t seed, std::uint64_t stream, std::uint64_t pair, double* out,
                      std::size_t count);

}  // namespace stipple
