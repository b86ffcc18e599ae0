// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/rank_indices.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// A run of the model as one input orders it.
struct Ordered {
    double x;
    double z;
};

/// Sums over a window: of products of different runs, over its size less 1; of squares; and what the
/// variance of the first is where all windows have the mean 0.
struct Window {
    double products = 0;
    double squares = 0;
    double null_variance = 0;
};

/// Windows of at least `least` runs, two or more, none of which parts equal inputs.
std::vector<Window> windows_of(std::span<const Ordered> runs, std::size_t least) {
    std::vector<Window> windows;
    for (std::size_t first = 0, last = 0; first < runs.size(); first = last) {
        double total = 0;
        Window window;
        const auto goes_on = [&] {
            const bool few = last - first < least || runs.size() - last < least;
            return last < runs.size() && (few || runs[last].x == runs[last - 1].x);
        };
        for (; goes_on(); ++last) {
            total += runs[last].z;
            window.squares += runs[last].z * runs[last].z;
        }
        const auto size = static_cast<double>(last - first);
        window.products = (total * total - window.squares) / (size - 1);
        const double variance = (window.squares - total * total / size) / (size - 1);
        window.null_variance = 2 * size / (size - 1) * variance * variance;
        windows.push_back(window);
    }
    return windows;
}

Index index_of(std::span<const Ordered> runs, double variance, double level) {
    const auto least = static_cast<std::size_t>(std::sqrt(static_cast<double>(runs.size())));
    const auto windows = windows_of(runs, least);
    const double whole = variance * static_cast<double>(runs.size());
    double sum = 0;
    for (const Window& window : windows) sum += window.products;
    const double index = sum / whole;
    double squares = 0;
    double before = 0;
    double null_variance = 0;
    const double mean_size = static_cast<double>(runs.size()) / static_cast<double>(windows.size());
    for (const Window& window : windows) {
        const double w = window.products - index * window.squares;
        squares += w * w - (1 - 1 / mean_size) * w * before;
        before = w;
        null_variance += window.null_variance;
    }
    return normal_interval(index, std::sqrt(std::max(squares, null_variance)) / whole, level);
}

}  // namespace

Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run) {
    const auto runs = succeeded(response.y);
    constexpr std::size_t least = 4;
    if (runs.size() < least)
        fail(ErrorKind::input, "the output {} has {} runs; ranks need {}", response.name,
             runs.size(), least);
    const std::size_t k = inputs.size();
    run.need_memory(24.0 * static_cast<double>(runs.size()) * run.thread_count(), "the ranks");
    const Centred f = centred(picked(response.y, runs), response.name);
    const double variance = f.variance();
    Effects effects{.used = runs.size(),
                    .samples = runs.size(),
                    .mean = f.mean,
                    .variance = variance * f.unit * f.unit,
                    .kinds = {{"first", std::vector<Index>(k)}}};
    for_each_block(run, k, 1, [&](const Block& block) {
        const std::size_t i = block.index;
        std::vector<Ordered> ordered(runs.size());
        for (std::size_t j = 0; j < runs.size(); ++j)
            ordered[j] = {inputs.values[runs[j]][i], f.z[j]};
        std::ranges::stable_sort(ordered, {}, &Ordered::x);
        effects.kinds[0].of[i] = index_of(ordered, variance, setting.level);
    });
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
