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

struct KeyedNumber {
    std::string key;
    double value = 0;
};

/// Outcome of one measure of one set: what its rows say beyond the unit itself.
struct UnitResult {
    std::vector<KeyedNumber> numbers = {};
    std::string domain = {};
    std::optional<std::uint64_t> points = {};
    double generate_seconds = 0;
    double seconds = 0;
    std::string failure = {};    ///< one line; empty: it went well
    bool out_of_memory = false;  ///< more than a worker's fraction is needed
};

/// Units that were measured one after the other.
struct Segment {
    UnitRange units;
    std::vector<UnitResult> results = {};  ///< of each unit
};

/// Columns that are the same in all rows of a unit.
StudyRow row_of(const Sweep& sweep, const Unit& unit);

/// A row for each number of the unit, or the one that says why there is none.
std::vector<StudyRow> rows_of(const Sweep& sweep, const Unit& unit, const UnitResult& result);

/// The unit that a row is of; nullopt if the sweep has none.
std::optional<std::uint64_t> unit_of(const Sweep& sweep, const StudyRow& row);

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
