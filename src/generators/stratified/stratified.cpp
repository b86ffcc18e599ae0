// SPDX-License-Identifier: MIT
#include "generators/stratified/stratified.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "math/combinatorics/permutation.hpp"
#include "math/digital/stratum.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators {
namespace {

/// Streams of random numbers under a generator's seed.
enum class StratifiedStream : std::uint64_t {
    order,
    first_of_unit,
    first_of_offsets = std::uint64_t{1} << 31  ///< one stream per coordinate
};

// A block of points has `block_numbers` coordinates, so that it fits into the cache, but at least
// `least_block` points, so that the fixed work per block and coordinate pays off.
constexpr std::size_t block_numbers = 4096;
constexpr std::size_t least_block = 256;

// Number of coordinates written to the rows at a time: a cache line.
constexpr std::size_t together = 8;

Rng numbers_of(const Plan& plan, StratifiedStream first, std::uint64_t stream) {
    return Rng(plan.seed, static_cast<std::uint64_t>(first) + stream);
}

/// Puts coordinates of points first, first + 1, ... into their strata.
void place(const Strata& strata, const Plan& plan, bool centered, std::size_t coordinate,
           std::uint64_t first, std::span<double> x) {
    if (centered) return place_in_middles(strata, x.data(), 1);
    numbers_of(plan, StratifiedStream::first_of_offsets, coordinate).fill(first, x);
    place_in_strata(strata, x.data(), 1);
}

void fill(const Plan& plan, bool centered, const std::optional<Permutation>& order,
          const StrataOf& strata, std::uint64_t first, std::span<double> rows) {
    const std::size_t d = plan.dimension;
    const std::size_t block = std::max(least_block, block_numbers / d);
    std::vector<double> index(std::min(block, rows.size() / d));
    std::vector<double> low(index.size());
    std::vector<double> columns(index.size() * std::min(d, together));
    for (; !rows.empty(); rows = rows.subspan(index.size() * d)) {
        index.resize(std::min(index.size(), rows.size() / d));
        low.resize(index.size());
        if (order)
            order->fill(first, index);
        else
            std::iota(index.begin(), index.end(), static_cast<double>(first));
        for (std::size_t k = 0; k < d; k += together) {
            const std::size_t width = std::min(together, d - k);
            for (std::size_t c = 0; c < width; ++c) {
                const auto x = std::span(columns).subspan(c * index.size(), index.size());
                const std::uint64_t parts = strata(k + c, index, low);
                place({.low = low, .parts = parts}, plan, centered, k + c, first, x);
            }
            for (std::size_t j = 0; j < index.size(); ++j)
                for (std::size_t c = 0; c < width; ++c)
                    rows[j * d + k + c] = columns[c * index.size() + j];
        }
        first += index.size();
    }
}

}  // namespace

Rng stratified_numbers(const Plan& plan, std::uint64_t stream) {
    return numbers_of(plan, StratifiedStream::first_of_unit, stream);
}

double place_in_stratum(const Plan& plan, bool centered, std::size_t coordinate,
                        std::uint64_t index, double stratum, std::uint64_t parts) {
    double x = 0;
    place({.low = {&stratum, 1}, .parts = parts}, plan, centered, coordinate, index, {&x, 1});
    return x;
}

std::unique_ptr<Sequence> stratified_sequence(const Plan& plan, const StratifiedStyle& style,
                                              StrataOf strata) {
    std::optional<Permutation> order;
    if (style.shuffled)
        order.emplace(plan.count, numbers_of(plan, StratifiedStream::order, 0).bits(0));
    return sequence_of(
        [=, strata = std::move(strata)](std::uint64_t first, std::span<double> rows) {
            fill(plan, style.centered, order, strata, first, rows);
        });
}

std::uint64_t jitter_columns(std::uint64_t count, const Values& options) {
    if (options.given(shape_option)) return static_cast<std::uint64_t>(options[shape_option][0]);
    const std::uint64_t root = floor_root(count, 2);
    for (std::uint64_t a = root; a * a >= count - a * a; --a)
        if (count % a == 0) return a;
    return root;
}

std::vector<Constants> column_constant(const Plan& plan, const Values& options, const RunContext&) {
    const std::uint64_t columns = jitter_columns(plan.count, options);
    std::vector<Constants> found = {{"columns", {columns}, true}};
    if (plan.count % columns > 0) found.push_back({"rest", {plan.count % columns}, true});
    return found;
}

Plan plan_of_shape(const Request& request, const std::vector<std::int64_t>& sides,
                   std::string_view cells) {
    const std::string text = format_value(Value(sides));
    std::uint64_t count = 1;
    for (const std::int64_t k : sides)
        if (__builtin_mul_overflow(count, static_cast<std::uint64_t>(k), &count))
            fail(ErrorKind::usage, "--shape: {} has more than 2^64 {}", text, cells);
    if (request.count.value_or(count) != count)
        fail(ErrorKind::usage, "--count: {} contradicts --shape {}, which has {} {}",
             *request.count, text, count, cells);
    if (request.dimension.value_or(sides.size()) != sides.size())
        fail(ErrorKind::usage, "--dimension: {} contradicts --shape {}, which has {} directions",
             *request.dimension, text, sides.size());
    return default_plan(request, count, sides.size());
}

std::vector<std::uint64_t> sides_of(const Plan& plan, const std::vector<std::int64_t>& shape,
                                    const std::string& who) {
    if (shape.empty())
        return std::vector(plan.dimension, exact_root(plan.count, plan.dimension, who));
    return {shape.begin(), shape.end()};
}

Plan plan_jitter_grid(const Request& request, const Values& options) {
    if (!options.given(shape_option)) return default_plan(request);
    const auto sides = options[shape_option];
    if (sides.size() != 2)
        fail(ErrorKind::usage, "--shape: {} has {} sides; expected two, columns x rows",
             format_value(Value(sides)), sides.size());
    return plan_of_shape(request, sides, "cells");
}

}  // namespace stipple::generators
