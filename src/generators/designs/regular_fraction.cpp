// SPDX-License-Identifier: MIT
#include "generators/designs/regular_fraction.hpp"

#include <algorithm>
#include <numeric>

#include "core/machine/int128.hpp"
#include "math/combinatorics/combinations.hpp"

namespace stipple::generators {
namespace {

constexpr std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << i; }

/// A word for each factor that is not basic, as a set of factors.
std::vector<std::uint64_t> generating_words(const RegularFraction& design) {
    std::vector<std::uint64_t> words;
    for (std::size_t k = 0; k < design.factors(); ++k) {
        if (std::ranges::count(design.basic, k) > 0) continue;
        std::uint64_t word = bit(k);
        for (std::size_t j = 0; j < design.basic.size(); ++j)
            if ((design.columns[k] & bit(j)) != 0) word |= bit(design.basic[j]);
        words.push_back(word);
    }
    return words;
}

/// Calls visit(x) for every XOR of a choice of `parts`, the empty one first.
template <class Visit>
void for_each_sum(const std::vector<std::uint64_t>& parts, const Visit& visit) {
    std::uint64_t sum = 0;
    visit(sum);
    for (std::uint64_t i = 1; i < bit(parts.size()); ++i)  // in the order of a Gray code
        visit(sum ^= parts[static_cast<std::size_t>(std::countr_zero(i))]);
}

/// The numbers of words from those of the sums of rows: by MacWilliams,
///     sum_t A_t z^t  =  2^-r sum_w B_w (1 - z)^w (1 + z)^(k - w).
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

/// Words of up to most + 1 factors are counted as columns come and go.
class WordCounts {
  public:
    WordCounts(std::size_t basic, std::size_t most)
        : sums_(most + 1, std::vector<std::uint32_t>(bit(basic))), words_(most + 2) {
        sums_[0][0] = 1;
        for (std::size_t j = 0; j < basic; ++j) add(bit(j));
    }

    void add(std::uint64_t column) {
        for (std::size_t t = 1; t < sums_.size(); ++t) words_[t + 1] += sums_[t][column];
        for (std::size_t t = sums_.size(); --t > 0;)
            for (std::size_t x = 0; x < sums_[t].size(); ++x)
                sums_[t][x] += sums_[t - 1][x ^ column];
    }

    void remove(std::uint64_t column) {
        for (std::size_t t = 1; t < sums_.size(); ++t)
            for (std::size_t x = 0; x < sums_[t].size(); ++x)
                sums_[t][x] -= sums_[t - 1][x ^ column];
        for (std::size_t t = 1; t < sums_.size(); ++t) words_[t + 1] -= sums_[t][column];
    }

    /// A_0 (not counted), A_1, ...
    [[nodiscard]] const WordLengths& words() const { return words_; }

    /// Steps of adding or taking away a column.
    [[nodiscard]] double steps() const {
        return static_cast<double>((sums_.size() - 1) * sums_[0].size());
    }

  private:
    std::vector<std::vector<std::uint32_t>> sums_;  ///< choices of t columns with that sum
    WordLengths words_;
};

class AberrationSearch {
  public:
    AberrationSearch(std::size_t factors, std::size_t basic, std::size_t resolution,
                     const RunContext& run)
        : factors_(factors),
          resolution_(resolution),
          run_(run),
          counts_(basic, std::max<std::size_t>(3, resolution - 2)) {
        for (std::uint64_t column = bit(basic); --column > 0;)
            if (static_cast<std::size_t>(std::popcount(column)) + 1 >= resolution &&
                std::popcount(column) > 1)
                candidates_.push_back(column);
        // Odd sets have no words of three; what is left out last are small subspaces.
        std::stable_partition(candidates_.begin(), candidates_.end(),
                              [](auto column) { return std::popcount(column) % 2 != 0; });
        for (std::size_t j = 0; j < basic; ++j) {
            design_.basic.push_back(j);
            design_.columns.push_back(bit(j));
        }
    }

    FoundFraction find() {
        descend(0);
        if (best_)
            std::sort(best_->columns.begin() + static_cast<std::ptrdiff_t>(best_->basic.size()),
                      best_->columns.end());
        return {best_, steps_ < budget};
    }

  private:
    static constexpr double budget = 3e8;

    /// Whether what is chosen may become better than the best.
    [[nodiscard]] bool is_open() const {
        const WordLengths& words = counts_.words();
        for (std::size_t t = 1; t < words.size(); ++t) {
            if (t < resolution_ && words[t] > 0) return false;
            if (best_ && t <= factors_ && words[t] != least_[t]) return words[t] < least_[t];
        }
        return true;
    }

    void keep() {
        WordLengths lengths = word_lengths(design_);
        steps_ += 64.0 * static_cast<double>(factors_);
        if (best_ && !std::ranges::lexicographical_compare(lengths, least_)) return;
        best_ = design_;
        least_ = std::move(lengths);
    }

    void descend(std::size_t first) {
        if (design_.columns.size() == factors_) return keep();
        const std::size_t missing = factors_ - design_.columns.size();
        for (std::size_t i = first; i + missing <= candidates_.size(); ++i) {
            if (steps_ >= budget) return;
            steps_ += 2 * counts_.steps();
            if (++visits_ % 1024 == 0) run_.check_stop();
            counts_.add(candidates_[i]);
            design_.columns.push_back(candidates_[i]);
            if (is_open()) descend(i + 1);
            design_.columns.pop_back();
            counts_.remove(candidates_[i]);
        }
    }

    std::size_t factors_;
    std::size_t resolution_;
    const RunContext& run_;
    WordCounts counts_;
    std::vector<std::uint64_t> candidates_;
    RegularFraction design_;
    std::optional<RegularFraction> best_;
    WordLengths least_;
    double steps_ = 0;
    std::uint64_t visits_ = 0;
};

/// Whether so many runs are enough by the bound of Rao for the resolution.
bool may_exist(std::size_t factors, std::size_t basic, std::size_t resolution) {
    if (basic < 2) return false;
    const bool even = resolution % 2 == 0;
    const std::size_t k = factors - (even ? 1 : 0);
    std::uint64_t least = 0;
    for (std::size_t t = 0; t <= (resolution - 1) / 2; ++t) least += binomial(k, t);
    return least <= bit(basic - (even ? 1 : 0));
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
    std::vector<std::uint64_t> rows(basic);  // factors whose column has the j-th basic factor
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
        // By length, then as one would list them: ABD before ACE.
        std::uint64_t reversed = 0;
        for (std::size_t i = 0; i < 64; ++i) reversed |= (word >> i & 1) << (63 - i);
        return std::pair(std::popcount(word), ~reversed);
    });
    return words;
}

FoundFraction least_aberration(std::size_t factors, std::size_t basic, std::size_t resolution,
                               const RunContext& run) {
    if (basic >= factors) return {full_fraction(factors)};
    if (!may_exist(factors, basic, resolution)) return {};
    return AberrationSearch(factors, basic, resolution, run).find();
}

FoundFraction fewest_runs(std::size_t factors, std::size_t resolution, const RunContext& run) {
    bool complete = true;
    for (std::size_t basic = 1; basic <= std::min(factors, most_basic_factors); ++basic) {
        FoundFraction found = least_aberration(factors, basic, resolution, run);
        found.complete &= complete;
        if (found.design) return found;
        complete = found.complete;
    }
    return {};
}

}  // namespace stipple::generators
