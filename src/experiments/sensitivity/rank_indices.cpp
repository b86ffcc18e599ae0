// SPDX-License-Identifier: MIT
//
// First-order indices by ranks, from any sample of independent inputs. The runs are sorted by input
// i and divided into windows of neighbors, whose x_i are nearly the same. With z the centred
// output, V its variance, and n_g runs of mean z_g and variance s_g^2 in window g,
//
//     S_i = (sum n_g z_g^2 - chance) / (n V).
//
// For independent runs chance is sum s_g^2, and S_i is the mean of the products of different runs
// of a window. On low-discrepancy points the means z_g have smaller errors, so that chance is
// estimated from their second differences, W / (W - 2) sum n_g (z_(g-1) - 2 z_g + z_(g+1))^2 / 6
// for W windows, if this estimate is smaller. A window has sqrt(n) runs or more and ends where x_i
// changes, so that runs of equal x_i stay together, and their order does not matter.
//
// Windows of two runs would nearly give the statistic of Chatterjee, and of Gamboa et al., whose
// errors are a fifth and more on low-discrepancy points: neighbors in one coordinate are related in
// the others.
//
// The interval extends by Student's quantile times the standard error se to both sides, with max(W,
// sqrt(n)) - 1 degrees of freedom. With m_j the mean of the other runs in the window of run j,
//
//     (n V se)^2 = n var(2 z_j m_j - z_g^2 - S_i z_j^2) + sum 2 n_g / (n_g - 1) s_g^4,
//
// where s_g^2 / n_g, due to chance, is subtracted from z_g^2. The first term is the influence of
// run j on the index; the second is due to pairs of runs. The upper end is extended by the variance
// of E(f | x_i) that windows may hide. It is estimated by the loss with windows of twice the size,
//
//     sum_g (n_g n_(g+1) (z_g - z_(g+1))^2 - n_(g+1) s_g^2 - n_g s_(g+1)^2)
//         / (n_g + n_(g+1)) / (n V),
//
// summed over both ways to join neighbors. Two windows hide nothing if x_i is constant in both.
// Intervals at the level of 95 % contain the index in at least 90 % of samples, for n from 20 to
// 1000, on the functions of tests/oracles/sensitivity.py.
//
// Shape   four runs or more, twenty for intervals.
// Cost    O(k n log n).
// Beware  indices are too small by the fraction of the variance that E(f | x_i) has within windows,
//         O(1/n); for independent runs they are too large by (1 - S_i) 0.8 n^(-3/4), since the
//         smaller estimate of chance is used. Intervals are too short for outputs with rare huge
//         values, if these do not occur in the runs. Runs of structured designs share coordinates,
//         which adds effects of other inputs. The bootstrap is useless here: a resample contains
//         runs twice, as neighbors of themselves.
// Source  E. Plischke, E. Borgonovo, C. L. Smith, Eur. J. Oper. Res. 226 (2013) 536-550,
//         doi:10.1016/j.ejor.2012.11.047 (windows); F. Gamboa, P. Gremaud, T. Klein, A. Lagnoux,
//         Bernoulli 28 (2022) 2345-2374, doi:10.3150/21-BEJ1421 (neighbors); Z. Lin, F. Han,
//         Biometrika 110 (2023) 283-299, doi:10.1093/biomet/asac048 (several neighbors).
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "experiments/sensitivity/methods.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// A run: value of the input x and centred output z.
struct Ordered {
    double x;
    double z;
};

struct Window {
    double size = 0;
    double mean = 0;
    double variance = 0;  ///< unbiased variance of the outputs
    bool constant;        ///< whether x is constant in the window
};

/// Divides runs into windows of similar sizes, of `least` runs or more; runs with equal inputs are
/// in the same window.
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

/// `chance` in the formula of S_i: the smaller one of its two estimates.
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

/// Loss of sum n_g z_g^2 if neighboring windows were joined, summed over both ways; at least 0.
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

/// Variance of sum n_g z_g^2 - S sum z^2, where S is the index.
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
        .variance = held(variance * f.unit * f.unit),
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
