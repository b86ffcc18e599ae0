// SPDX-License-Identifier: MIT
//
// Mean of reports, in constant memory.
//
//     mean_k = mean_{k-1} + (x_k - mean_{k-1}) / k,
//     error = sqrt(sum of squared deviations / (k (k - 1)))
//
// Numbers, curves and grids are averaged. Texts and flags are kept if all reports agree; if not,
// and for lists of different lengths, the entry is omitted. The analyzer's `refine` decides whether
// the mean meets expectations.
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

    /// Standard errors of the entries of `mean`, under the same names; `mean` is the result of
    /// mean(), perhaps without entries that the analyzer removed. Omits entries without a
    /// meaningful error: exact values, probabilities, errors, and results derived from the mean,
    /// such as an anisotropy. Empty for fewer than two reports.
    [[nodiscard]] Report standard_error(const Report& mean) const;

  private:
    std::size_t count_ = 0;
    Report mean_;
    Report squares_;  ///< sums of squared deviations from the mean
};

/// A report's single numbers, without texts, flags, curves and grids.
Report numbers_only(const Report& report);

}  // namespace stipple
