// SPDX-License-Identifier: MIT
//
// Bootstrap intervals of statistics of means: rows are drawn with replacement, as many as there
// are, and the statistics are computed from the means over the drawn rows.
//
// The interval's ends are quantiles of the resampled statistics, at the levels Phi(-+ sqrt(n / (n -
// 1)) t_(n-1)) that make it Student's interval for n rows instead of the normal one. Their
// distances from the statistic are multiplied by 1 + caution / n for errors that resamples miss: a
// few rows may hide skewness, and rows of a low-discrepancy base may be alike in some coordinates.
//
// Shape   10 rows or more, and enough resamples that at least one lies beyond each end.
// Cost    resamples x rows x terms additions; 0.4 s for 1000 x 2^14 x 24 on one core.
// Promise the same for any number of threads: resample b depends only on the seed and b.
// Beware  resamples contain no effect that no row has shown; callers allow for such effects.
// Source  B. Efron, R. J. Tibshirani, "An Introduction to the Bootstrap", Chapman & Hall 1993,
//         chapter 13 (percentile intervals); T. C. Hesterberg, Amer. Statist. 69 (2015) 371-386,
//         doi:10.1080/00031305.2015.1089789 (expanded percentiles). Caution: measured, see
//         tests/oracles/sensitivity.py.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "experiments/sensitivity/methods.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Quantile at p of the finite values; NaN if there are none.
double quantile(std::vector<double>& values, double p) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (values.empty()) return none;
    const double at = p * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const auto low = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(values.begin(), low, values.end());
    if (low + 1 == values.end()) return *low;
    const double next = *std::min_element(low + 1, values.end());
    return *low + (at - static_cast<double>(below)) * (next - *low);
}

/// Means of the terms over one resample. Each uniform number selects a row.
void take_means(const TermTable& table, std::span<const double> uniform, std::span<double> means) {
    const auto rows = static_cast<double>(table.rows());
    std::ranges::fill(means, 0.0);
    for (const double u : uniform) {
        const auto row = std::min(static_cast<std::size_t>(u * rows), table.rows() - 1);
        const double* terms = table.terms.data() + row * table.width;
        for (std::size_t t = 0; t < means.size(); ++t) means[t] += terms[t];
    }
    for (double& mean : means) mean /= rows;
}

}  // namespace

std::string no_bootstrap(std::size_t rows, const char* of_what, const Setting& setting) {
    constexpr std::size_t least = 10;
    const double needed = std::ceil(2 / (1 - setting.level) * (1 - 1e-9)) - 1;
    const auto given = static_cast<double>(setting.bootstrap);
    if (rows < least || given == 0 || given >= needed)
        return too_few_for_intervals(rows, least, of_what);
    return fmt::format("{} resamples; intervals of the level {} need {}", setting.bootstrap,
                       setting.level, needed);
}

double unseen_chance(std::size_t rows, std::size_t shown, double level) {
    constexpr std::size_t enough = 5;
    return shown < enough ? logarithm(2 / (1 - level)) / static_cast<double>(rows) : 0;
}

std::vector<Index> bootstrapped(const TermTable& table, std::size_t count,
                                const Statistics& statistics, double caution,
                                const Setting& setting, const RunContext& run) {
    const std::size_t rows = table.rows();
    std::vector<double> means(table.width, 0.0);
    for (std::size_t i = 0; i < table.terms.size(); ++i) means[i % table.width] += table.terms[i];
    for (double& mean : means) mean /= static_cast<double>(rows);
    std::vector<double> values(count);
    statistics(means, values);

    const std::size_t resamples = no_bootstrap(rows, "", setting).empty() ? setting.bootstrap : 0;
    std::vector<double> resampled(resamples * count);
    constexpr std::size_t block = 4;
    for_each_block(run, resamples, block, [&](const Block& part) {
        std::vector<double> uniform(rows);
        std::vector<double> own(table.width);
        for (std::uint64_t b = part.first; b < part.last; ++b) {
            Rng(setting.seed, b).fill(0, uniform);
            take_means(table, uniform, own);
            statistics(own, std::span(resampled).subspan(b * count, count));
        }
    });

    std::vector<Index> indices(count);
    for (std::size_t v = 0; v < count; ++v) indices[v].value = values[v];
    if (resamples == 0) return indices;
    const auto n = static_cast<double>(rows);
    const double tail =
        normal_distribution(-std::sqrt(n / (n - 1)) * interval_quantile(setting.level, rows - 1));
    std::vector<double> column(resamples);
    for (std::size_t v = 0; v < count; ++v) {
        const auto end_at = [&](double p) {
            column.resize(resamples);
            for (std::size_t b = 0; b < resamples; ++b) column[b] = resampled[b * count + v];
            return values[v] + (quantile(column, p) - values[v]) * (1 + caution / n);
        };
        indices[v].low = end_at(tail);
        indices[v].high = end_at(1 - tail);
    }
    return indices;
}

}  // namespace stipple::analyzers::sensitivity
