// SPDX-License-Identifier: MIT
#include "generators/optimized/lattice_search.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "generators/optimized/starts.hpp"

namespace stipple::optimized {
namespace {

std::vector<double> korobov_rows(std::size_t count, std::size_t dimension, std::size_t g) {
    std::vector<std::size_t> vector(dimension, 1 % count);
    for (std::size_t j = 1; j < dimension; ++j) vector[j] = vector[j - 1] * g % count;
    return rank1_rows(count, vector, std::vector<double>(dimension));
}

}  // namespace

OptimizedRows least_lattice(std::size_t count, std::size_t dimension,
                            const std::function<std::unique_ptr<Objective>()>& objective,
                            const std::string& words, const RunContext& run) {
    constexpr std::size_t together = 16;
    const RunContext inner = silent(run);
    const std::size_t last = count / 2 + 1;
    OptimizedRows best{{}, std::numeric_limits<double>::infinity()};
    const auto named = objective();
    const auto look_at_some = [&](std::size_t first) {
        std::vector<OptimizedRows> found(std::min(together, last + 1 - first));
        for_each_block(inner, found.size(), 1, [&](const Block& block) {
            OptimizedRows& one = found[block.index];
            one = {korobov_rows(count, dimension, first + block.index), 0};
            std::vector<double> gradient(one.rows.size());
            const auto measure = objective();
            one.value = measure->value(one.rows, 1e3, gradient, inner);
            if (one.value < best.value)
                one.value = measure->certain_value(one.rows, one.value, inner);
        });
        const double value = std::ranges::min_element(found, {}, &OptimizedRows::value)->value;
        for (OptimizedRows& one : found)
            if (one.value < best.value) best = std::move(one);
        report_search(run,
                      static_cast<double>(first + found.size()) / static_cast<double>(last + 1),
                      words, named->reported(value), named->reported(best.value));
    };
    unless_best_is_wanted(run, [&] {
        for (std::size_t first = 1; first <= last; first += together) {
            run.check_stop();
            look_at_some(first);
        }
    });
    if (best.rows.empty()) run.check_stop();
    best.stopped = run.best_is_wanted();
    return best;
}

}  // namespace stipple::optimized
