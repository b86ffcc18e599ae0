// SPDX-License-Identifier: MIT
//
// Correlated multi-jittered points in the plane (Kensler): multi-jittered points with the same
// order in all columns, and the same in all rows, so that they are spread more evenly. With m
// columns, r = ceil(n / m) rows, and random permutations sigma of the columns and tau of the rows,
// point s is at
//
//     x = (sigma(s mod m) + (tau(floor(s / m)) + u) / r) / m,        y = (s + v) / n,
//
// u and v uniform in [0, 1).
//
// m is that of --shape, or the largest divisor of n in [sqrt(n / 2), sqrt(n)]. If there is none, m
// is floor(sqrt(n)), and the last row is not full.
//
// Cost    O(n); point i is found without the others.
// Promise exactly n points, one in each of n strips along y. For n = m r also one in each of n
//         strips along x and in each of the m x r cells; for other n at most one in each of the
//         m r strips along x, and one in each cell of the full rows.
// Source  A. Kensler, "Correlated multi-jittered sampling", Pixar Technical Memo 13-01 (2013).

#include <algorithm>

#include "generators/stratified/stratified.hpp"
#include "math/combinatorics/permutation.hpp"

namespace stipple::generators::correlated_multi_jittered {
namespace {

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const std::uint64_t columns = jitter_columns(plan.count, options);
    const std::uint64_t rows = (plan.count + columns - 1) / columns;
    const PermutationFamily sigma(columns, 1, stratified_numbers(plan, 0));
    const PermutationFamily tau(rows, 1, stratified_numbers(plan, 1));
    return stratified_sequence(
        plan, style_of(options),
        [=, n = plan.count](std::size_t coordinate, std::span<const double> index,
                            std::span<double> low) {
            if (coordinate == 1) {
                std::ranges::copy(index, low.begin());
                return n;
            }
            for (std::size_t j = 0; j < index.size(); ++j) {
                const auto s = static_cast<std::uint64_t>(index[j]);
                low[j] = static_cast<double>(sigma(0, s % columns) * rows + tau(0, s / columns));
            }
            return columns * rows;
        });
}

}  // namespace

Generator unit() {
    return {.name = "correlated-multi-jittered",
            .summary = "Correlated multi-jittered points: more even than multi-jittered",
            .source = "Kensler 2013, Pixar Technical Memo 13-01",
            .traits = {.min_dimension = 2,
                       .max_dimension = 2,
                       .prefix = false,
                       .max_index = std::uint64_t{1} << 52},
            .options = Schema(shape_option, centered_option, order_option),
            .aliases = {"cmj"},
            .plan = plan_jitter_grid,
            .sequence = make,
            .constants = column_constant};
}

}  // namespace stipple::generators::correlated_multi_jittered
