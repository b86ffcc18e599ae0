// SPDX-License-Identifier: MIT
//
// Regular two-level fractions 2^(k-p): r = k - p basic factors take all combinations of their
// levels, and every other one is a product of some of them, its column. A set of factors whose
// columns have the product 1 is a word of the defining relation; the shortest word's length is the
// resolution.
//
//     A_t = number of words of length t        the word length pattern
//
// Of two designs the one with fewer words of the least length at which they differ has less
// aberration. Columns are sets of basic factors, bit j for the j-th; products are their XOR.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace stipple::generators {

struct RegularFraction {
    std::vector<std::size_t> basic;      ///< the basic factors; run i has bit j of i for the j-th
    std::vector<std::uint64_t> columns;  ///< of every factor
    std::vector<bool> negative = {};     ///< factors whose sign is turned; empty: none

    [[nodiscard]] std::size_t factors() const { return columns.size(); }
    [[nodiscard]] std::uint64_t runs() const { return std::uint64_t{1} << basic.size(); }

    /// 0 or 1.
    [[nodiscard]] std::size_t level(std::uint64_t run, std::size_t factor) const {
        const bool low = std::popcount(columns[factor] & ~run) % 2 != 0;
        return low == (!negative.empty() && negative[factor]) ? 1 : 0;
    }
};

/// All combinations of the levels.
RegularFraction full_fraction(std::size_t factors);

using WordLengths = std::vector<std::uint64_t>;  ///< A_0 = 1, A_1, ..., A_k

/// O(2^min(p, r) k).
WordLengths word_lengths(const RegularFraction& design);

/// Length of the shortest word; 0 of a full factorial, which has none.
std::size_t resolution_of(const WordLengths& lengths);

/// Words of the defining relation as sets of factors, less the empty one: 2^p - 1.
std::vector<std::uint64_t> defining_words(const RegularFraction& design);

/// A fraction of the table (fraction_table.hpp), or all combinations.
struct KnownFraction {
    RegularFraction design;
    std::size_t resolution = 0;  ///< 0 of a full factorial, which has no word
    std::size_t bound = 0;       ///< no fraction of so many runs has a higher resolution
    bool least = true;           ///< none has less aberration, as has been proven

    [[nodiscard]] bool has(std::size_t asked) const {
        return resolution == 0 || resolution >= asked;
    }
};

/// Basic factors up to which there are fractions.
inline constexpr std::size_t most_basic_factors = 16;

/// The fraction of 2^basic runs; nullopt if there is none, as main effects would be aliased.
std::optional<KnownFraction> known_fraction(std::size_t factors, std::size_t basic);

/// The one with the fewest runs for a resolution, if they are 2^most_basic_factors at most.
std::optional<KnownFraction> fewest_runs(std::size_t factors, std::size_t resolution);

}  // namespace stipple::generators
