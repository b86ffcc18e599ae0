// SPDX-License-Identifier: MIT
//
// Detects rows that are neither an independent sample nor the design of a known method.
#include "experiments/sensitivity/methods.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Largest number of values to examine, which takes a second or less.
constexpr double most_work = 1e8;

struct Levels {
    std::size_t count = 0;  ///< number of distinct values
    double chance = 0;      ///< probability that two random rows have the same value
};

Levels levels_of(const PointSet& points, std::size_t j) {
    auto values = column_of(points, j);
    std::ranges::sort(values);
    Levels levels;
    for (auto first = values.begin(); first != values.end(); ++levels.count) {
        const auto last = std::upper_bound(first, values.end(), *first);
        const double share = static_cast<double>(last - first) / static_cast<double>(values.size());
        levels.chance += share * share;
        first = last;
    }
    return levels;
}

}  // namespace

double share_of_neighbors(const PointSet& points, const RunContext& run) {
    const std::size_t n = points.count();
    const std::size_t k = points.dimension();
    if (k < 2 || static_cast<double>(n) * static_cast<double>(k) > most_work / 30) return 0;
    std::vector<Levels> levels(k);
    double grid = 1;
    for (std::size_t j = 0; j < k; ++j) {
        levels[j] = levels_of(points, j);
        grid *= static_cast<double>(levels[j].count);
    }
    if (std::fmod(static_cast<double>(n), grid) == 0) return 0;
    double neighbors = 0;  // expected number of neighbors of a row, by chance
    for (std::size_t j = 0; j < k; ++j) {
        double equal = static_cast<double>(n - 1);
        for (std::size_t c = 0; c < k; ++c)
            if (c != j) equal *= levels[c].chance;
        neighbors += equal;
    }
    // Rows agree except in coordinate j if the sums of their codes, without that of j, are equal.
    const auto code = [&](std::size_t i, std::size_t j) {
        return SplitMix64(std::bit_cast<std::uint64_t>(points[i][j] + 0.0) + j).next();
    };
    std::vector<std::uint64_t> whole(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < k; ++j) whole[i] += code(i, j);
    std::vector<bool> found(n);
    for (std::size_t j = 0; j < k; ++j) {
        run.check_stop();
        std::vector<std::pair<std::uint64_t, std::size_t>> rows(n);
        for (std::size_t i = 0; i < n; ++i) rows[i] = {whole[i] - code(i, j), i};
        std::ranges::sort(rows);
        for (std::size_t r = 1; r < n; ++r) {
            const std::size_t a = rows[r - 1].second;
            const std::size_t b = rows[r].second;
            if (rows[r - 1].first == rows[r].first && points[a][j] != points[b][j])
                found[a] = found[b] = true;
        }
    }
    const double chance = -std::expm1(-neighbors);
    const double share =
        static_cast<double>(std::ranges::count(found, true)) / static_cast<double>(n);
    const double error = std::sqrt(chance * (1 - chance) / static_cast<double>(n));
    return share - chance > std::max(0.25, 4 * error) ? share : 0;
}

void note_dependence(const Inputs& in, const RunContext& run) {
    const std::size_t n = in.runs();
    const std::size_t k = in.size();
    const double pairs = static_cast<double>(k) * static_cast<double>(k - 1) / 2;
    if (k < 2 || std::max(pairs, 30.0) * static_cast<double>(n) > most_work) return;
    std::vector<std::vector<double>> ranks;  // minus their mean
    std::vector<double> squares;
    std::vector<std::size_t> levels;
    for (std::size_t j = 0; j < k; ++j) {
        auto& of_input = ranks.emplace_back(ranks_of(column_of(in.values, j)));
        for (double& rank : of_input) rank -= 0.5;
        squares.push_back(dot(of_input, of_input));
        levels.push_back(levels_of(in.values, j).count);
    }
    double largest = 0, correlation = 0;
    std::pair<std::size_t, std::size_t> at;
    for (std::size_t a = 0; a < k; ++a)
        for (std::size_t b = a + 1; b < k; ++b) {
            run.check_stop();
            if (!(squares[a] * squares[b] > 0)) continue;
            const double r = dot(ranks[a], ranks[b]) / std::sqrt(squares[a] * squares[b]);
            // Rows that repeat coordinates are not independent, so only distinct values count. But
            // if there are few values, they are levels, which repeat in independent rows, too.
            constexpr std::size_t few = 30;
            const std::size_t values = std::max(levels[a], levels[b]);
            const double size = std::sqrt(static_cast<double>(values < few ? n : values) - 1);
            if (std::abs(r) * size > largest) {
                largest = std::abs(r) * size;
                correlation = r;
                at = {a, b};
            }
        }
    // For independent inputs, the largest correlation exceeds this limit in one of 10^4 designs.
    if (largest <= std::sqrt(2 * std::log(1e4 * pairs))) return;
    run.notify(
        fmt::format("the inputs {} and {} depend on each other: their rank correlation is {:.2f}; "
                    "the indices assume independent inputs",
                    in.names[at.first], in.names[at.second], correlation));
}

}  // namespace stipple::analyzers::sensitivity
