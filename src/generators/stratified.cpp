// SPDX-License-Identifier: MIT
#include "generators/stratified.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "math/stratum.hpp"

namespace stipple::generators {
namespace {

// A block of points stays in the cache, and is long enough for what is made once a block and
// coordinate.
constexpr std::size_t block_numbers = 4096;
constexpr std::size_t least_block = 64;

}  // namespace

StratifiedSequence::StratifiedSequence(const Plan& plan, Style style)
    : plan_(plan), centered_(style.centered) {
    if (style.shuffled)
        order_.emplace(plan.count,
                       Rng(plan.seed, static_cast<std::uint64_t>(StratifiedStream::order)).bits(0));
}

Rng StratifiedSequence::numbers(std::uint64_t stream) const {
    return Rng(plan_.seed, static_cast<std::uint64_t>(StratifiedStream::first_of_unit) + stream);
}

void StratifiedSequence::fill(std::uint64_t first, std::span<double> rows) {
    const std::size_t d = plan_.dimension;
    const Rng offsets(plan_.seed, static_cast<std::uint64_t>(StratifiedStream::offsets));
    const std::size_t block = std::max(least_block, block_numbers / d);
    std::vector<double> index(std::min(block, rows.size() / d));
    std::vector<double> low(index.size());
    for (; !rows.empty(); rows = rows.subspan(index.size() * d)) {
        index.resize(std::min(index.size(), rows.size() / d));
        low.resize(index.size());
        if (order_)
            order_->fill(first, index);
        else
            std::iota(index.begin(), index.end(), static_cast<double>(first));
        if (!centered_) offsets.fill(first * d, rows.first(index.size() * d));
        for (std::size_t k = 0; k < d; ++k) {
            strata(k, index, low);
            centered_ ? place_in_middles(low, parts(k), rows.data() + k, d)
                      : place_in_strata(low, parts(k), rows.data() + k, d);
        }
        first += index.size();
    }
}

}  // namespace stipple::generators
