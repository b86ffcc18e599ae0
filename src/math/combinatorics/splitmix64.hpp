// SPDX-License-Identifier: MIT
//
// SplitMix64: short streams of random numbers from a 64-bit key, for loops in which a block cipher
// per number would be too slow. The first outputs for different keys differ.
//
// Beware  no substitute for Rng: keys must come from an Rng, not from seeds or indices.
// Source  G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
//         OOPSLA (2014), 453-472, doi:10.1145/2660193.2660195.
#pragma once

#include <cstdint>

#include "core/machine/int128.hpp"

namespace stipple {

class SplitMix64 {
  public:
    constexpr explicit SplitMix64(std::uint64_t key) : state_(key) {}

    constexpr std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }

    /// Uniform in {0, ..., n - 1}; each probability is within 2^-64 of 1/n.
    constexpr std::uint64_t below(std::uint64_t n) {
        return static_cast<std::uint64_t>((Uint128{next()} * n) >> 64);
    }

  private:
    std::uint64_t state_;
};

}  // namespace stipple
