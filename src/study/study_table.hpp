// SPDX-License-Identifier: MIT
//
// Rows of a study: a tidy table, as CSV or with a JSON object per line.
//
// Promise  a row is one line and reads back to the same row. It depends on the study alone, except
//          its last two cells, the seconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/table_line.hpp"
#include "study/sweep.hpp"

namespace stipple {

// The text of a failure begins with one of these if a limit or a file was the reason.
inline constexpr std::string_view lack_of_memory = "limit: ";
inline constexpr std::string_view lack_of_file = "file: ";

/// One number of one measure of one set, or the reason why it is missing.
struct StudyRow {
    std::string generator = {};  ///< spec
    std::string generator_options = {};
    std::uint64_t dimension = 0;
    std::string warps = {};
    std::uint64_t count = 0;                   ///< requested points
    std::optional<std::uint64_t> points = {};  ///< measured points
    std::uint64_t seed = 0;
    std::string measure = {};  ///< spec
    std::string measure_options = {};
    std::string domain = {};  ///< domain of the measured points
    std::string key = {};
    std::optional<double> value = {};
    std::string status = "ok";  ///< "ok" or "failed"
    std::string reason = {};
    std::string study = {};  ///< fingerprint of the study
    std::optional<double> generate_seconds = {};
    std::optional<double> seconds = {};

    [[nodiscard]] bool failed() const { return status != "ok"; }
    /// Whether the unit failed because memory or a file was missing: another run may succeed.
    [[nodiscard]] bool lacked_something() const {
        return reason.starts_with(lack_of_memory) || reason.starts_with(lack_of_file);
    }
};

struct KeyedNumber {
    std::string key;
    double value = 0;
};

/// Result of one measure of one set.
struct UnitResult {
    std::vector<KeyedNumber> numbers = {};
    std::string domain = {};
    std::optional<std::uint64_t> points = {};
    double generate_seconds = 0;
    double seconds = 0;
    std::string failure = {};    ///< reason, on one line; empty if it succeeded
    bool out_of_memory = false;  ///< needs more memory than this worker has
};

/// Results of consecutive units.
struct Segment {
    UnitRange units;
    std::vector<UnitResult> results = {};
};

/// Row with the columns that are the same in all rows of a unit; the others are unset.
StudyRow row_of(const Sweep& sweep, const Unit& unit);

/// A row for each number of the unit, or one row with its failure.
std::vector<StudyRow> rows_of(const Sweep& sweep, const Unit& unit, const UnitResult& result);

/// Index of the unit that a row belongs to; nullopt if it belongs to none.
std::optional<std::uint64_t> unit_of(const Sweep& sweep, const StudyRow& row);

/// Whether a row belongs to the unit whose row_of() is `unit`.
bool belongs(const StudyRow& row, const StudyRow& unit);

/// The first lines of a table, with the version and the command that made it: `# KEY: VALUE` in
/// CSV, one object in JSONL.
std::string study_preface(TableStyle style, const std::string& command);

/// Whether a line is one of study_preface().
bool is_study_preface(std::string_view line);

/// Removes the lines of a study_preface() from the start of a text.
std::string_view without_preface(std::string_view text);

/// Formats rows as lines of CSV or JSONL, and parses them.
class StudyTable {
  public:
    /// @param preface text above the column names, from study_preface(); may be empty
    StudyTable(TableStyle style, bool seconds, std::string preface = {});

    [[nodiscard]] TableStyle style() const { return style_; }

    [[nodiscard]] const std::string& preface() const { return preface_; }

    /// The line of column names in CSV; empty in JSONL.
    [[nodiscard]] std::string names() const;

    /// Everything above the rows.
    [[nodiscard]] std::string head() const { return preface_ + names(); }

    /// A row as a line, with its line break.
    [[nodiscard]] std::string line(const StudyRow& row) const;

    /// Reads a line without its line break; nullopt if it is not a complete row.
    [[nodiscard]] std::optional<StudyRow> parse(std::string_view line) const;

    /// Whether a file with this first line is a study's table of this style.
    [[nodiscard]] bool is_head(std::string_view line) const;

  private:
    TableStyle style_;
    bool seconds_;
    std::string preface_;
    std::vector<TableCell> columns_;  ///< only their names are used
};

}  // namespace stipple
