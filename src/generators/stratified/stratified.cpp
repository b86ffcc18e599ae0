// SPDX-License-Identifier: MIT
#include "generators/stratified/stratified.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "math/digital/stratum.hpp"

namespace stipple::generators {
namespace {

// A block of points stays in the cache, and is long enough for what is made once a block and
// coordinate.
constexpr std::size_t block_numbers = 4096;
constexpr std::size_t least_block = 256;

// Coordinates that are written to the rows together: a cache line of them.
constexpr std::size_t together = 8;

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
    const std::size_t block = std::max(least_block, block_numbers / d);
    std::vector<double> index(std::min(block, rows.size() / d));
    std::vector<double> low(index.size());
    std::vector<double> columns(index.size() * std::min(d, together));
    for (; !rows.empty(); rows = rows.subspan(index.size() * d)) {
        index.resize(std::min(index.size(), rows.size() / d));
        low.resize(index.size());
        if (order_)
            order_->fill(first, index);
        else
            std::iota(index.begin(), index.end(), static_cast<double>(first));
        for (std::size_t k = 0; k < d; k += together) {
            const std::size_t width = std::min(together, d - k);
            for (std::size_t c = 0; c < width; ++c) {
                const auto x = std::span(columns).subspan(c * index.size(), index.size());
                strata(k + c, index, low);
                place(k + c, first, low, x);
            }
            for (std::size_t j = 0; j < index.size(); ++j)
                for (std::size_t c = 0; c < width; ++c)
                    rows[j * d + k + c] = columns[c * index.size() + j];
        }
        first += index.size();
    }
}

void StratifiedSequence::place(std::size_t coordinate, std::uint64_t first,
                               std::span<const double> low, std::span<double> x) const {
    if (centered_) return place_in_middles({.low = low, .parts = parts(coordinate)}, x.data(), 1);
    const Rng offsets(plan_.seed,
                      static_cast<std::uint64_t>(StratifiedStream::first_of_offsets) + coordinate);
    offsets.fill(first, x);
    place_in_strata({.low = low, .parts = parts(coordinate)}, x.data(), 1);
}

}  // namespace stipple::generators
