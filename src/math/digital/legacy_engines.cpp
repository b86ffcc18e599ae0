// SPDX-License-Identifier: MIT
#include "math/digital/legacy_engines.hpp"

namespace stipple {
namespace {

constexpr std::uint64_t mask48 = (std::uint64_t{1} << 48) - 1;
constexpr std::uint64_t drand48_factor = 0x5'DEEC'E66D;
constexpr std::uint64_t drand48_term = 0xB;

}  // namespace

double Drand48::next() {
    state_ = (drand48_factor * state_ + drand48_term) & mask48;
    return static_cast<double>(state_) * 0x1p-48;
}

void Drand48::discard(std::uint64_t count) {
    // One step is x -> a x + c, two are x -> a (a x + c) + c, and so on by squaring. Reduction
    // modulo 2^64 by overflow does not change the result modulo 2^48.
    std::uint64_t factor = drand48_factor;
    std::uint64_t term = drand48_term;
    for (; count > 0; count /= 2) {
        if (count % 2 == 1) state_ = (factor * state_ + term) & mask48;
        term *= factor + 1;
        factor *= factor;
    }
}

AdditiveFeedback::AdditiveFeedback(std::uint64_t seed) {
    state_[0] = seed == 0 ? 1 : static_cast<std::uint32_t>(seed);
    // The minimal standard generator in the C library's signed arithmetic: a seed of 2^31 or more
    // becomes negative, and so does the remainder.
    auto word = static_cast<std::int32_t>(state_[0]);
    for (std::size_t i = 1; i < state_.size(); ++i) {
        const auto next = static_cast<std::int64_t>(word) * 16807 % 2147483647;
        word = static_cast<std::int32_t>(next < 0 ? next + 2147483647 : next);
        state_[i] = static_cast<std::uint32_t>(word);
    }
    for (int i = 0; i < 310; ++i) next();
}

Ranmar::Ranmar(std::uint32_t ij, std::uint32_t kl) {
    std::uint32_t i = ij / 177 % 177 + 2;
    std::uint32_t j = ij % 177 + 2;
    std::uint32_t k = kl / 169 % 178 + 1;
    std::uint32_t l = kl % 169;
    for (std::uint32_t& word : state_)
        for (int bit = 0; bit < 24; ++bit) {
            const std::uint32_t product = i * j % 179 * k % 179;
            i = j;
            j = k;
            k = product;
            l = (53 * l + 1) % 169;
            word = word << 1 | (l * product % 64 >= 32 ? 1 : 0);
        }
}

}  // namespace stipple
