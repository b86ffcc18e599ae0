// SPDX-License-Identifier: MIT
//
// The mean of reports, in constant memory.
//
//     mean_k = mean_{k-1} + (x_k - mean_{k-1}) / k,
//     error = sqrt(sum of squared deviations / (k (k - 1)))
//
// Numbers, curves and grids are averaged; a word or a flag stays where all reports agree on it;
// what they disagree on (or lists of different lengths) is left out. Whether the mean meets what
// was expected, the analyzer's `refine` decides.
//
// Source  B. P. Welford, Technometrics 4 (1962) 419-420, doi:10.1080/00401706.1962.10490022.
#pragma once

#include <cstddef>

#include "stipple/report.hpp"

namespace stipple {

class ReportAverage {
  public:
    void add(const Report& report);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const Report& mean() const { return mean_; }

    /// The standard errors, under the same names, of what `mean` has: an analyzer may take out of it
    /// what has no mean; nor have exact values, chances and errors one, nor what follows from the
    /// mean and scatters in its own way, such as an anisotropy. Empty for fewer than two reports.
    [[nodiscard]] Report standard_error(const Report& mean) const;

  private:
    std::size_t count_ = 0;
    Report mean_;
    Report squares_;  ///< sums of squared deviations from the mean
};

/// A report's numbers, without words, flags, curves and grids.
Report numbers_only(const Report& report);

}  // namespace stipple
