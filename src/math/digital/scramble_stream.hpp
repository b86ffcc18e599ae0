// SPDX-License-Identifier: MIT
//
// The streams of random numbers that scrambles draw from: a scramble with the seed of the generator
// before it is independent of the generator's own numbers, which come from streams below 2^32.
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
