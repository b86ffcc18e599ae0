// SPDX-License-Identifier: MIT
//
// Tables for LaTeX, with the rules of booktabs and no other package.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/document.hpp"

namespace stipple {

/// First line of a file of tables.
inline constexpr const char* latex_packages = "% needs \\usepackage{booktabs}\n";

/// Text in which LaTeX's special characters are escaped.
std::string latex_text(std::string_view text);

/// A number in mathematical mode, with four digits unless it is whole. A known half-width of its
/// interval is added, with two digits: $0.0430 \pm 0.0021$. NaN becomes a dash.
std::string latex_number(double value, double half_width);

struct LatexTable {
    std::vector<std::string> comments = {};  ///< lines above the table, as plain text
    std::vector<std::string> head = {};      ///< heads of the columns; LaTeX code, as are the rows
    std::vector<std::vector<std::string>> rows = {};
    std::size_t words = 0;  ///< number of columns at the left that hold words

    /// A tabular environment.
    [[nodiscard]] std::string text() const;
};

/// A table for each analyzer, with a row for each measurement, and a column for each number and
/// each entry of short lists. Analyzers with more than 6 such columns have tables with a row for
/// each group of numbers, such as an input of a sensitivity analysis, and each entry of lists.
/// Means show their standard errors; numbers with an interval show its ends.
std::string to_latex(std::span<const Measurement> measurements);

}  // namespace stipple
