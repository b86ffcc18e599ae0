// SPDX-License-Identifier: MIT
//
// Means of a study as a wide table: a row for each measure, key, dimension and count, and columns for
// each generator: its mean, and the half-width of its t interval. For errors (keys that end with
// error), these are the root mean square and half the width of its interval.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/table_line.hpp"
#include "study/study_summary.hpp"

namespace stipple {

/// The table as CSV or JSONL, with the columns GENERATOR and GENERATOR half_width.
std::string wide_table(std::span<const MeanRow> means, TableStyle style);

/// The table for LaTeX, with cells MEAN +- HALF_WIDTH, without columns that have the same value in all
/// rows. @param command that made it, for a comment
std::string wide_latex(std::span<const MeanRow> means, const std::string& command);

}  // namespace stipple
