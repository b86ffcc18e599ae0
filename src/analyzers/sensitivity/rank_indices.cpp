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

/// The mean over all orders of equal x of the sum of z_(j) z_(j+1), cyclic.
double neighbor_products(std::span<const Ordered> runs) {
    double sum = 0;
    double first_mean = 0;
    double last_mean = 0;  // of the group before
    for (std::size_t first = 0, last = 0; first < runs.size(); first = last) {
        double total = 0;
        double squares = 0;
        for (; last < runs.size() && runs[last].x == runs[first].x; ++last) {
            total += runs[last].z;
            squares += runs[last].z * runs[last].z;
        }
        const auto m = static_cast<double>(last - first);
        // Of its m (m - 1) ordered pairs m - 1 are neighbors; of a cycle of equal runs alone, m.
        if (m > 1) sum += (total * total - squares) / (last - first == runs.size() ? m - 1 : m);
        if (first == 0)
            first_mean = total / m;
        else
            sum += last_mean * (total / m);
        last_mean = total / m;
    }
    return runs.front().x == runs.back().x ? sum : sum + last_mean * first_mean;
}

/// The standard error of a sum of products over n, with index S.
double standard_error(std::span<const Ordered> runs, double index, double variance) {
    const std::size_t n = runs.size();
    std::vector<double> w(n);
    double mean = 0;
    for (std::size_t j = 0; j < n; ++j) {
        const double a = runs[j].z;
        const double b = runs[j + 1 < n ? j + 1 : 0].z;
        w[j] = a * b - index * (a * a + b * b) / 2;
        mean += w[j] / static_cast<double>(n);
    }
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
        const double next = w[(j + 1) % n] - w[(j + 2) % n];
        sum += (w[j] - mean) * (w[j] - mean) + 2 * w[j] * next;
    }
    return std::sqrt(std::max(sum, 0.0)) / static_cast<double>(n) / variance;
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
        const double index =
            neighbor_products(ordered) / static_cast<double>(runs.size()) / variance;
        effects.kinds[0].of[i] =
            normal_interval(index, standard_error(ordered, index, variance), setting.level);
    });
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
