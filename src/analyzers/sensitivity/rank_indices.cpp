// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/rank_indices.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// A run of the model, sorted by one input: its value x and the centred output z.
struct Ordered {
    double x;
    double z;
};

/// Neighbors in the order of an input, x.
struct Window {
    double size = 0;
    double mean = 0;
    double variance = 0;  ///< unbiased variance of a single run
    bool constant;        ///< whether x is constant
};

/// Windows of about equal sizes, of at least `least` and two runs, that do not separate equal
/// inputs.
std::vector<Window> windows_of(std::span<const Ordered> runs, std::size_t least) {
    std::vector<Window> windows;
    for (std::size_t first = 0, last = 0; first < runs.size(); first = last) {
        const std::size_t rest = runs.size() - first;
        const std::size_t count = std::max<std::size_t>(rest / least, 1);
        const std::size_t size = (rest + count - 1) / count;
        double total = 0;
        double squares = 0;
        const auto goes_on = [&] {
            const bool few = last - first < size || runs.size() - last < least;
            return last < runs.size() && (few || runs[last].x == runs[last - 1].x);
        };
        for (; goes_on(); ++last) {
            total += runs[last].z;
            squares += runs[last].z * runs[last].z;
        }
        Window window{.size = static_cast<double>(last - first),
                      .constant = runs[first].x == runs[last - 1].x};
        window.mean = total / window.size;
        window.variance = std::max(squares - total * window.mean, 0.0) / (window.size - 1);
        windows.push_back(window);
    }
    return windows;
}

/// Random part of sum n_g mean_g^2: that of independent runs or, if it is less, the one estimated
/// from the second differences of the means.
double chance_of(std::span<const Window> windows) {
    double independent = 0;
    for (const Window& window : windows) independent += window.variance;
    if (windows.size() < 3) return independent;
    double seen = 0;
    for (std::size_t g = 1; g + 1 < windows.size(); ++g) {
        const double bend = windows[g - 1].mean - 2 * windows[g].mean + windows[g + 1].mean;
        seen += windows[g].size * bend * bend / 6;
    }
    const auto all = static_cast<double>(windows.size());
    return std::min(independent, seen * all / (all - 2));
}

/// Loss of sum n_g mean_g^2 if windows had twice the size, summed over both ways to join neighbors.
/// Pairs of windows in which the input is constant are skipped, since they hide nothing.
double hidden_in(std::span<const Window> windows) {
    double sum = 0;
    for (std::size_t g = 1; g < windows.size(); ++g) {
        const Window& a = windows[g - 1];
        const Window& b = windows[g];
        if (a.constant && b.constant) continue;
        const double step = b.mean - a.mean;
        sum += (a.size * b.size * step * step - a.variance * b.size - b.variance * a.size) /
               (a.size + b.size);
    }
    return std::max(sum, 0.0);
}

/// Variance of sum n_g mean_g^2 - S sum z^2.
double variance_of(std::span<const Window> windows, std::span<const Ordered> runs, double index) {
    double of_none = 0;
    double sum = 0;
    double squares = 0;
    std::size_t at = 0;
    for (const Window& window : windows) {
        const double mean_square = window.mean * window.mean - window.variance / window.size;
        of_none += 2 * window.size / (window.size - 1) * window.variance * window.variance;
        for (const std::size_t last = at + static_cast<std::size_t>(window.size); at < last; ++at) {
            const double z = runs[at].z;
            const double others = (window.mean * window.size - z) / (window.size - 1);
            const double term = 2 * z * others - mean_square - index * z * z;
            sum += term;
            squares += term * term;
        }
    }
    const auto n = static_cast<double>(runs.size());
    return std::max(squares - sum * sum / n, 0.0) * n / (n - 1) + of_none;
}

Index index_of(std::span<const Ordered> runs, double variance, double level) {
    const auto least = static_cast<std::size_t>(std::sqrt(static_cast<double>(runs.size())));
    const auto windows = windows_of(runs, least);
    const double whole = variance * static_cast<double>(runs.size());
    double sum = 0;
    for (const Window& window : windows) sum += window.size * window.mean * window.mean;
    Index index{.value = (sum - chance_of(windows)) / whole};
    if (runs.size() < least_for_intervals) return index;
    const double reach = interval_quantile(level, std::max(windows.size(), least) - 1) *
                         std::sqrt(variance_of(windows, runs, index.value)) / whole;
    index.low = index.value - reach;
    index.high = index.value + reach + hidden_in(windows) / whole;
    return index;
}

}  // namespace

Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run) {
    const auto runs = succeeded(response.y);
    constexpr std::size_t least = 4;
    if (runs.size() < least)
        fail(ErrorKind::input, "the output {} has {} successful runs; rank indices need {}",
             response.name, runs.size(), least);
    const std::size_t k = inputs.size();
    run.need_memory(24.0 * static_cast<double>(runs.size()) * run.thread_count(),
                    "the rank indices");
    const Centred f = centred(picked(response.y, runs));
    const double variance = f.variance();
    Effects effects{
        .used = runs.size(),
        .samples = runs.size(),
        .mean = f.mean,
        .variance = variance * f.unit * f.unit,
        .kinds = {{"first", std::vector<Index>(k)}},
        .no_intervals = too_few_for_intervals(runs.size(), least_for_intervals, "runs")};
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
