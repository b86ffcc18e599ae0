// SPDX-License-Identifier: MIT
#include "experiments/designs/regular_fraction.hpp"

#include <algorithm>

#include "core/machine/int128.hpp"
#include "experiments/designs/embedded_table.hpp"

namespace stipple::generators {

const char* fraction_table();  // contents of fractions.txt

namespace {

constexpr std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << i; }

/// For each factor that is not basic, the word of this factor and the factors of its product.
std::vector<std::uint64_t> generating_words(const RegularFraction& design) {
    std::vector<std::uint64_t> words;
    for (std::size_t k = 0; k < design.factors(); ++k)
        if (std::ranges::count(design.basic, k) == 0) words.push_back(bit(k) | design.product(k));
    return words;
}

/// Calls visit(x) for the XOR of every subset of `parts`, the empty one first.
template <class Visit>
void for_each_sum(const std::vector<std::uint64_t>& parts, const Visit& visit) {
    std::uint64_t sum = 0;
    visit(sum);
    for (std::uint64_t i = 1; i < bit(parts.size()); ++i)  // subsets in the order of a Gray code
        visit(sum ^= parts[static_cast<std::size_t>(std::countr_zero(i))]);
}

/// Word length counts A_t. `sums` has for each w the number B_w of sums of rows with w factors:
/// sum_t A_t z^t = 2^-r sum_w B_w (1 - z)^w (1 + z)^(k - w) (MacWilliams).
WordLengths from_rows(const std::vector<std::uint64_t>& sums, std::size_t basic) {
    const std::size_t k = sums.size() - 1;
    std::vector<Int128> total(k + 1);
    std::vector<Int128> power(k + 1);  // (1 + z)^(k - w)
    power[0] = 1;
    for (std::size_t w = k + 1; w-- > 0;) {
        for (std::size_t t = k; w < k && t > 0; --t) {
            total[t] -= total[t - 1];  // Horner's step
            power[t] += power[t - 1];
        }
        for (std::size_t t = 0; t <= k; ++t) total[t] += static_cast<Int128>(sums[w]) * power[t];
    }
    WordLengths lengths;
    for (const Int128 a : total) lengths.push_back(static_cast<std::uint64_t>(a >> basic));
    return lengths;
}

/// Line of the table.
struct FractionRow {
    std::size_t basic;
    std::size_t least;
    std::size_t most;
    std::string_view columns;
};

const std::vector<FractionRow>& fraction_rows() {
    static const auto all = [] {
        std::vector<FractionRow> rows;
        for (const auto& words : table_lines(fraction_table()))
            rows.push_back(
                {number_of(words[0]), number_of(words[1]), number_of(words[2]), words[3]});
        return rows;
    }();
    return all;
}

/// Row of the table with the fraction, nullptr if there is none.
const FractionRow* row_of(std::size_t factors, std::size_t basic) {
    const auto found = std::ranges::find_if(fraction_rows(), [&](const FractionRow& row) {
        return row.basic == basic && row.least <= factors && factors <= row.most;
    });
    return found == fraction_rows().end() ? nullptr : &*found;
}

/// Proven upper bound of the resolution: `resolution`, that of the table, except in open cases.
std::size_t bound_of(std::size_t factors, std::size_t basic, std::size_t resolution) {
    struct Open {
        std::size_t basic, first, last, bound;
    };
    constexpr Open open_resolutions[] = {{11, 48, 50, 5}, {12, 49, 50, 6}, {14, 32, 40, 7},
                                         {15, 33, 41, 8}, {15, 42, 50, 7}, {16, 39, 50, 8}};
    for (const Open& open : open_resolutions)
        if (open.basic == basic && open.first <= factors && factors <= open.last) return open.bound;
    return resolution;
}

/// Whether the table's fraction is proven to have minimum aberration: by the catalogues of up to 32
/// runs, and of 64 runs at resolution IV (Chen, Sun, Wu 1993), or by theorems on up to four
/// generators (J. Chen, C. F. J. Wu, Ann. Stat. 19 (1991) 1028-1041).
bool is_least(std::size_t factors, std::size_t basic) {
    return basic <= 5 || (basic == 6 && factors <= 32) || factors - basic <= 4;
}

}  // namespace

RegularFraction full_fraction(std::size_t factors) {
    RegularFraction design;
    for (std::size_t k = 0; k < factors; ++k) {
        design.basic.push_back(k);
        design.columns.push_back(bit(k));
    }
    return design;
}

WordLengths word_lengths(const RegularFraction& design) {
    const std::size_t k = design.factors();
    const std::size_t basic = design.basic.size();
    WordLengths counts(k + 1);
    const auto count = [&](std::uint64_t set) {
        ++counts[static_cast<std::size_t>(std::popcount(set))];
    };
    if (k - basic <= basic) {
        for_each_sum(generating_words(design), count);
        return counts;
    }
    std::vector<std::uint64_t> rows(basic);  // factors whose column contains basic factor j
    for (std::size_t j = 0; j < basic; ++j)
        for (std::size_t i = 0; i < k; ++i)
            if ((design.columns[i] & bit(j)) != 0) rows[j] |= bit(i);
    for_each_sum(rows, count);
    return from_rows(counts, basic);
}

std::size_t resolution_of(const WordLengths& lengths) {
    for (std::size_t t = 1; t < lengths.size(); ++t)
        if (lengths[t] > 0) return t;
    return 0;
}

std::vector<std::uint64_t> defining_words(const RegularFraction& design) {
    std::vector<std::uint64_t> words;
    for_each_sum(generating_words(design), [&](std::uint64_t word) { words.push_back(word); });
    words.erase(words.begin());
    std::ranges::sort(words, {}, [](std::uint64_t word) {
        // sorts by length, then alphabetically: ABD before ACE
        std::uint64_t reversed = 0;
        for (std::size_t i = 0; i < 64; ++i) reversed |= (word >> i & 1) << (63 - i);
        return std::pair(std::popcount(word), ~reversed);
    });
    return words;
}

std::optional<KnownFraction> known_fraction(std::size_t factors, std::size_t basic) {
    if (basic >= factors) return KnownFraction{.design = full_fraction(factors)};
    const FractionRow* row = row_of(factors, basic);
    if (row == nullptr) return {};
    KnownFraction known{.design = full_fraction(basic), .least = is_least(factors, basic)};
    auto& columns = known.design.columns;
    const std::size_t digits = (basic + 3) / 4;
    for (std::size_t i = 0; i < factors - basic; ++i)
        columns.push_back(number_of(row->columns.substr(i * digits, digits), 16));
    std::sort(columns.begin() + static_cast<std::ptrdiff_t>(basic), columns.end());
    known.resolution = resolution_of(word_lengths(known.design));
    known.bound = bound_of(factors, basic, known.resolution);
    return known;
}

std::optional<KnownFraction> fewest_runs(std::size_t factors, std::size_t resolution) {
    for (std::size_t basic = 1; basic <= std::min(factors, most_basic_factors); ++basic)
        if (auto known = known_fraction(factors, basic); known && known->has(resolution))
            return known;
    return {};
}

}  // namespace stipple::generators
