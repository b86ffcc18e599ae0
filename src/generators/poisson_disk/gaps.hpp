// SPDX-License-Identifier: MIT
//
// Gaps: cubes within a cell that may be partly uncovered. A gap, like a cell, is divided into P^D
// sub-cells, each with a bit of a word: bit sum_k i_k P^k for index i_k along direction k. Open are
// sub-cells that no single disk covers. Gaps shrink to them, or are split, until nothing is open.
//
// Shape   P = 8 (D = 2), 4 (3), 2 (4 ... 6).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::poisson_disk {

/// One bit for each sub-cell.
using SubcellBits = std::uint64_t;

/// Number of sub-cells along each direction.
template <std::size_t D>
inline constexpr std::size_t subcells = D == 2   ? 8
                                        : D == 3 ? 4
                                                 : 2;

template <std::size_t D>
inline constexpr std::size_t all_subcells = power(subcells<D>, D);

/// Position of the n-th set bit of a byte, at index 8 byte + n.
inline constexpr auto nth_in_byte = [] {
    std::array<std::uint8_t, 2048> table{};
    for (std::size_t byte = 0; byte < 256; ++byte)
        for (std::size_t bit = 0, n = 0; bit < 8; ++bit)
            if ((byte >> bit & 1) != 0) table[8 * byte + n++] = static_cast<std::uint8_t>(bit);
    return table;
}();

/// Position of the n-th set bit, counted from 0; more than n bits must be set.
inline std::size_t nth_bit(SubcellBits bits, std::size_t n) {
    constexpr SubcellBits each = 0x0101010101010101U;  // 1 in each byte
    constexpr SubcellBits high = 0x8080808080808080U;
    SubcellBits counts = bits - (bits >> 1 & 0x5555555555555555U);
    counts = (counts & 0x3333333333333333U) + (counts >> 2 & 0x3333333333333333U);
    const SubcellBits up_to = ((counts + (counts >> 4)) & 0x0f0f0f0f0f0f0f0fU) * each;
    // Marks the bytes before the one that contains the n-th bit.
    const SubcellBits passed = ((n * each | high) - up_to) & high;
    const std::size_t shift = (passed >> 7) * each >> 56 << 3;
    const std::size_t before = (up_to << 8) >> shift & 0xff;
    return shift + nth_in_byte[(bits >> shift & 0xff) * 8 + n - before];
}

template <std::size_t D>
struct Gap {
    std::array<double, D> corner;  ///< offset from the cell's lowest corner, in cell sides
    std::uint16_t place;           ///< index of the cell in its tile
    std::uint8_t level;            ///< the side is 2^-level of the cell's

    [[nodiscard]] double side() const { return 1 / static_cast<double>(std::uint64_t{1} << level); }
    [[nodiscard]] double subcell_side() const { return side() / double{subcells<D>}; }
};

/// Smallest box of sub-cells around all set bits: its lowest corner and its longest side.
template <std::size_t D>
struct Extent {
    std::array<std::size_t, D> low;
    std::size_t longest = 0;

    explicit Extent(SubcellBits bits) {
        constexpr std::size_t p = subcells<D>;
        for (std::size_t k = 0, stride = 1; k < D; ++k, stride *= p) {
            SubcellBits fold = bits;  // bits projected onto direction k
            for (std::size_t other = 0, by = 1; other < D; ++other, by *= p)
                for (std::size_t half = p / 2; other != k && half > 0; half /= 2)
                    fold |= fold >> (half * by);
            SubcellBits along = 0;
            for (std::size_t i = 0; i < p; ++i) along |= (fold >> (i * stride) & 1) << i;
            low[k] = static_cast<std::size_t>(std::countr_zero(along));
            longest = std::max(longest, static_cast<std::size_t>(std::bit_width(along)) - low[k]);
        }
    }
};

/// Splits a gap into halves along every direction; adds the parts with open sub-cells to `out`.
template <std::size_t D>
void split(const Gap<D>& gap, SubcellBits open, std::vector<Gap<D>>& out) {
    constexpr std::size_t p = subcells<D>;
    constexpr SubcellBits lowest = [] {  // sub-cells of the lowest child
        SubcellBits bits = 0;
        for (std::size_t i = 0; i < all_subcells<D>; ++i) {
            bool in = true;
            for (std::size_t k = 0, rest = i; k < D; ++k, rest /= p) in = in && rest % p < p / 2;
            if (in) bits |= SubcellBits{1} << i;
        }
        return bits;
    }();
    for (std::size_t child = 0; child < power(2, D); ++child) {
        std::size_t shift = 0;
        for (std::size_t k = 0, stride = p / 2; k < D; ++k, stride *= p)
            shift += (child >> k & 1) * stride;
        if ((open >> shift & lowest) == 0) continue;
        Gap<D> half = gap;
        ++half.level;
        for (std::size_t k = 0; k < D; ++k)
            if ((child >> k & 1) != 0) half.corner[k] += half.side();
        out.push_back(half);
    }
}

/// Adds a smaller gap if one can hold all open sub-cells of this gap. Otherwise splits the gap if
/// `may_split`, or keeps it.
template <std::size_t D>
void narrow(const Gap<D>& gap, SubcellBits open, bool may_split, std::vector<Gap<D>>& out) {
    constexpr std::size_t p = subcells<D>;
    const Extent<D> extent(open);
    if (extent.longest > p / 2) {
        if (may_split) return split(gap, open, out);
        return out.push_back(gap);
    }
    Gap<D> smaller = gap;
    std::size_t fit = p;
    for (; fit > 1 && fit / 2 >= extent.longest; fit /= 2) ++smaller.level;
    for (std::size_t k = 0; k < D; ++k)
        smaller.corner[k] +=
            gap.subcell_side() * static_cast<double>(std::min(extent.low[k], p - fit));
    out.push_back(smaller);
}

/// Random point of one of the `count` open sub-cells, relative to the cell's corner, in cell sides.
template <std::size_t D>
std::array<double, D> place_in(const Gap<D>& gap, SubcellBits open, std::size_t count,
                               SplitMix64& mixer) {
    std::size_t bit = nth_bit(open, mixer.below(count));
    std::array<double, D> place;
    for (std::size_t k = 0; k < D; ++k, bit /= subcells<D>)
        place[k] =
            gap.corner[k] +
            (static_cast<double>(bit % subcells<D>) + to_unit(mixer.next())) * gap.subcell_side();
    return place;
}

/// Random numbers of a gap in one round, a function of the round's key and the gap.
template <std::size_t D>
SplitMix64 stream_of(std::uint64_t key, const Gap<D>& gap) {
    std::uint64_t state = SplitMix64(key ^ (std::uint64_t{gap.place} << 8 | gap.level)).next();
    for (const double x : gap.corner)
        state = SplitMix64(state ^ std::bit_cast<std::uint64_t>(x)).next();
    return SplitMix64(state);
}

}  // namespace stipple::poisson_disk
