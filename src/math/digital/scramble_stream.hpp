// SPDX-License-Identifier: MIT
//
// Streams of random numbers for scrambles. Their ids are at least 2^32 and those of generators are
// smaller, so that a scramble is independent of a generator with the same seed.
#pragma once

#include <cstdint>

#include "core/rng.hpp"

namespace stipple {

enum class ScrambleStream : std::uint64_t {
    rotation = std::uint64_t{1} << 32,
    binary_shift,
    binary_matrix,
    binary_owen,
    base_shift,
    base_matrix,
    base_owen,
    micro_jitter
};

constexpr Rng scramble_numbers(std::uint64_t seed, ScrambleStream stream) {
    return Rng(seed, static_cast<std::uint64_t>(stream));
}

}  // namespace stipple
