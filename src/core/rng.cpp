// SPDX-License-Identifier: MIT
#include "core/rng.hpp"

#include <Random123/philox.h>

#include <algorithm>

#include "core/machine/int128.hpp"
#include "core/machine/wide.hpp"

namespace stipple {
namespace {

constexpr std::uint32_t low_word(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
constexpr std::uint32_t high_word(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
constexpr std::uint64_t join(std::uint32_t low, std::uint32_t high) {
    return low | (static_cast<std::uint64_t>(high) << 32);
}

/// Numbers 2 * pair and 2 * pair + 1 of the stream.
std::array<std::uint64_t, 2> random_block(std::uint64_t seed, std::uint64_t stream,
                                          std::uint64_t pair) {
    const auto out =
        philox_block({low_word(pair), high_word(pair), low_word(stream), high_word(stream)},
                     {low_word(seed), high_word(seed)});
    return {join(out[0], out[1]), join(out[2], out[3])};
}

/// Equals to_unit() of the 64-bit number with the halves `low` and `high`, exactly. Uses only
/// conversions that all vector units have.
constexpr double unit_of(std::uint32_t low, std::uint32_t high) {
    const auto upper = static_cast<double>(static_cast<std::int32_t>(high ^ 0x80000000U)) + 0x1p31;
    return upper * 0x1p-32 + static_cast<double>(static_cast<std::int32_t>(low >> 11)) * 0x1p-53;
}

/// Writes numbers 2 * pair, 2 * pair + 1, ... of the stream; `count` is even. Computes blocks side
/// by side: each vector holds one counter word of many blocks.
STIPPLE_WIDE void fill_pairs(std::uint64_t seed, std::uint64_t stream, std::uint64_t pair,
                             double* out, std::size_t count) {
    constexpr std::size_t most = 64;
    std::uint32_t w0[most], w1[most], w2[most], w3[most];
    for (std::size_t first = 0; first < count; first += 2 * most, pair += most) {
        const std::size_t n = std::min(most, (count - first) / 2);
        for (std::size_t l = 0; l < n; ++l) {
            w0[l] = low_word(pair + l);
            w1[l] = high_word(pair + l);
            w2[l] = low_word(stream);
            w3[l] = high_word(stream);
        }
        std::uint32_t low = low_word(seed);
        std::uint32_t high = high_word(seed);
        for (int round = 0; round < 10; ++round, low += 0x9E3779B9, high += 0xBB67AE85)
            for (std::size_t l = 0; l < n; ++l) {
                const std::uint64_t p0 = std::uint64_t{0xD2511F53} * w0[l];
                const std::uint64_t p2 = std::uint64_t{0xCD9E8D57} * w2[l];
                w0[l] = high_word(p2) ^ w1[l] ^ low;
                w1[l] = low_word(p2);
                w2[l] = high_word(p0) ^ w3[l] ^ high;
                w3[l] = low_word(p0);
            }
        for (std::size_t l = 0; l < n; ++l) {
            out[first + 2 * l] = unit_of(w0[l], w1[l]);
            out[first + 2 * l + 1] = unit_of(w2[l], w3[l]);
        }
    }
}

}  // namespace

std::array<std::uint32_t, 4> philox_block(const std::array<std::uint32_t, 4>& counter,
                                          const std::array<std::uint32_t, 2>& key) {
    const auto out =
        r123::Philox4x32()({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    return {out[0], out[1], out[2], out[3]};
}

std::uint64_t Rng::bits(std::uint64_t i) const {
    return random_block(seed_, stream_, i / 2)[i % 2];
}

std::uint64_t Rng::below(std::uint64_t i, std::uint64_t n) const {
    return high_half(wide_product(bits(i), n));
}

void Rng::fill(std::uint64_t first, std::span<double> out) const {
    if (out.empty()) return;
    if (first % 2 == 1) {
        out.front() = uniform(first++);
        out = out.subspan(1);
    }
    const std::size_t even = out.size() / 2 * 2;
    fill_pairs(seed_, stream_, first / 2, out.data(), even);
    if (even < out.size()) out.back() = uniform(first + even);
}

}  // namespace stipple
