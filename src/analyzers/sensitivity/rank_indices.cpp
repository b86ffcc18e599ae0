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

/// Sums over neighbors in the order of an input.
struct Window {
    double size = 0;
    double mean = 0;
    double squares = 0;
    double variance = 0;  ///< of one run, unbiased
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
        window.size = static_cast<double>(last - first);
        window.mean = total / window.size;
        window.variance = (window.squares - total * window.mean) / (window.size - 1);
        windows.push_back(window);
    }
    return windows;
}

/// The part of sum n_g mean_g^2 that is chance: as of independent runs, or as the second differences
/// of the means show, if that is less.
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

Index index_of(std::span<const Ordered> runs, double variance, double level) {
    const auto least = static_cast<std::size_t>(std::sqrt(static_cast<double>(runs.size())));
    const auto windows = windows_of(runs, least);
    const auto count = static_cast<double>(windows.size());
    const double whole = variance * static_cast<double>(runs.size());
    const double chance = chance_of(windows);
    double sum = 0;
    for (const Window& window : windows) sum += window.size * window.mean * window.mean;
    const double index = (sum - chance) / whole;
    double squares = 0;
    double before = 0;
    double of_none = 0;
    const double mean_size = static_cast<double>(runs.size()) / count;
    for (const Window& window : windows) {
        const double w =
            window.size * window.mean * window.mean - chance / count - index * window.squares;
        squares += w * w - (1 - 1 / mean_size) * w * before;
        before = w;
        of_none += 2 * window.size / (window.size - 1) * window.variance * window.variance;
    }
    return normal_interval(index, std::sqrt(std::max(squares, of_none)) / whole, level);
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
