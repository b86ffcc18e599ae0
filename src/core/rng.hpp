// SPDX-License-Identifier: MIT
//
// Counter-based random numbers: number i of a stream is a pure function of (seed, stream, i).
//
//     Philox 4x32, 10 rounds; key = seed; counter = (i / 2, stream); two 64-bit numbers a block.
//
// Promise  the same numbers on any machine, for any number of threads, in any order of evaluation.
// Source   J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as
//          1, 2, 3", SC11 (2011), doi:10.1145/2063384.2063405.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace stipple {

/// The largest double in [0, 1) that uniform() returns.
inline constexpr double one_minus_ulp = 1.0 - 0x1p-53;

/// The 53 high bits of `bits` as a double in [0, 1).
constexpr double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// One block of Philox 4x32-10.
std::array<std::uint32_t, 4> philox_block(const std::array<std::uint32_t, 4>& counter,
                                          const std::array<std::uint32_t, 2>& key);

class Rng {
  public:
    /// @param stream separates independent uses of one seed.
    constexpr explicit Rng(std::uint64_t seed, std::uint64_t stream = 0)
        : seed_(seed), stream_(stream) {}

    /// 64 random bits, number `i` of the stream.
    [[nodiscard]] std::uint64_t bits(std::uint64_t i) const;

    /// Uniform in [0, 1), a multiple of 2^-53.
    [[nodiscard]] double uniform(std::uint64_t i) const { return to_unit(bits(i)); }

    /// Uniform in {0, ..., n - 1}; each probability is within 2^-64 of 1/n.
    [[nodiscard]] std::uint64_t below(std::uint64_t i, std::uint64_t n) const;

    /// Sets out[k] = uniform(first + k); much faster than single calls.
    void fill(std::uint64_t first, std::span<double> out) const;

  private:
    std::uint64_t seed_;
    std::uint64_t stream_;
};

}  // namespace stipple
