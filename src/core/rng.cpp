// SPDX-License-Identifier: MIT
#include "core/rng.hpp"

#include <Random123/philox.h>

#include "core/int128.hpp"
#include "core/philox_avx2.hpp"

namespace stipple {
namespace {

constexpr std::uint32_t low_word(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
constexpr std::uint32_t high_word(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
constexpr std::uint64_t join(std::uint32_t low, std::uint32_t high) {
    return low | (static_cast<std::uint64_t>(high) << 32);
}

/// Numbers 2 * pair and 2 * pair + 1 of the stream.
std::array<std::uint64_t, 2> block(std::uint64_t seed, std::uint64_t stream, std::uint64_t pair) {
    const auto out =
        philox_block({low_word(pair), high_word(pair), low_word(stream), high_word(stream)},
                     {low_word(seed), high_word(seed)});
    return {join(out[0], out[1]), join(out[2], out[3])};
}

}  // namespace

std::array<std::uint32_t, 4> philox_block(const std::array<std::uint32_t, 4>& counter,
                                          const std::array<std::uint32_t, 2>& key) {
    const auto out =
        r123::Philox4x32()({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    return {out[0], out[1], out[2], out[3]};
}

std::uint64_t Rng::bits(std::uint64_t i) const { return block(seed_, stream_, i / 2)[i % 2]; }

std::uint64_t Rng::below(std::uint64_t i, std::uint64_t n) const {
    return high_half(wide_product(bits(i), n));
}

void Rng::fill(std::uint64_t first, std::span<double> out) const {
    std::size_t k = 0;
    if (first % 2 == 1 && !out.empty()) out[k++] = uniform(first);
    if (has_philox_avx2()) {
        const std::size_t many = (out.size() - k) / philox_avx2_step * philox_avx2_step;
        fill_philox_avx2(seed_, stream_, (first + k) / 2, out.data() + k, many);
        k += many;
    }
    for (; k + 1 < out.size(); k += 2) {
        const auto pair = block(seed_, stream_, (first + k) / 2);
        out[k] = to_unit(pair[0]);
        out[k + 1] = to_unit(pair[1]);
    }
    if (k < out.size()) out[k] = uniform(first + k);
}

}  // namespace stipple
