// SPDX-License-Identifier: MIT
//
// Bootstrap intervals of statistics of means: rows are drawn with replacement, as many as there
// are, and the statistics are computed from the means over the drawn rows.
//
// The interval's ends are quantiles of the resampled statistics, at the levels Phi(-+ sqrt(n / (n -
// 1)) t_(n-1)) that make it Student's interval for n rows instead of the normal one. Their
// distances from the statistic are stretched by 1 + caution / n, for two effects that resamples do
// not show: a few rows may hide the skewness of the terms, and rows of a low-discrepancy base may
// be alike in some coordinates, so that their effective number is smaller.
//
// Cost    resamples x rows x terms additions; 0.4 s for 1000 x 2^14 x 24 on one core.
// Promise the same for any number of threads: resample b depends only on the seed and b.
// Source  B. Efron, R. J. Tibshirani, "An Introduction to the Bootstrap", Chapman & Hall 1993,
//         chapter 13 (percentile intervals); T. C. Hesterberg, Amer. Statist. 69 (2015) 371-386,
//         doi:10.1080/00031305.2015.1089789 (expanded percentiles). Caution: measured, see
//         tests/oracles/sensitivity.py.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Table with one row of terms per sample.
struct TermTable {
    std::vector<double> terms;
    std::size_t width;

    [[nodiscard]] std::size_t rows() const { return terms.size() / width; }
};

/// Computes statistics from the means of the terms.
using Statistics = std::function<void(std::span<const double> means, std::span<double> values)>;

inline constexpr std::size_t least_rows = 10;  ///< fewer rows of terms give no intervals

/// Returns the first `count` statistics, computed from all rows, with their bootstrap intervals.
std::vector<Index> bootstrapped(const TermTable& table, std::size_t count,
                                const Statistics& statistics, double caution,
                                const Setting& setting, const RunContext& run);

/// Returns the `count` elements of `all` that begin at `first`.
inline std::vector<Index> part_of(std::span<const Index> all, std::size_t first,
                                  std::size_t count) {
    const auto part = all.subspan(first, count);
    return {part.begin(), part.end()};
}

}  // namespace stipple::analyzers::sensitivity
