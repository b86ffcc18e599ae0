// SPDX-License-Identifier: MIT
#include "math/digital/binary_scramble.hpp"

#include <algorithm>

#include "core/machine/wide.hpp"
#include "math/digital/scramble_stream.hpp"

namespace stipple {
namespace {

constexpr std::size_t block_points = 256;
constexpr int group_digits = 5;  // digits per group, whose prefixes need 31 random bits
constexpr int upper_groups = 6;  // groups in the upper part, whose prefixes fit 32 bits
constexpr int lower_groups = 5;  // groups in the lower part; 55 digits in all
constexpr std::size_t all_groups = upper_groups + lower_groups;  // index of the upper part's keys
constexpr int upper_bits = upper_groups * group_digits;
constexpr int lower_bits = lower_groups * group_digits;
constexpr std::uint32_t group_mask = (1U << group_digits) - 1;

/// A bijective 32-bit hash with a key in the middle (constants: C. Wellons, lowbias32).
inline std::uint32_t mixed(std::uint32_t x, std::uint32_t key) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x = (x + key) * 0x846ca68bU;
    return x ^ (x >> 16);
}

/// Flips for the five digits of `group`: bit 1 of `random` flips the first, bit 2 or 3 the second
/// after a 0 or a 1, bits 4 to 7 the third, and so on.
inline std::uint32_t flips(std::uint32_t random, std::uint32_t group) {
    const std::uint32_t path = (1U << group_digits) | group;
    std::uint32_t flip = 0;
    for (int level = 0; level < group_digits; ++level)
        flip |= ((random >> (path >> (group_digits - level))) & 1U) << (group_digits - 1 - level);
    return flip;
}

/// Flips for the upper thirty digits; prefixes of up to 25 digits have distinct hashes.
inline std::uint32_t upper_flips(const BinaryOwen::Keys& keys, std::uint32_t x) {
    std::uint32_t flip = 0;
#pragma GCC unroll 6
    for (int g = 0; g < upper_groups; ++g) {
        const int shift = upper_bits - group_digits * (g + 1);
        const std::uint32_t prefix = g == 0 ? 0 : x >> (shift + group_digits);
        flip |= flips(mixed(prefix ^ keys.before[static_cast<std::size_t>(g)],
                            keys.between[static_cast<std::size_t>(g)]),
                      (x >> shift) & group_mask)
                << shift;
    }
    return flip;
}

/// Flips for the lower digits; `above` is the hash of the upper part. The multiplier differs
/// between groups, so that prefixes with equal hashes in one group differ in the next.
inline std::uint32_t lower_flips(const BinaryOwen::Keys& keys, std::uint32_t above,
                                 std::uint32_t x) {
    std::uint32_t flip = 0;
#pragma GCC unroll 5
    for (int g = 0; g < lower_groups; ++g) {
        const int shift = lower_bits - group_digits * (g + 1);
        const std::uint32_t prefix = g == 0 ? 0 : x >> (shift + group_digits);
        const auto k = static_cast<std::size_t>(upper_groups + g);
        const std::uint32_t node =
            (prefix ^ keys.before[k]) + above * (2 * keys.before[static_cast<std::size_t>(g)] + 1);
        flip |= flips(mixed(node, keys.between[k]), (x >> shift) & group_mask) << shift;
    }
    return flip;
}

STIPPLE_WIDE void scramble(const BinaryOwen::Keys& keys, std::uint64_t* x, std::size_t count) {
    std::uint32_t high[block_points];
    std::uint32_t low[block_points];
    for (std::size_t i = 0; i < count; ++i) {
        high[i] = static_cast<std::uint32_t>(x[i] >> (64 - upper_bits));
        low[i] = static_cast<std::uint32_t>(x[i] >> (64 - upper_bits - lower_bits)) &
                 ((1U << lower_bits) - 1);
    }
    for (std::size_t i = 0; i < count; ++i) {
        low[i] ^= lower_flips(
            keys, mixed(high[i] ^ keys.before[all_groups], keys.between[all_groups]), low[i]);
        high[i] ^= upper_flips(keys, high[i]);
    }
    for (std::size_t i = 0; i < count; ++i)
        x[i] = static_cast<std::uint64_t>(high[i]) << (64 - upper_bits) |
               (static_cast<std::uint64_t>(low[i] >> 2) << 11);
}

}  // namespace

std::uint64_t unit_to_fraction(double x) {
    return static_cast<std::uint64_t>(std::min(x, one_minus_ulp) * 0x1p53) << 11;
}

std::uint64_t binary_shift(std::uint64_t seed, std::size_t coordinate) {
    return scramble_numbers(seed, ScrambleStream::binary_shift).bits(coordinate);
}

std::array<std::uint64_t, 64> binary_matrix(std::uint64_t seed, std::size_t coordinate) {
    const Rng rng = scramble_numbers(seed, ScrambleStream::binary_matrix);
    std::array<std::uint64_t, 64> columns{};
    for (std::size_t j = 0; j < 64; ++j) {
        const std::uint64_t digit = std::uint64_t{1} << (63 - j);
        columns[j] = digit | (rng.bits(64 * coordinate + j) & (digit - 1));
    }
    return columns;
}

BinaryOwen::BinaryOwen(std::uint64_t seed, std::size_t coordinate) : keys_{} {
    const Rng rng = scramble_numbers(seed, ScrambleStream::binary_owen);
    for (std::size_t g = 0; g < keys_.before.size(); ++g) {
        const std::uint64_t bits = rng.bits(keys_.before.size() * coordinate + g);
        keys_.before[g] = static_cast<std::uint32_t>(bits >> 32);
        keys_.between[g] = static_cast<std::uint32_t>(bits);
    }
}

void BinaryOwen::apply(std::span<std::uint64_t> fractions) const {
    for (std::size_t i = 0; i < fractions.size(); i += block_points)
        scramble(keys_, fractions.data() + i, std::min(block_points, fractions.size() - i));
}

}  // namespace stipple
