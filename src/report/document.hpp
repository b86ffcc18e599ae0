// SPDX-License-Identifier: MIT
//
// Measurements formatted as text, JSON (format stipple.report, version 1) and CSV, and parsed from
// JSON.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "stipple/report.hpp"

namespace stipple {

/// Results of one analyzer on one set, or their mean over several sets.
struct Measurement {
    std::string analyzer;
    std::string source;
    std::optional<std::size_t> set = {};  ///< number of the set, if its file has several
    std::size_t sets = 1;                 ///< number of sets that were averaged
    std::uint64_t count = 0;  ///< number of points; for a mean over different sizes, the smallest
    std::uint64_t largest_count = 0;  ///< largest count in a mean over different sizes; else 0
    std::size_t dimension = 0;
    std::string domain;
    std::vector<std::string> columns = {};  ///< names of the coordinates; may be empty
    std::vector<std::pair<std::string, std::string>> options = {};
    Report results = {};
    std::optional<Report> standard_error = {};  ///< only for a mean
    std::optional<double> seconds = 0.0;        ///< run time; empty: not printed
};

/// The number under a key of a report; nullopt if there is none.
std::optional<double> number_at(const Report& report, std::string_view key);

/// The list of numbers under a key; nullopt if there is none.
std::optional<Report::Curve> list_at(const Report& report, std::string_view key);

/// An item as readable text: long lists are truncated with a note; empty for grids and groups.
std::string text_of(const Report::Item& item);

/// A report as a JSON object; infinities and NaN become null in its text.
Json json_of(const Report& report);

/// Options as a JSON object; numbers and flags keep their types.
Json json_of(const std::vector<std::pair<std::string, std::string>>& options);

/// An array of objects or, for one measurement without `array`, one object; ends with a newline.
std::string to_json(std::span<const Measurement> measurements, bool array = false);

struct TextStyle {
    /// Whether to show long lists as tables below; lists of equal length in one group are side by
    /// side. Otherwise lists are truncated with a note.
    bool full = false;
    /// Returns text to insert below the line of a result, with line ends; may be empty.
    std::function<std::string(const Measurement&, const std::string& key)> below = {};
};

/// Names, values and units in aligned columns.
std::string to_text(std::span<const Measurement> measurements, const TextStyle& style = {});

/// Whether the bytes look like JSON of reports: an object that names the format, or an array of
/// such objects.
bool looks_like_reports(std::string_view bytes);

/// Parses the output of to_json(): one report, an array of reports, or several such texts in
/// sequence. null becomes NaN. `source` is for messages.
/// @throws Error(input) if the text is not of this form or has no reports
std::vector<Measurement> read_reports(std::string_view bytes, const std::string& source);

/// A tidy table with one row per measurement, or per entry of its curves. Nested keys are dotted;
/// other lists have columns KEY.0, KEY.1... (csv_table.cpp). The standard errors of a mean are
/// columns standard_error.KEY.
std::string to_csv(std::span<const Measurement> measurements);

}  // namespace stipple
