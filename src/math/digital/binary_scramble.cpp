// SPDX-License-Identifier: MIT
#include "math/digital/binary_scramble.hpp"

#include <algorithm>

#include "core/machine/wide.hpp"
#include "math/digital/scramble_stream.hpp"

namespace stipple {
namespace {

constexpr std::size_t block_points = 256;
constexpr int group_digits = 5;  // digits per group; a group needs 31 random bits
constexpr int upper_groups = 6;  // groups in the upper part; its 30 digits fit 32 bits
constexpr int lower_groups = 5;  // groups in the lower part; 55 digits in all
constexpr std::size_t all_groups = upper_groups + lower_groups;  // also index of upper part's keys
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

/// Position of the lowest bit of group g within the upper or lower part of a number; the upper part
/// has 30 digits, the lower one 25.
constexpr std::uint32_t shift_of(std::size_t g) {
    const int after = g < upper_groups ? upper_groups - 1 - static_cast<int>(g)
                                       : static_cast<int>(all_groups) - 1 - static_cast<int>(g);
    return static_cast<std::uint32_t>(group_digits * after);
}

/// Flips for the digits of group g, shifted to the group's bits in `part`; `above` is the hash of
/// the upper part. Prefixes of up to 25 digits have distinct hashes. Longer prefixes with equal
/// hashes in one group differ in the next, because keys.factor[g] is another number.
inline std::uint32_t group_flips(const BinaryOwen::Keys& keys, std::size_t g, std::uint32_t shift,
                                 std::uint32_t part, std::uint32_t above) {
    const std::uint32_t prefix = part >> shift >> group_digits;
    const std::uint32_t node = (prefix ^ keys.before[g]) + above * keys.factor[g];
    return flips(mixed(node, keys.between[g]), (part >> shift) & group_mask) << shift;
}

inline std::uint32_t upper_part(std::uint64_t x) {
    return static_cast<std::uint32_t>(x >> (64 - upper_bits));
}
inline std::uint32_t lower_part(std::uint64_t x) {
    return static_cast<std::uint32_t>(x >> (64 - upper_bits - lower_bits)) &
           ((1U << lower_bits) - 1);
}
inline std::uint64_t joined(std::uint32_t high, std::uint32_t low) {
    return static_cast<std::uint64_t>(high) << (64 - upper_bits) |
           (static_cast<std::uint64_t>(low >> 2) << 11);
}
inline std::uint32_t hash_above(const BinaryOwen::Keys& keys, std::uint32_t high) {
    return mixed(high ^ keys.before[all_groups], keys.between[all_groups]);
}

STIPPLE_WIDE void scramble(const BinaryOwen::Keys& keys, std::uint64_t* x, std::size_t count) {
    std::uint32_t high[block_points];
    std::uint32_t low[block_points];
    for (std::size_t i = 0; i < count; ++i) {
        high[i] = upper_part(x[i]);
        low[i] = lower_part(x[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t above = hash_above(keys, high[i]);
        std::uint32_t flip = 0;
#pragma GCC unroll 5
        for (std::size_t g = upper_groups; g < all_groups; ++g)
            flip |= group_flips(keys, g, shift_of(g), low[i], above);
        low[i] ^= flip;
        flip = 0;
#pragma GCC unroll 6
        for (std::size_t g = 0; g < upper_groups; ++g)
            flip |= group_flips(keys, g, shift_of(g), high[i], 0);
        high[i] ^= flip;
    }
    for (std::size_t i = 0; i < count; ++i) x[i] = joined(high[i], low[i]);
}

/// Scrambles one number, with all groups computed at once.
STIPPLE_WIDE std::uint64_t scrambled(const BinaryOwen::Keys& keys, std::uint64_t x) {
    constexpr std::size_t groups = 12;
    static constexpr std::array<std::uint32_t, groups> shifts{
        shift_of(0), shift_of(1), shift_of(2), shift_of(3), shift_of(4), shift_of(5),
        shift_of(6), shift_of(7), shift_of(8), shift_of(9), shift_of(10)};
    const std::uint32_t high = upper_part(x);
    const std::uint32_t low = lower_part(x);
    const std::uint32_t above = hash_above(keys, high);
    std::uint32_t part[groups];
    std::uint32_t flip[groups];
    for (std::size_t g = 0; g < groups; ++g) part[g] = g < upper_groups ? high : low;
    for (std::size_t g = 0; g < groups; ++g)
        flip[g] = group_flips(keys, g, shifts[g], part[g], above);
    std::uint32_t upper = 0;
    std::uint32_t lower = 0;
    for (std::size_t g = 0; g < upper_groups; ++g) upper |= flip[g];
    for (std::size_t g = upper_groups; g < all_groups; ++g) lower |= flip[g];
    return joined(high ^ upper, low ^ lower);
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
    for (std::size_t g = upper_groups; g < all_groups; ++g)
        keys_.factor[g] = 2 * keys_.before[g - upper_groups] + 1;
}

void BinaryOwen::apply(std::span<std::uint64_t> fractions) const {
    for (std::size_t i = 0; i < fractions.size(); i += block_points)
        scramble(keys_, fractions.data() + i, std::min(block_points, fractions.size() - i));
}

std::uint64_t BinaryOwen::of(std::uint64_t fraction) const { return scrambled(keys_, fraction); }

}  // namespace stipple
