// SPDX-License-Identifier: MIT
//
// Regular two-level fractions 2^(k-p): r = k - p basic factors take all combinations of their
// levels. The column of every other factor is a product of some basic factors. A set of factors
// whose columns have the product 1 is a word of the defining relation. The resolution is the length
// of the shortest word. Of two designs, that with fewer words of the smallest length for which they
// differ has less aberration. Columns are sets of basic factors, stored with bit j for basic factor
// j; products are their XOR.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace stipple::generators {

struct RegularFraction {
    /// Basic factors. Basic factor j has its high level in run i if bit j of i is 1.
    std::vector<std::size_t> basic;
    std::vector<std::uint64_t> columns;  ///< column of every factor
    std::vector<bool> negative = {};     ///< whether a factor's sign is reversed; may be empty

    [[nodiscard]] std::size_t factors() const { return columns.size(); }
    [[nodiscard]] std::uint64_t runs() const { return std::uint64_t{1} << basic.size(); }
    /// Level 0 or 1 of a factor in a run.
    [[nodiscard]] std::size_t level(std::uint64_t run, std::size_t factor) const {
        const bool low = std::popcount(columns[factor] & ~run) % 2 != 0;
        return low == reversed(factor) ? 1 : 0;
    }

    [[nodiscard]] bool reversed(std::size_t factor) const {
        return factor < negative.size() && negative[factor];
    }

    /// Basic factors whose product is the column of a factor, one bit each.
    [[nodiscard]] std::uint64_t product(std::size_t factor) const {
        std::uint64_t product = 0;
        for (std::size_t j = 0; j < basic.size(); ++j)
            product |= (columns[factor] >> j & 1) << basic[j];
        return product;
    }
};

/// Full factorial: all combinations of the levels.
RegularFraction full_fraction(std::size_t factors);

using WordLengths = std::vector<std::uint64_t>;  ///< numbers A_t of words of t letters

/// Word length pattern, in O(2^min(p, r) k).
WordLengths word_lengths(const RegularFraction& design);

/// Length of the shortest word; 0 for a full factorial, which has no words.
std::size_t resolution_of(const WordLengths& lengths);

/// The 2^p - 1 nonempty words of the defining relation, as sets of factors.
std::vector<std::uint64_t> defining_words(const RegularFraction& design);

/// Best known fraction (fractions.txt), or the full factorial.
struct KnownFraction {
    RegularFraction design;
    std::size_t resolution = 0;  ///< 0 for a full factorial
    std::size_t bound = 0;       ///< proven upper bound of the resolution for this number of runs
    bool least = true;           ///< whether the aberration is proven to be minimal

    [[nodiscard]] bool has(std::size_t asked) const {
        return resolution == 0 || resolution >= asked;
    }
};

/// Largest number of basic factors in the table.
inline constexpr std::size_t most_basic_factors = 16;

/// Best known fraction of 2^basic runs; nullopt if main effects would be aliased with each other.
std::optional<KnownFraction> known_fraction(std::size_t factors, std::size_t basic);

/// Fraction of at least this resolution with the fewest runs; nullopt if the table has none.
std::optional<KnownFraction> fewest_runs(std::size_t factors, std::size_t resolution);

}  // namespace stipple::generators
