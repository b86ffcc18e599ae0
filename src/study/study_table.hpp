// SPDX-License-Identifier: MIT
//
// The rows of a study: a tidy table, as CSV or as JSON objects a line.
//
// Promise  a row is one line. What it says but for the seconds, its last two cells, depends on the
//          study alone, and reads back to the same row.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/table_line.hpp"
#include "study/sweep.hpp"

namespace stipple {

/// One number of one measure of one set, or why there is none.
struct StudyRow {
    std::string generator = {};  ///< spec
    std::string generator_options = {};
    std::uint64_t dimension = 0;
    std::string warps = {};
    std::uint64_t count = 0;                   ///< points that were asked for
    std::optional<std::uint64_t> points = {};  ///< that were measured
    std::uint64_t seed = 0;
    std::string measure = {};  ///< spec
    std::string measure_options = {};
    std::string domain = {};  ///< that the measured points are on
    std::string key = {};     ///< of the result
    std::optional<double> value = {};
    std::string status = "ok";  ///< or failed
    std::string reason = {};    ///< of a failure
    std::string study = {};     ///< fingerprint
    std::optional<double> generate_seconds = {};
    std::optional<double> seconds = {};

    [[nodiscard]] bool failed() const { return status != "ok"; }
};

/// What a unit of the sweep says in all its rows.
StudyRow row_of(const Sweep& sweep, const Unit& unit);

/// Whether a row is one that the unit has.
bool belongs(const StudyRow& row, const StudyRow& unit);

/// How the rows of a file are written.
class StudyTable {
  public:
    StudyTable(TableStyle style, bool seconds);

    [[nodiscard]] TableStyle style() const { return style_; }

    /// What stands on top: the line of names in CSV, nothing in JSONL.
    [[nodiscard]] std::string head() const;

    /// The line of a row, with its end.
    [[nodiscard]] std::string line(const StudyRow& row) const;

    /// The row of a line without its end; nothing where it is no whole row.
    [[nodiscard]] std::optional<StudyRow> parse(std::string_view line) const;

    /// Whether a file with this first line is a study's, of this style.
    [[nodiscard]] bool is_head(std::string_view line) const;

  private:
    TableStyle style_;
    bool seconds_;
    std::vector<TableCell> columns_;  ///< names alone
};

}  // namespace stipple
