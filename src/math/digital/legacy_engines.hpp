// SPDX-License-Identifier: MIT
//
// Random number generators of old programs and libraries, to reproduce their numbers. Each is
// constructed from a seed, and next() returns its next number as a double in [0, 1).
//
// Beware  not for new work: short periods, weak low bits, few seeds.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>

#include "core/rng.hpp"

namespace stipple {

/// The C library's drand48: x <- (a x + c) mod 2^48 from x = seed * 2^16 + 0x330E; x / 2^48.
class Drand48 {
  public:
    static constexpr std::uint64_t max_seed = 0xffff'ffff;

    explicit Drand48(std::uint64_t seed) : state_(seed << 16 | 0x330E) {}
    double next();

    /// Skips `count` numbers, in O(log count) steps.
    void discard(std::uint64_t count);

  private:
    std::uint64_t state_;
};

/// The C library's random(), additive feedback x_i = x_{i-3} + x_{i-31} mod 2^32; the result is the
/// upper 31 bits divided by 2^31.
/// Beware  seeds 0 and 1 give the same numbers.
class AdditiveFeedback {
  public:
    static constexpr std::uint64_t max_seed = 0xffff'ffff;

    explicit AdditiveFeedback(std::uint64_t seed);
    double next() {
        state_[front_] += state_[rear_];
        const std::uint32_t sum = state_[front_];
        if (++front_ == state_.size()) front_ = 0;
        if (++rear_ == state_.size()) rear_ = 0;
        return (sum >> 1) * 0x1p-31;
    }

  private:
    std::array<std::uint32_t, 31> state_{};
    std::size_t front_ = 3;
    std::size_t rear_ = 0;
};

/// RANMAR, with 24-bit numbers: a lagged Fibonacci generator (differences, lags 97 and 33) combined
/// with an arithmetic sequence.
///
/// Source  G. Marsaglia, A. Zaman, W. W. Tsang, Stat. Probab. Lett. 9 (1990) 35-39; as printed by
///         F. James, Comput. Phys. Commun. 60 (1990) 329-344, doi:10.1016/0010-4655(90)90032-V.
class Ranmar {
  public:
    static constexpr std::uint32_t seeds_of_kl = 30082;
    static constexpr std::uint64_t max_seed = std::uint64_t{31329} * seeds_of_kl - 1;

    explicit Ranmar(std::uint64_t seed)
        : Ranmar(static_cast<std::uint32_t>(seed / seeds_of_kl),
                 static_cast<std::uint32_t>(seed % seeds_of_kl)) {}

    /// Needs ij in [0, 31328] and kl in [0, 30081].
    Ranmar(std::uint32_t ij, std::uint32_t kl);
    double next() {
        std::uint32_t difference = (state_[front_] - state_[rear_]) & mask24;
        state_[front_] = difference;
        front_ = front_ == 0 ? state_.size() - 1 : front_ - 1;
        rear_ = rear_ == 0 ? state_.size() - 1 : rear_ - 1;
        arithmetic_ -= step;
        arithmetic_ += modulus & (0U - (arithmetic_ >> 31));  // a branch would be unpredictable
        difference = (difference - arithmetic_) & mask24;
        return difference * 0x1p-24;
    }

  private:
    static constexpr std::uint32_t mask24 = (std::uint32_t{1} << 24) - 1;
    static constexpr std::uint32_t step = 7654321;
    static constexpr std::uint32_t modulus = 16777213;

    std::array<std::uint32_t, 97> state_{};
    std::size_t front_ = 96;
    std::size_t rear_ = 32;
    std::uint32_t arithmetic_ = 362436;
};

/// An engine of the standard library; returns the 53 high bits of its numbers, or all if fewer.
template <class Engine, std::uint64_t most>
class StandardEngine {
  public:
    static constexpr std::uint64_t max_seed = most;

    explicit StandardEngine(std::uint64_t seed) : engine_(seed) {}
    double next() { return to_unit(engine_() << std::countl_zero(std::uint64_t{Engine::max()})); }

  private:
    Engine engine_;
};

using MersenneTwister = StandardEngine<std::mt19937_64, ~std::uint64_t{0}>;

/// Beware  seeds 0 and 19780503 give the same numbers; seeds above max_seed would repeat others.
using Ranlux48 = StandardEngine<std::ranlux48, 2147483562>;

}  // namespace stipple
