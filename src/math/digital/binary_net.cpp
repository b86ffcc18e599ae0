// SPDX-License-Identifier: MIT
#include "math/digital/binary_net.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "core/machine/wide.hpp"
#include "math/arithmetic/bits.hpp"

namespace stipple {
namespace {

/// Maximum size of the table low_: table and result together fit the first-level cache.
constexpr std::size_t table_words = 2048;

/// Minimum number of words in an inner loop, so that vectors leave little or no remainder.
constexpr std::size_t run_words = 64;

/// Sets out[j] = low[j] xor high[j mod period], converted to [0, 1) if `out` holds doubles.
STIPPLE_WIDE void add_high(const std::uint64_t* low, const std::uint64_t* high, std::size_t period,
                           std::size_t words, double* out) {
    for (std::size_t base = 0; base < words; base += period)
        for (std::size_t j = 0; j < std::min(period, words - base); ++j)
            out[base + j] = fraction_to_unit(low[base + j] ^ high[j]);
}

STIPPLE_WIDE void add_high(const std::uint64_t* low, const std::uint64_t* high, std::size_t period,
                           std::size_t words, std::uint64_t* out) {
    for (std::size_t base = 0; base < words; base += period)
        for (std::size_t j = 0; j < std::min(period, words - base); ++j)
            out[base + j] = low[base + j] ^ high[j];
}

}  // namespace

BinaryMatrices in_gray_order(BinaryMatrices matrices) {
    // Digit j of i affects digits j and j - 1 of gray(i).
    auto& columns = matrices.columns;
    for (std::size_t at = columns.size(); at-- > matrices.dimension;)
        columns[at] ^= columns[at - matrices.dimension];
    return matrices;
}

BinaryNet::BinaryNet(const BinaryMatrices& matrices, std::vector<std::uint64_t> shift)
    : dimension_(matrices.dimension), shift_(std::move(shift)) {
    const std::size_t d = dimension_;
    const auto& columns = matrices.columns;
    shift_.resize(d);
    const std::size_t rows = std::bit_floor(std::max<std::size_t>(4, table_words / d));
    low_digits_ = static_cast<int>(
        std::min<std::size_t>(static_cast<std::size_t>(std::countr_zero(rows)), matrices.digits()));
    while (period_ * d < run_words) period_ *= 2;

    low_.resize(d << low_digits_);
    for (std::size_t i = 1; i < std::size_t{1} << low_digits_; ++i) {
        const std::size_t rest = i & (i - 1);
        const auto digit = static_cast<std::size_t>(std::countr_zero(i));
        for (std::size_t k = 0; k < d; ++k)
            low_[i * d + k] = low_[rest * d + k] ^ columns[digit * d + k];
    }
    carries_.assign(columns.begin() + static_cast<std::ptrdiff_t>(d) * low_digits_, columns.end());
    for (std::size_t at = d; at < carries_.size(); ++at) carries_[at] ^= carries_[at - d];
}

template <class Number>
void BinaryNet::fill_rows(std::uint64_t first, std::span<Number> rows) const {
    const std::size_t d = dimension_;
    const std::uint64_t mask = (std::uint64_t{1} << low_digits_) - 1;
    std::vector<std::uint64_t> high(period_ * d);
    std::ranges::copy(shift_, high.begin());

    // If h ends in j ones, the step from high digits h to h + 1 adds row j of carries_. So the sum
    // for h consists of the rows j at which the Gray code of h has a 1.
    std::uint64_t h = first >> low_digits_;
    for (std::uint64_t gray = h ^ (h >> 1); gray != 0; gray &= gray - 1) {
        const std::uint64_t* step = carry(std::countr_zero(gray));
        assert(step < carries_.data() + carries_.size());
        for (std::size_t k = 0; k < d; ++k) high[k] ^= step[k];
    }
    for (std::size_t done = 0; done < rows.size(); ++h) {
        for (std::size_t at = d; at < high.size(); ++at) high[at] = high[at - d];
        const std::size_t row = (first + done / d) & mask;
        const std::size_t words = std::min(rows.size() - done, (mask + 1 - row) * d);
        add_high(low_.data() + row * d, high.data(), high.size(), words, rows.data() + done);
        done += words;
        if (done == rows.size()) return;
        const std::uint64_t* step = carry(std::countr_one(h));
        for (std::size_t k = 0; k < d; ++k) high[k] ^= step[k];
    }
}

void BinaryNet::fill(std::uint64_t first, std::span<double> rows) const {
    if (rows.size() != dimension_) return fill_rows(first, rows);
    for (std::size_t k = 0; k < dimension_; ++k) rows[k] = fraction_to_unit(word(first, k));
}
void BinaryNet::fill(std::uint64_t first, std::span<std::uint64_t> rows) const {
    fill_rows(first, rows);
}

}  // namespace stipple
